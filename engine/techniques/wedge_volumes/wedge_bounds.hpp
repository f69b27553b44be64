// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where on the screen a wedge's volume can be: what bounds a pass that needs no more.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "gl/encoder.hpp"
#include "scene/light_silhouettes.hpp"
#include "techniques/wedge_volumes/wedge_pieces.hpp"

namespace halfshadow::techniques {

/// A box of (a, b, h), or a rectangle with an interval of heights.
struct LightBox {
  glm::dvec3 low{1e300}, high{-1e300};
  void include(const glm::dvec3& abh) { low = glm::min(low, abh), high = glm::max(high, abh); }
};

/// From (a, b, h) to the world.
glm::dmat4 worldFromLight(const scene::LightPlane& plane);
/// From (a, b, h - 1) to the world: what single precision holds of the light's coordinates, see
/// scene/light_anchor.hpp.
glm::dmat4 worldFromAnchor(const scene::LightPlane& plane);

/// Whether some point of the box can lie in the volume.
bool reaches(const WedgeExtent& extent, const LightBox& box);

/// The volume between two heights.
std::array<glm::dvec3, 8> volumeHull(const WedgeExtent& extent, double fromHeight, double toHeight);

/// Window rectangle of the part before the near plane of the points' convex hull, a pixel wider on each side;
/// nothing when all of it is outside of the view.
std::optional<gl::Rect> screenBounds(std::span<const glm::dvec3> points, const glm::dmat4& clipFromPoints,
                                     int width, int height);

/// The pixels that both have; nothing when there are none.
std::optional<gl::Rect> commonRect(const gl::Rect& a, const gl::Rect& b);

/// Rectangles that hold all of `rects` and do not overlap: those that do are united.
std::vector<gl::Rect> disjointRects(std::vector<gl::Rect> rects);

}  // namespace halfshadow::techniques
