// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where a lamp goes in a scene that has none (internal).
#pragma once

#include <string>

#include "scene/scene_description.hpp"
#include "scenes/triangle_tree.hpp"

namespace halfshadow::scenes {

struct LampPlace {
  scene::AreaLight light;
  std::string note;
};

/// Three radii above and beside the middle of `subject`, unless the scene has a camera whose view that lamp
/// does not reach: then the place, among some over what the camera sees and over the camera, that most of the
/// view is lit from. Half its size is a tenth of its distance. Errors: those of areaLightAimed.
Result<LampPlace> lampPlaceFor(const scene::SceneDescription& description, const TriangleTree& tree,
                               const scene::Bounds& subject);

}  // namespace halfshadow::scenes
