// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Whether a scene is fit for shadows: the facts behind `halfshadow validate`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

struct ObjectReport {
  std::string name;
  std::uint32_t triangles = 0;
  std::uint32_t vertices = 0;        ///< as stored, attributes not welded
  std::uint32_t weldedVertices = 0;  ///< distinct positions
  bool closed = false;               ///< every directed edge has its opposite
  std::uint32_t boundaryEdges = 0;
  std::uint32_t nonManifoldEdges = 0;
  std::uint32_t degenerateDropped = 0;
  std::uint32_t duplicateDropped = 0;
  double signedVolumeWorld = 0.0;  ///< positive when closed and wound outward
  scene::Bounds boundsWorld;
  bool casts = true;
  bool receives = true;
  std::vector<std::string> warnings;  ///< one sentence each: what it does to shadows and what would fix it
};

struct ValidationReport {
  std::string name;
  std::vector<ObjectReport> objects;
  scene::Bounds boundsWorld;
  scene::Bounds casterBoundsWorld;
  std::uint64_t triangles = 0;
  std::uint32_t casters = 0;
  std::uint32_t openCasters = 0;
  std::vector<std::string> warnings;  ///< about the whole scene, e.g. extreme scale; loader notes come first
};

/// Never fails: a scene that was loaded can be described.
ValidationReport validateScene(const scene::SceneDescription& description);

}  // namespace halfshadow::scenes
