// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The same scene in other words, or the same scene with something more: functions from scene to scene.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "scene/scene_description.hpp"
#include "scenes/shapes.hpp"
#include "stress/random.hpp"

namespace halfshadow::stress {

using scene::SceneDescription;

/// A similarity: scale, then turn by `angle` about `axis` (unit), then shift.
struct Placement {
  double scale = 1.0;
  glm::dvec3 axis{0, 1, 0};
  double angle = 0.0;
  glm::dvec3 shift{0.0};
};

/// Everything placed elsewhere by transforms: objects, lights, camera with its planes. The picture stays.
SceneDescription placed(SceneDescription scene, const Placement& placement);
/// The same with the placement rounded into the vertices: no transform is left.
SceneDescription baked(const SceneDescription& scene, const Placement& placement);
/// Every caster's mesh mirrored in object space and mirrored back by its transform.
SceneDescription mirroredNodes(SceneDescription scene);
/// Objects in another order; triangles of each mesh in another order, each turned to another first corner.
SceneDescription reordered(SceneDescription scene, Random& random);
/// No two triangles share a vertex.
SceneDescription unwelded(SceneDescription scene);
/// Each caster as two objects: its triangles left and right of the middle of its box along x (`bySide`), or
/// every other one.
enum class SplitRule { bySide, alternating };
SceneDescription split(SceneDescription scene, SplitRule rule);
/// Casters wound the other way: all, or every second one.
enum class FlipRule { all, everySecond };
SceneDescription flipped(SceneDescription scene, FlipRule rule);
SceneDescription with(SceneDescription scene, const std::string& name, const scenes::Shape& shape);
/// `with`, of an object that casts nothing.
SceneDescription withReceiver(SceneDescription scene, const std::string& name, const scenes::Shape& shape);
/// The receiver plane named "ground" replaced by one of that width, casting or not.
SceneDescription withGround(SceneDescription scene, double width, bool casts);

}  // namespace halfshadow::stress
