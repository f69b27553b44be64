// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The points by which a light is taken hold of in the picture.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/light.hpp"
#include "viewer/screen_space.hpp"

namespace halfshadow::viewer {

enum class HandleKind {
  center,  ///< moves the light across the view
  aim,     ///< turns it
  sizeU,   ///< lengthens its first side, both ways
  sizeV    ///< lengthens its second side
};

struct Handle {
  std::size_t light = 0;
  HandleKind kind = HandleKind::center;
  glm::dvec3 placeWorld{0.0};
  glm::dvec2 pixel{0.0};
};

/// Of all lights, those in front of the eye. A point has no handles of sides.
std::vector<Handle> handlesOf(const std::vector<scene::AreaLight>& lights, const ScreenSpace& screen);

/// The handle nearest to `pixel` within `reach` pixels.
std::optional<Handle> handleAt(const std::vector<Handle>& handles, const glm::dvec2& pixel, double reach);

/// The light as it was when the handle was taken, with the handle at `pixel` now. What cannot be (a side of
/// no length, an aim through the centre) leaves it as it was.
scene::AreaLight dragged(const scene::AreaLight& start, const Handle& handle, const ScreenSpace& screen,
                         const glm::dvec2& pixel);

/// The rectangle's corners in order.
std::array<glm::dvec3, 4> cornersOf(const scene::AreaLight& light);

/// Turned about the vertical through `pivot` by a share of a whole turn.
scene::AreaLight turnedLight(const scene::AreaLight& light, const glm::dvec3& pivot, double share);

/// Round `pivot` as a hand turns it: sideways about the vertical, up and down about `right`; a picture
/// `height` pixels high is half a turn. The light keeps looking where it did, seen from itself.
scene::AreaLight swung(const scene::AreaLight& light, const glm::dvec3& pivot, const glm::dvec3& right,
                       const glm::dvec2& pixels, double height);

/// Another light like `first`, a quarter turn about the vertical through `pivot` away.
scene::AreaLight anotherLight(const scene::AreaLight& first, const glm::dvec3& pivot);

}  // namespace halfshadow::viewer
