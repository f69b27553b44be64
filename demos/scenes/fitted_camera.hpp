// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A camera for a scene that has none (internal).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

/// Places of the casters that are not floors (`isSubject`, by object), and of their shadows: cast from the
/// light's centre onto the plane at their lowest y, at most one radius of `subject` long.
std::vector<glm::dvec3> castersAndShadows(const scene::SceneDescription& description,
                                          const std::vector<char>& isSubject, const scene::Bounds& subject,
                                          const scene::AreaLight& light);

/// Looks along norm(0.5, -0.6, -0.75), vertical field of view 34°, from the nearest place that sees all the
/// points in a 4:3 image, with a margin of a twentieth; they reach as far to either side.
scene::Camera cameraFittedTo(const std::vector<glm::dvec3>& points);

}  // namespace halfshadow::scenes
