// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where the surfaces of one receiver lie, tile by tile as seen from the light: what bounds a list of
/// silhouette vertices to those that matter.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/light_silhouettes.hpp"
#include "scene/mesh.hpp"
#include "techniques/caster_lists/tangent_space.hpp"

namespace halfshadow::techniques {

/// Tangents that some shadow can reach.
struct TangentRect {
  glm::dvec2 low{1e300}, high{-1e300};
  bool empty() const { return !(low.x < high.x && low.y < high.y); }
};

/// A grid over the tangents that a receiver and the shadows share; `boxes` row by row, empty where the
/// receiver has no surface turned towards the light.
struct ReceiverTiles {
  glm::dvec2 low{0.0}, tileSize{1.0};
  int columns = 0, rows = 0;
  std::vector<TangentBox> boxes;
  bool empty() const { return columns == 0; }
};

struct ReceiverSurface {
  const scene::TriangleMesh* mesh = nullptr;
  glm::dmat4 worldFromObject{1.0};
  bool closed = false;  ///< faces turned away from every point of the light receive nothing
};

/// `lift`: world distance by which fragments are moved off the surface; the boxes allow for it. `tileSize`:
/// side of a tile in tangents; grown so that the grid has at most `maxTiles` along a side.
/// `minHeight`: surfaces nearer to the light's plane are left out.
ReceiverTiles receiverTiles(const ReceiverSurface& surface, const scene::LightPlane& plane,
                            const TangentRect& shadows, double tileSize, int maxTiles, double minHeight,
                            double lift);

}  // namespace halfshadow::techniques
