// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Opens whatever a user names as a scene and completes it with the camera, light and ground that it lacks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

/// automatic: a ground plane is added unless the scene already has a floor, or would be hidden by one (see
/// added_ground.hpp). A floor is an object that receives and is flat (less high than a quarter of its width),
/// and that either is at least as wide in x and in z as all other casters together and begins at or below
/// their middle, or lies below all of them and covers a quarter of what they do.
enum class GroundMode { automatic, on, off };

/// From where a file's materials that are not doubleSided are seen: both sides, or as the file says the front
/// (see scene::showsBackFaces).
enum class Sides { both, asInFile };

struct SceneOptions {
  GroundMode ground = GroundMode::automatic;
  double animationTimeSeconds = 0.0;         ///< files only
  int animationIndex = 0;                    ///< files only; -1 = rest pose
  std::optional<scene::Camera> camera;       ///< replaces the scene's; near and far are fitted anyway
  std::optional<scene::AreaLight> light;     ///< replaces all of the scene's lights
  std::vector<scene::AreaLight> moreLights;  ///< stand beside `light`
  /// What the scene takes for upward: where an added ground, lamp and camera stand. Need not be unit.
  glm::dvec3 up{0, 1, 0};
  Sides sides = Sides::asInFile;
};

/// Opens `builtin:NAME[@key=value,…]` or a .gltf/.glb file. The result always has a camera, at least one
/// light and at least one object that receives. What was added is said in `notes`. The rules, with r the
/// radius and c the centre of the casters' bounds (of all objects, when none casts):
///  - light: centre c + 3 r · norm(0.35, 1, 0.3), aimed at c, square, half size 0.1 × its distance; where
///    that does not reach what the scene's camera sees, over that (see added_lamp.hpp);
///  - camera: vertical field of view 34°, looking along norm(0.5, -0.6, -0.75), just far enough to see the
///    casters and their shadow on the ground in a 4:3 image (see fitted_camera.hpp);
///  - ground: plane at the scene's lowest y, casts = false, 40 r wide, below the centre of the casters; not
///    where it would come between the camera or a light and the scene, or lie in a surface that is seen (see
///    added_ground.hpp). GroundMode::on adds it to all scenes, GroundMode::off to none, and removes that of
///    built-in scenes;
///  - near and far: see fitNearAndFar.
/// Errors: those of makeBuiltinScene and loadGltf; invalidCamera, invalidLight (for the overrides);
/// emptyScene.
Result<scene::SceneDescription> openScene(const std::string& source, const SceneOptions& options);

/// The rules above, for a scene that is already in memory.
Status completeScene(scene::SceneDescription& description, const SceneOptions& options);

/// Sets near to 0.9 × the smallest view depth of what is seen in an image of aspect up to 2:1, however far
/// the scene goes on behind it; slivers nearer than a fiftieth of what rays through the image meet first are
/// left out of that when it is less than 1/5000 of far. Sets far to 1.1 × the largest view depth of all
/// vertices. Of cameras that stand far away (see Camera::leastNearDistance) both hold the scene more tightly.
void fitNearAndFar(scene::Camera& camera, const scene::SceneDescription& description);

}  // namespace halfshadow::scenes
