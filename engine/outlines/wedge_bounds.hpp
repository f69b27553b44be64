// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where on the screen a wedge's volume can be: what bounds a pass that needs no more.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/rect.hpp"
#include "outlines/wedge_pieces.hpp"
#include "scene/light_silhouettes.hpp"

namespace halfshadow::outlines {

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
std::optional<Rect> screenBounds(std::span<const glm::dvec3> points, const glm::dmat4& clipFromPoints,
                                 int width, int height);

/// The pixels that both have; nothing when there are none.
std::optional<Rect> commonRect(const Rect& a, const Rect& b);

/// Rectangles that hold all of `rects` and do not overlap: those that do are united.
std::vector<Rect> disjointRects(std::vector<Rect> rects);

}  // namespace halfshadow::outlines
