// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes cut into short closed pieces, each with the volume that its penumbra fills. CPU only.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/light_silhouettes.hpp"

namespace halfshadow::outlines {

/// Steps of a caster's grid over its size: whole numbers that interpolation brings to fragments unharmed.
inline constexpr double kGridSteps = 262144.0;

/// Vertices of one piece: what a fragment evaluates at once.
inline constexpr int kPieceVertices = 8;

/// Where penumbra and umbra of some part of a caster can be: at height h the rectangle
/// [1 + lowA·h, -1 + highA·h] × [1 + lowB·h, -1 + highB·h], for h from `nearest` on. Planes through the
/// light's borders and the part: on it, (a - 1) / h is the same at caster and receiver.
struct WedgeExtent {
  double lowA = 1e30, highA = -1e30, lowB = 1e30, highB = -1e30;
  double nearest = 1e30, farthest = 0.0;  ///< heights of its own
  /// The light's rectangle: all of it, or the part whose shadows are meant, which takes the place of -1
  /// and 1.
  glm::dvec2 lightLow{-1.0}, lightHigh{1.0};
  void include(const glm::dvec3& abh);
  void include(const WedgeExtent& other);
  glm::dvec2 low(double h) const { return lightHigh + glm::dvec2(lowA, lowB) * h; }
  glm::dvec2 high(double h) const { return lightLow + glm::dvec2(highA, highB) * h; }
  /// Whether a receiver at a height up to `end` can lie in both.
  bool meets(const WedgeExtent& other, double end) const;
  /// The same for heights above `from`, where both extents have begun.
  bool meetsBetween(const WedgeExtent& other, double from, double end) const;
};

/// A closed polygon of at most kPieceVertices vertices. The pieces of a loop add up to the loop: chords
/// between them are run through once each way.
struct WedgePiece {
  std::uint32_t firstVertex = 0, vertexCount = 0;
  double step = 1.0;  ///< its caster's
  WedgeExtent extent;
  /// The caster's size, about: receivers that are a thousandth of it above all vertices need no clipping.
  double size() const { return kGridSteps * step; }
};

struct WedgeCaster {
  std::uint32_t object = 0;
  std::uint32_t firstPiece = 0, pieceCount = 0;
  std::uint32_t batch = 0;  ///< casters of one batch never shadow the same receiver
  double step = 1.0;        ///< of its grid, a power of two
  WedgeExtent extent;
};

struct WedgePieces {
  /// (a, b, h), of which (a, b, h - 1) are whole multiples of the caster's step times `units`: pieces share
  /// their vertices exactly, whatever reads them. The step follows from the caster's size, or from the
  /// rounding of single precision where that is more.
  std::vector<glm::dvec3> vertices;
  glm::dvec3 units{1.0};  ///< powers of two: lengths of a, b and h that are about the same in the world
  std::vector<WedgePiece> pieces;
  std::vector<WedgeCaster> casters;  ///< connected parts with a silhouette
  std::uint32_t batchCount = 0;      ///< of casters with more than one piece
};

/// For WedgePieces::units.
glm::dvec3 wedgeUnits(const scene::LightPlane& plane);

/// Replaces the content of `result`. `farthest`: largest height of a receiver.
void makeWedgePieces(const scene::LightSilhouettes& silhouettes, const glm::dvec3& units, double farthest,
                     WedgePieces& result);

}  // namespace halfshadow::outlines
