// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where the surfaces of one receiver lie, tile by tile as seen from the light: what bounds a list of
/// silhouette vertices to those that matter.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "outlines/tangent_space.hpp"
#include "scene/light_silhouettes.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::outlines {

/// Tangents that some shadow can reach.
struct TangentRect {
  glm::dvec2 low{1e300}, high{-1e300};
  bool empty() const { return !(low.x < high.x && low.y < high.y); }
};

/// The part of one facet of a receiver that lies in one tile: tangents within [low, high], reciprocal height
/// base + dot(gradient, t) within [iLow, iHigh].
struct ReceiverPatch {
  glm::dvec2 low{0.0}, high{0.0}, gradient{0.0};
  double base = 0.0, iLow = 0.0, iHigh = 0.0;
  /// Of the facet (ListSpace::planeThrough), positive where its fragments are seen from.
  glm::dvec4 plane{0.0};
  glm::dvec3 lift{0.0};     ///< in (t, i): by so much at least its fragments stand off it
  bool eitherSide = false;  ///< the light lies on both sides of the plane, and fragments may
  bool turned = false;      ///< it is seen from its inner side
};

/// Tangents as tiles divide them: t / (1 + |t| · squeeze). What reaches up to the light's plane has tangents
/// without end, which even tiles would spread over; with a squeeze tiles grow outwards, and the last are
/// endless.
struct TileScale {
  glm::dvec2 squeeze{0.0};
  glm::dvec2 squeezed(const glm::dvec2& t) const { return t / (1.0 + glm::abs(t) * squeeze); }
  glm::dvec2 tangent(const glm::dvec2& s) const {
    return s / glm::max(1.0 - glm::abs(s) * squeeze, glm::dvec2(1e-9));
  }
};

/// A grid over the tangents that a receiver and the shadows share; `boxes` row by row, empty where the
/// receiver has no surface turned towards the light. `low` and `tileSize` are on the tiles' scale.
struct ReceiverTiles {
  TileScale scale;
  glm::dvec2 low{0.0}, tileSize{1.0};
  int columns = 0, rows = 0;
  std::vector<TangentBox> boxes;
  /// Of tile k: patches[firstPatch[k]] to patches[firstPatch[k + 1]]; only where asked for.
  std::vector<ReceiverPatch> patches;
  std::vector<std::uint32_t> firstPatch;
  std::span<const ReceiverPatch> patchesOf(std::size_t tile) const {
    if (firstPatch.empty()) return {};
    return std::span(patches).subspan(firstPatch[tile], firstPatch[tile + 1] - firstPatch[tile]);
  }
  bool empty() const { return columns == 0; }
};

struct ReceiverSurface {
  const scene::TriangleMesh* mesh = nullptr;
  glm::dmat4 worldFromObject{1.0};
  /// Faces turned away from every point of the light receive nothing: none is seen from behind.
  bool closed = false;
  bool withPatches = false;  ///< ReceiverTiles::patches are wanted
};

/// `tileSize`: side of a tile on the scale; grown so that the grid has at most `maxTiles` along a side.
/// `minHeight`: surfaces nearer to the light's plane are left out.
ReceiverTiles receiverTiles(const ReceiverSurface& surface, const ListSpace& space,
                            const TangentRect& shadows, double tileSize, int maxTiles, double minHeight,
                            const TileScale& scale = {});

}  // namespace halfshadow::outlines
