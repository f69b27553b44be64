// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One function per built-in scene (internal to demos/scenes). Each takes the light's half size.
#pragma once

#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

// Benchmark scenes: truth images of them exist.
scene::SceneDescription makeBox(double lightHalfSize);
scene::SceneDescription makeBars(double lightHalfSize);
scene::SceneDescription makeFence(double lightHalfSize);
scene::SceneDescription makeLeaves(double lightHalfSize);
scene::SceneDescription makeFigure(double lightHalfSize);
scene::SceneDescription makeSpheres27(double lightHalfSize);
scene::SceneDescription makeSpheres81(double lightHalfSize);
scene::SceneDescription makeSpheresCube(double lightHalfSize);

// Everyday scenes: for eyes and for stability.
scene::SceneDescription makeMannequin(double lightHalfSize);
scene::SceneDescription makeContact(double lightHalfSize);
scene::SceneDescription makeRoom(double lightHalfSize);
scene::SceneDescription makeTerrain(double lightHalfSize);
scene::SceneDescription makeSheets(double lightHalfSize);
scene::SceneDescription makeConvex(double lightHalfSize);
scene::SceneDescription makeButterfly(double lightHalfSize);

/// Camera and light of the benchmark scenes other than `figure`; near and far are left to fitNearAndFar.
void setBenchmarkView(scene::SceneDescription& description, double lightHalfSize);
void setView(scene::SceneDescription& description, const glm::dvec3& eye, const glm::dvec3& target,
             const glm::dvec3& lightCenter, const glm::dvec3& lightTarget, double lightHalfSize);

}  // namespace halfshadow::scenes
