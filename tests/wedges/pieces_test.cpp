// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Silhouettes cut into pieces: nothing is lost, nothing is added, and the volumes hold all that they must.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "outlines/wedge_pieces.hpp"

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

/// Of a light a quarter as large as its distance.
constexpr glm::dvec3 kUnits(4.0, 4.0, 1.0);

using Edge = std::array<double, 6>;

/// How often each edge is run through, one way minus the other.
std::map<Edge, int> edgesOf(const outlines::WedgePieces& pieces) {
  std::map<Edge, int> edges;
  for (const outlines::WedgePiece& piece : pieces.pieces) {
    for (std::uint32_t i = 0; i < piece.vertexCount; ++i) {
      const glm::dvec3& a = pieces.vertices[piece.firstVertex + i];
      const glm::dvec3& b = pieces.vertices[piece.firstVertex + (i + 1) % piece.vertexCount];
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
    outlines::WedgePieces pieces;
    makeWedgePieces(silhouettes, kUnits, 1.0, pieces);
    const auto edges = edgesOf(pieces);
    EXPECT_EQ(edges.size(), vertices);
    ASSERT_EQ(pieces.casters.size(), 1u);
    const glm::dvec3 grid = pieces.casters[0].step * pieces.units, anchor(0, 0, 1);
    for (std::uint32_t i = 0; i < vertices; ++i) {
      const glm::dvec3 a = anchor + glm::round((silhouettes.points[i] - anchor) / grid) * grid;
      const glm::dvec3 b =
          anchor + glm::round((silhouettes.points[(i + 1) % vertices] - anchor) / grid) * grid;
      const auto found = edges.find({a.x, a.y, a.z, b.x, b.y, b.z});
      ASSERT_NE(found, edges.end()) << "edge " << i << " of " << vertices;
      EXPECT_EQ(found->second, 1);
    }
    for (const outlines::WedgePiece& piece : pieces.pieces)
      EXPECT_LE(piece.vertexCount, std::uint32_t{outlines::kPieceVertices});
    // At most seven edges a piece, spread evenly, and the chords' own pieces: a sixth more, and so on.
    EXPECT_LE(pieces.pieces.size(), vertices / 5 + 2);
  }
}

TEST(WedgePieces, VolumesHoldEveryReceiverThatTheirVerticesShadow) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  scene::LightSilhouettes silhouettes;
  addCaster(silhouettes, 40, 5.0, 1.0, 0.7, random);
  outlines::WedgePieces pieces;
  makeWedgePieces(silhouettes, kUnits, 1.0, pieces);
  for (const outlines::WedgePiece& piece : pieces.pieces) {
    for (int i = 0; i < 1000; ++i) {
      // A point of the piece's hull, seen from a receiver at a point of the light.
      glm::dvec3 point(0.0);
      double sum = 0.0;
      for (std::uint32_t v = 0; v < piece.vertexCount; ++v) {
        const double weight = unit(random);
        point += weight * pieces.vertices[piece.firstVertex + v];
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
  outlines::WedgePieces pieces;
  makeWedgePieces(silhouettes, kUnits, 1.0, pieces);
  ASSERT_GT(pieces.batchCount, 1u);
  ASSERT_LT(pieces.batchCount, 60u) << "some casters are far apart";
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 receiver(place(random), place(random), unit(random));
    std::map<std::uint32_t, int> inside;
    for (const outlines::WedgeCaster& caster : pieces.casters) {
      if (receiver.z < caster.extent.nearest) continue;
      const glm::dvec2 low = caster.extent.low(receiver.z), high = caster.extent.high(receiver.z);
      const glm::dvec2 at(receiver);
      if (glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high)))
        EXPECT_EQ(++inside[caster.batch], 1);
    }
  }
}

TEST(WedgePieces, GridsAreTheCastersOwn) {
  // A caster's vertices are what they are with another a thousand or a million times as far away.
  std::mt19937 random(17);
  scene::LightSilhouettes near;
  addCaster(near, 20, 3.0, -2.0, 0.5, random);
  outlines::WedgePieces alone;
  makeWedgePieces(near, kUnits, 1e9, alone);
  for (const double away : {1e3, 1e6}) {
    scene::LightSilhouettes both = near;
    addCaster(both, 20, 3.0 * away, -2.0 * away, 0.5 * away, random);
    outlines::WedgePieces pieces;
    makeWedgePieces(both, kUnits, 1e9, pieces);
    ASSERT_GE(pieces.vertices.size(), alone.vertices.size());
    for (std::size_t i = 0; i < alone.vertices.size(); ++i)
      EXPECT_EQ(pieces.vertices[i], alone.vertices[i]) << away;
    // What stands far away keeps what single precision holds there.
    EXPECT_LE(pieces.casters[1].step, 1.2e-6 * away);
  }
}

TEST(WedgePieces, VerticesAreBeforeTheLight) {
  std::mt19937 random(19);
  for (const double height : {1e-6, 1e-5, 1e-3, 1.0}) {
    for (const double away : {0.0, 1e2, 1e6}) {
      scene::LightSilhouettes silhouettes;
      addCaster(silhouettes, 30, away, 0.0, height, random);
      outlines::WedgePieces pieces;
      makeWedgePieces(silhouettes, kUnits, 1e9, pieces);
      for (const glm::dvec3& vertex : pieces.vertices) EXPECT_GT(vertex.z, 0.0) << height << " " << away;
    }
  }
}

}  // namespace
}  // namespace halfshadow::techniques
