// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Silhouettes cut into pieces: nothing is lost, nothing is added, and the volumes hold all that they must.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "techniques/wedge_volumes/wedge_pieces.hpp"

namespace halfshadow::techniques {
namespace {

/// A star around (centerA, centerB) with jagged heights.
void addCaster(scene::LightSilhouettes& silhouettes, std::uint32_t vertices, double centerA, double centerB,
               double height, std::mt19937& random) {
  std::uniform_real_distribution<double> jitter(0.6, 1.0);
  const scene::LightSilhouettes::Loop loop{static_cast<std::uint32_t>(silhouettes.points.size()), vertices};
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const double angle = 6.283185307179586 * i / vertices, radius = 2.0 * jitter(random);
    silhouettes.points.emplace_back(centerA + radius * std::cos(angle), centerB + radius * std::sin(angle),
                                    height * jitter(random));
  }
  silhouettes.casters.push_back({.object = static_cast<std::uint32_t>(silhouettes.casters.size()),
                                 .firstLoop = static_cast<std::uint32_t>(silhouettes.loops.size()),
                                 .loopCount = 1});
  silhouettes.loops.push_back(loop);
}

using Edge = std::array<float, 6>;

/// How often each edge is run through, one way minus the other.
std::map<Edge, int> edgesOf(const WedgePieces& pieces) {
  std::map<Edge, int> edges;
  for (const WedgePiece& piece : pieces.pieces) {
    for (std::uint32_t i = 0; i < piece.vertexCount; ++i) {
      const glm::vec3& a = pieces.vertices[piece.firstVertex + i];
      const glm::vec3& b = pieces.vertices[piece.firstVertex + (i + 1) % piece.vertexCount];
      ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
      --edges[{b.x, b.y, b.z, a.x, a.y, a.z}];
    }
  }
  std::erase_if(edges, [](const auto& edge) { return edge.second <= 0; });
  return edges;
}

TEST(WedgePieces, AddUpToTheLoopAndNothingElse) {
  std::mt19937 random(7);
  for (std::uint32_t vertices = 3; vertices <= 200; ++vertices) {
    scene::LightSilhouettes silhouettes;
    addCaster(silhouettes, vertices, 3.0, -2.0, 0.5, random);
    WedgePieces pieces;
    makeWedgePieces(silhouettes, 1.0, pieces);
    const auto edges = edgesOf(pieces);
    EXPECT_EQ(edges.size(), vertices);
    const glm::dvec3 grid(pieces.stepAB, pieces.stepAB, pieces.stepH);
    for (std::uint32_t i = 0; i < vertices; ++i) {
      const glm::vec3 a(glm::round(glm::dvec3(silhouettes.points[i]) / grid) * grid);
      const glm::vec3 b(glm::round(glm::dvec3(silhouettes.points[(i + 1) % vertices]) / grid) * grid);
      const auto found = edges.find({a.x, a.y, a.z, b.x, b.y, b.z});
      ASSERT_NE(found, edges.end()) << "edge " << i << " of " << vertices;
      EXPECT_EQ(found->second, 1);
    }
    for (const WedgePiece& piece : pieces.pieces) EXPECT_LE(piece.vertexCount, std::uint32_t{kPieceVertices});
    // At most seven edges a piece, spread evenly, and the chords' own pieces: a sixth more, and so on.
    EXPECT_LE(pieces.pieces.size(), vertices / 5 + 2);
  }
}

TEST(WedgePieces, VolumesHoldEveryReceiverThatTheirVerticesShadow) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  scene::LightSilhouettes silhouettes;
  addCaster(silhouettes, 40, 5.0, 1.0, 0.7, random);
  WedgePieces pieces;
  makeWedgePieces(silhouettes, 1.0, pieces);
  for (const WedgePiece& piece : pieces.pieces) {
    for (int i = 0; i < 1000; ++i) {
      // A point of the piece's hull, seen from a receiver at a point of the light.
      glm::dvec3 point(0.0);
      double sum = 0.0;
      for (std::uint32_t v = 0; v < piece.vertexCount; ++v) {
        const double weight = unit(random);
        point += weight * glm::dvec3(pieces.vertices[piece.firstVertex + v]);
        sum += weight;
      }
      point /= sum;
      const glm::dvec3 light(2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0, 0.0);
      const double h = point.z + (1.0 - point.z) * unit(random);
      const glm::dvec3 receiver = light + (point - light) * (h / point.z);
      EXPECT_GE(h, piece.extent.nearest - 1e-12);
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(glm::dvec2(receiver), piece.extent.low(h) - 1e-9)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::dvec2(receiver), piece.extent.high(h) + 1e-9)));
    }
  }
}

TEST(WedgePieces, CastersOfABatchShadowNoCommonReceiver) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-40.0, 40.0), height(0.2, 0.95), unit(0.0, 1.0);
  scene::LightSilhouettes silhouettes;
  for (int i = 0; i < 60; ++i)
    addCaster(silhouettes, 20, place(random), place(random), height(random), random);
  WedgePieces pieces;
  makeWedgePieces(silhouettes, 1.0, pieces);
  ASSERT_GT(pieces.batchCount, 1u);
  ASSERT_LT(pieces.batchCount, 60u) << "some casters are far apart";
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 receiver(place(random), place(random), unit(random));
    std::map<std::uint32_t, int> inside;
    for (const WedgeCaster& caster : pieces.casters) {
      if (receiver.z < caster.extent.nearest) continue;
      const glm::dvec2 low = caster.extent.low(receiver.z), high = caster.extent.high(receiver.z);
      const glm::dvec2 at(receiver);
      if (glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high)))
        EXPECT_EQ(++inside[caster.batch], 1);
    }
  }
}

}  // namespace
}  // namespace halfshadow::techniques
