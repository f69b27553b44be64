// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What the silhouette techniques work with, as lines: casters' silhouettes, and the volumes of their wedges.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/view.hpp"

namespace halfshadow::viewer {

struct LightLine {
  glm::dvec3 aWorld{0.0}, bWorld{0.0};
  bool isOuter = false;  ///< bounds a wedge; else a silhouette
};

/// Silhouettes of all casters seen from the light's centre. With wedges: from each of their vertices also
/// where the shadows of the light's four corners run, down to the lowest point of the scene.
std::vector<LightLine> linesOfLight(const View& view, std::size_t light, bool withWedges);

}  // namespace halfshadow::viewer
