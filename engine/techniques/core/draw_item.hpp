// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Objects as passes draw them. No GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "device/capabilities.hpp"
#include "device/draw_state.hpp"
#include "scene/bounds.hpp"
#include "scene/caster_geometry.hpp"

namespace halfshadow::gl {
class Texture;
}

namespace halfshadow::techniques {

class GpuMesh;

/// Streams of a GpuMesh.
enum class MeshStreams { positions, facet, shading };
/// What positions and facets bring along: nothing, or what holes are cut by.
enum class MeshExtras { none, alpha };

/// One object placed in the world, as passes draw it.
struct DrawItem {
  std::uint64_t object = 0;  ///< its id in the scene
  std::uint64_t revision =
      0;  ///< of mesh and transform; beside the id: lists are compared by both each frame
  const GpuMesh* mesh = nullptr;
  bool casts = true;  ///< of receivers: it is among the casters of some light in this frame
  bool receives = true;
  glm::dmat4 worldFromObject{1.0};
  glm::vec4 baseColor{1.0f};
  const gl::Texture* baseColorTexture = nullptr;
  const gl::Texture* alphaMask = nullptr;  ///< alpha below the cutoff cuts holes; null: none anywhere
  float alphaCutoff = 0.0f;                ///< of mask times vertex colour
  bool vertexColors = false;
  scene::Bounds boundsWorld;
  bool closed = false;       ///< no boundary edges: from outside only front faces are seen
  bool frontOnly = false;    ///< the camera is not shown its back faces
  float solidity = 1.0f;     ///< of casters, see scene::solidity()
  bool mirrored = false;     ///< the transform turns the winding round
  bool facetStream = false;  ///< its mesh has one: MeshStreams::facet may be drawn
  const scene::TriangleMesh* sourceMesh = nullptr;
  const scene::CasterGeometry* geometry = nullptr;
  /// Adjacency, for silhouettes; built on the first call.
  const scene::HalfEdgeMesh& halfEdges() const { return geometry->halfEdges(*sourceMesh); }
};

/// Faces that need not be drawn when seen from `eyeWorld`: back faces of closed objects that are farther than
/// `nearReach`, so that no near plane opens them. Halves rasterisation, which is most of the cost of dense
/// meshes.
device::Cull hiddenFaces(const DrawItem& item, const glm::dvec3& eyeWorld, double nearReach = 0.0);
/// The same for the camera, and the back faces of what has its front seen alone. Maps take both sides.
device::Cull unseenFaces(const DrawItem& item, const glm::dvec3& eyeWorld, double nearReach);

/// True where receivers need facet normals as a vertex attribute: no derivatives, or none precise enough.
bool needsFacetStream(const device::Capabilities& capabilities);

/// Few enough to look at each of them in each frame.
bool hasFewTriangles(const DrawItem& item);

/// The faces on the other side.
device::Cull turnedRound(device::Cull faces);

}  // namespace halfshadow::techniques
