// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Triangles that reach far beyond what a camera sees, cut down to it in double.
#pragma once

#include <optional>

#include "scene/mesh.hpp"

namespace halfshadow::scene {

/// A camera's view of an object, for cutting.
struct ObjectView {
  glm::dmat4 clipFromObject{1.0};
  glm::dmat4 worldFromObject{1.0};
  glm::dvec3 eyeWorld{0.0};
  double nearDistance = 0.1;
  double pixelAngle = 0.001;  ///< the height of a pixel at distance 1
};

/// A rasteriser cuts triangles at the view's border in single precision: what it makes of a place in the
/// triangle is off by the rounding of its farthest corners. Where that shows in a pixel (a ground that is a
/// million times as wide as what stands on it) such triangles are replaced by the part of them that the
/// camera sees and a margin around it; the others stay. None: no triangle needs it. Empty: none is left.
/// The result has positions, indices, normals and texture coordinates only.
std::optional<TriangleMesh> cutToView(const TriangleMesh& mesh, const ObjectView& view);

}  // namespace halfshadow::scene
