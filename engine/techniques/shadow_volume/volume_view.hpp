// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The camera as shadow volumes need it: no far plane, and tests against its near plane. No GL.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "base/rect.hpp"
#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

struct VolumeView {
  /// Like View::clipFromWorld with the far plane just beyond infinity: receivers and volumes are drawn with
  /// it alike. x, y and w are the same.
  glm::dmat4 clipFromWorld{1.0};
  std::array<glm::dvec3, 4> nearCornersWorld{};  ///< of the near plane's rectangle, in order around it
  glm::dvec3 eyeWorld{0.0};
  double nearReach = 0.0;
  int width = 0, height = 0;
};
/// `view` is a perspective.
VolumeView volumeView(const View& view);

/// A box as eight corners; corner i has the high end of axis k where bit k of i is set.
using BoxCorners = std::array<glm::dvec3, 8>;
BoxCorners boxCornersWorld(const glm::dmat4& worldFromObject, const scene::Bounds& boundsObject);

/// True when no point of the box can lie on a line from the light to the near plane's rectangle. Then no eye
/// ray begins inside of the box's shadow, and surfaces in front of receivers may be counted. Conservative.
/// Based on: Everitt, Kilgard, "Robust Stenciled Shadow Volumes", 2002 (the light's pyramid); Gottschalk,
/// Lin, Manocha, "OBBTree", 1996 (separating axes).
bool missesNearPyramid(const VolumeView& view, const glm::dvec3& lightWorld, const BoxCorners& boxWorld);

/// Pixels that a shadow of the box can cover: empty optional where it may fill the view, a rectangle of no
/// size where it misses the view. Conservative by a pixel.
std::optional<Rect> shadowScissor(const VolumeView& view, const glm::dvec3& lightWorld,
                                  const BoxCorners& boxWorld);

}  // namespace halfshadow::techniques
