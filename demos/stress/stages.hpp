// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The scenes that cases start from, and the lists of cases (internal to demos/stress).
#pragma once

#include <string>

#include "stress/cases.hpp"
#include "stress/scene_edits.hpp"

namespace halfshadow::stress {

/// A built-in scene, complete ("figure@light=1").
SceneDescription builtin(const std::string& name);
/// `builtin` with another light of the same place and direction: half extents along its own u and v.
SceneDescription withLight(SceneDescription scene, double halfU, double halfV);
scene::AreaLight lightDown(const glm::dvec3& center, double halfU, double halfV);
/// Camera planes are fitted.
SceneDescription stage(std::vector<scene::SceneObject> objects, const scene::AreaLight& light,
                       const glm::dvec3& eye, const glm::dvec3& target, double fovRadians = 0.6);
scene::SceneObject boxObject(const std::string& name, const glm::dvec3& center, const glm::dvec3& half);
/// Casts nothing.
scene::SceneObject floorObject(double width);

/// As it stands in the names of variants: "1e-05", "0.3".
std::string numberText(double value);

std::vector<Variant> baseVariants(std::uint64_t seed);
std::vector<Case> placementCases();
std::vector<Case> groundCases();
std::vector<Case> lampCases();
std::vector<Case> lightCases();
std::vector<Case> roomCases();
std::vector<Case> hostileCases();

}  // namespace halfshadow::stress
