// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What the surfaces of a caster cover together, seen from a point: once at least, twice at least, and so on.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace halfshadow::scene {

/// Loops over the light, projected from a source point, cut where they cross and joined again to the outlines
/// of levels.
///
/// A surface may have two sides, the faces that look towards the source and those that look away: at a point
/// of the projection it counts as often as the side that covers it more, so that a shell without its
/// underside counts once, and light comes through where neither side has a face. Different surfaces add up.
class CoveredLevels {
 public:
  enum class Side : std::uint8_t { towards, away };
  struct Loop {
    std::vector<glm::dvec3> points;  ///< (a, b, h); they step along rays from the source where edges cross
    double area = 0.0;               ///< of the projection
  };
  using Level = std::vector<Loop>;  ///< what is covered at least so often, counter-clockwise around it

  /// The point of the light from which (a, b, h) are projected to ((a, b) - source) / h.
  void start(const glm::dvec2& source);
  /// A closed loop, counter-clockwise in the projection around what it covers.
  void addLoop(std::span<const glm::dvec3> points, std::uint32_t surface, Side side);
  /// The outline of level 1 first, at most `most` of them. False when rounding leaves some outline open: then
  /// there is no result.
  bool find(std::vector<Level>& levels, int most = 1 << 20);

 private:
  struct Vertex {
    glm::dvec3 place{0.0};
    glm::dvec2 flat{0.0};
    std::uint32_t strands = 0;  ///< that begin or end here
  };
  /// How often each side covers more to the left of a strand than to its right.
  struct Jump {
    std::uint32_t surface = 0;
    std::array<int, 2> sides{};
  };
  /// A directed edge; edges of several loops between the same vertices are one.
  struct Strand {
    std::uint32_t from = 0, to = 0;
    std::uint32_t firstJump = 0, jumpCount = 0;
    std::uint32_t firstCrossing = 0, crossingCount = 0;
  };
  struct Crossing {
    std::uint32_t on = 0, other = 0, node = 0;
    double t = 0.0;
  };
  /// A strand between two crossings, or the vertices at its ends.
  struct Piece {
    std::uint32_t strand = 0, fromNode = 0, toNode = 0;
    double t0 = 0.0, t1 = 1.0;
    int left = 0, right = 0;  ///< levels
  };
  struct AddedEdge {
    std::uint32_t low = 0, high = 0, surface = 0;
    int turns = 0;  ///< +1 from low to high
    Side side = Side::towards;
  };

  std::uint32_t vertexAt(const glm::dvec3& place);
  void makeStrands();
  void findCrossings();
  void cross(std::uint32_t s, std::uint32_t o);
  void findStrandsAt();
  void findPieces();
  void walk(std::uint32_t strand);
  /// The sides' counts just right of the strand's start.
  void countFrom(std::uint32_t strand);
  void addJumps(const Strand& strand, int times);
  void sortIntoRows();  ///< in the order of order_
  std::size_t rowOf(double y) const;
  std::pair<std::size_t, std::size_t> rowsOf(const Strand& strand) const;  ///< first and last
  bool traceLevel(int level, Level& result);
  glm::dvec3 pointAt(const Strand& strand, double t) const;
  glm::dvec2 flatAt(const Strand& strand, double t) const;

  glm::dvec2 source_{0.0};
  std::vector<Vertex> vertices_;
  struct PlaceHash {
    std::size_t operator()(const std::array<double, 3>& place) const;
  };
  std::unordered_map<std::array<double, 3>, std::uint32_t, PlaceHash> vertexOf_;
  std::vector<AddedEdge> added_;
  std::uint32_t surfaces_ = 0;
  std::vector<Jump> jumps_;
  std::vector<Strand> strands_;
  std::vector<Crossing> crossings_;
  std::vector<std::uint32_t> order_, active_, firstAt_, strandsAt_;
  std::vector<Piece> pieces_;
  std::vector<bool> walked_;
  std::vector<std::array<int, 2>> counts_;  ///< by surface, where the walk is
  int level_ = 0;                           ///< there
  /// Strands by rows of the projection that they reach into, in a row from left to right.
  double lowestRow_ = 0.0, rowsPerUnit_ = 0.0;
  std::size_t rows_ = 1;
  std::vector<std::uint32_t> firstInRow_, strandsInRow_;
  std::vector<std::uint32_t> firstOut_, nextOut_, chosen_;
  std::uint32_t nodes_ = 0;
};

}  // namespace halfshadow::scene
