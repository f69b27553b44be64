// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Scenes in which silhouette techniques go wrong when they are careless, each small and named after its
/// trap.
#pragma once

#include <string>
#include <vector>

#include "scene/scene_description.hpp"

namespace halfshadow::test {

struct StressScene {
  std::string name;
  scene::SceneDescription scene;
  /// Factor on a technique's usual error: above 1 where what all of them assume fails by construction, with
  /// the reason beside the number.
  double allowance = 1.0;
  bool overlapping = false;  ///< penumbrae of several casters meet: how they combine is the technique's own
};
const std::vector<StressScene>& stressScenes();

/// A closed ball around the whole light; the camera sees the ground alone.
scene::SceneDescription lampInABall();

/// One caster that moves over the ground: frame 0 … frames - 1. Returns where object 0 then stands.
scene::SceneDescription flickerScene();
glm::dmat4 flickerPlace(int frame, int frames);

}  // namespace halfshadow::test
