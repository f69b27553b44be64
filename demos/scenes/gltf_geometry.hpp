// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Primitives of glTF meshes as checked triangle meshes (internal).
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "scene/mesh.hpp"
#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

/// How a primitive is to be built.
struct PrimitiveRequest {
  int mesh = 0;
  std::size_t primitive = 0;
  const std::vector<double>* morphWeights = nullptr;  ///< null = the mesh's own
  const std::vector<glm::dmat4>* jointMatrices =
      nullptr;  ///< null = not skinned; else positions come out in world space, less a centre
  /// Null, or what flattens the primitive: positions come out in world space, less a centre.
  const glm::dmat4* flattening = nullptr;
  /// Skins and what is flattened: what to take off; null = the middle of this primitive. One for all
  /// primitives of a node, so that vertices which they share stay shared.
  const glm::dvec3* centerWorld = nullptr;
  /// The transform that will be applied mirrors: x is negated and the winding reversed here instead, so that
  /// the mesh is wound outward in its own space as well as in the world.
  bool isMirrored = false;
};

struct PrimitiveMesh {
  std::shared_ptr<const scene::TriangleMesh> mesh;
  /// Of skins and of what is flattened: taken off the positions, to be put back by the transform.
  glm::dvec3 centerWorld{0.0};
};

/// Primitives that are not drawn, "primitive 0 of mesh 3".
struct SkippedPrimitives {
  std::vector<std::string> pointsOrLines, withoutArea;
};

/// No mesh for points, lines and primitives without a triangle that has an area.
Result<PrimitiveMesh> primitiveMesh(const tinygltf::Model& model, const PrimitiveRequest& request,
                                    SkippedPrimitives& skipped);

}  // namespace halfshadow::scenes
