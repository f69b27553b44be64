// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Whether a scene wants a ground under it, and at which height (internal).
#pragma once

#include <string>

#include "scene/scene_description.hpp"
#include "scenes/triangle_tree.hpp"

namespace halfshadow::scenes {

struct GroundPlace {
  double height = 0.0;
  bool wanted = true;
  std::string note;  ///< why it is not wanted, or why not at the lowest point; may be empty
};

/// At the lowest point of all that the scene holds, so that it covers nothing. It is not wanted where
/// - the camera or a light is not above that: the ground would lie between it and the scene;
/// - the camera is inside a closed shell of the scene, and sees nothing outside;
/// - a surface there that the camera can see from above covers a quarter of the scene: the scene has a floor.
/// A surface there that can be seen puts the ground a little below it, so that the surface is what is seen.
/// The scene has a camera and lights.
GroundPlace groundPlaceFor(const scene::SceneDescription& description, const TriangleTree& tree);

}  // namespace halfshadow::scenes
