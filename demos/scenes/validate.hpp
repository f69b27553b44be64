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
  bool closed = false;               ///< all its parts are closed, after repair
  std::uint32_t parts = 0;           ///< connected sets of faces: each casts its own shadow
  std::uint32_t sheets = 0;          ///< parts that stay open and occlude from both sides
  std::uint32_t looseParts = 0;      ///< sheets that are fins or inner walls of something closed
  std::uint32_t boundaryEdges = 0;   ///< as stored, before repair; the same holds for the next
  std::uint32_t nonManifoldEdges = 0;
  std::uint32_t mergedVertices = 0;  ///< what the repair of adjacency did; the mesh itself stays as it is
  std::uint32_t backToBackFaces = 0;
  std::uint32_t repairedTJunctions = 0;
  std::uint32_t flippedFaces = 0;
  std::uint32_t filledGaps = 0;
  std::uint32_t degenerateDropped = 0;
  std::uint32_t duplicateDropped = 0;
  std::uint32_t turnedTriangles = 0;  ///< of closed shells that were wound inward, or not alike
  double signedVolumeWorld = 0.0;     ///< positive when closed, as mended
  double radiusObject = 0.0;          ///< in its own coordinates
  double coordinateStep = 0.0;        ///< of single precision at its largest coordinate
  scene::Bounds boundsWorld;
  bool casts = true;
  bool receives = true;
  std::vector<std::string> repairs;   ///< what was mended for silhouettes, one phrase each
  std::vector<std::string> warnings;  ///< one sentence each: what it does to shadows and what would fix it
};

struct ValidationReport {
  std::string name;
  std::vector<ObjectReport> objects;
  scene::Bounds boundsWorld;
  scene::Bounds casterBoundsWorld;
  std::uint64_t triangles = 0;
  std::uint32_t casters = 0;
  std::uint32_t openCasters = 0;      ///< with sheets
  std::uint32_t repairedCasters = 0;  ///< whose adjacency needed mending
  std::uint32_t cutCasters = 0;       ///< into which alpha cuts holes
  std::uint32_t casterParts = 0;      ///< of all casters
  std::vector<std::string> warnings;  ///< about the whole scene; loader notes come first
};

/// Never fails: a scene that was loaded can be described.
ValidationReport validateScene(const scene::SceneDescription& description);

}  // namespace halfshadow::scenes
