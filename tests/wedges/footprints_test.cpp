// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Receivers cut to what pieces of silhouettes can shadow: nothing missing, nothing twice; and where on the
// screen volumes can be.
#include "outlines/footprints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <set>

namespace halfshadow::techniques {
namespace {

/// Emits downwards from y = 10; heights are in units of 10.
scene::LightPlane lightPlane() {
  scene::AreaLight light;
  light.centerWorld = {0, 10, 0};
  light.halfU = {0.5, 0, 0};
  light.halfV = {0, 0, 0.5};
  return {light, 10.0, 1e-3};
}

/// One polygon at about half the height.
outlines::WedgePieces somePiece(std::mt19937& random) {
  std::uniform_real_distribution<double> jitter(0.7, 1.0);
  scene::LightSilhouettes silhouettes;
  for (int i = 0; i < 7; ++i) {
    const double angle = 6.283185307179586 * i / 7.0;
    silhouettes.points.emplace_back(3.0 * jitter(random) * std::cos(angle),
                                    3.0 * jitter(random) * std::sin(angle), 0.5 * jitter(random));
  }
  silhouettes.loops.push_back({0, 7});
  silhouettes.casters.push_back({.firstLoop = 0, .loopCount = 1});
  outlines::WedgePieces pieces;
  makeWedgePieces(silhouettes, {16.0, 16.0, 1.0}, 1.01, pieces);
  EXPECT_EQ(pieces.pieces.size(), 1u);
  return pieces;
}

glm::dvec3 weights(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double area = glm::dot(n, n);
  return {glm::dot(n, glm::cross(c - b, p - b)) / area, glm::dot(n, glm::cross(a - c, p - c)) / area,
          glm::dot(n, glm::cross(b - a, p - a)) / area};
}

bool inVolume(const outlines::WedgeExtent& extent, const glm::dvec3& abh, double inwards) {
  const glm::dvec2 low = extent.low(abh.z) + inwards, high = extent.high(abh.z) - inwards;
  return abh.z > extent.nearest + inwards && abh.x > low.x && abh.y > low.y && abh.x < high.x &&
         abh.y < high.y;
}

TEST(Footprints, CoverTheVolumesPartOnceAndCarryTheProjectedPiece) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0), wide(-12.0, 12.0), height(0.0, 9.0);
  const scene::LightPlane plane = lightPlane();
  int inside = 0, outside = 0, besides = 0;
  for (int round = 0; round < 300; ++round) {
    const outlines::WedgePieces pieces = somePiece(random);
    const outlines::WedgePiece& piece = pieces.pieces[0];
    scene::TriangleMesh mesh;
    for (int i = 0; i < 3; ++i) mesh.positions.emplace_back(wide(random), height(random), wide(random));
    mesh.indices = {0, 1, 2};
    const outlines::ReceiverTriangles receiver(mesh, glm::dmat4(1.0), plane);
    outlines::Footprints footprints;
    addFootprints(receiver, pieces, piece, footprints);
    besides += footprints.beside.empty() ? 0 : 1;
    for (const outlines::FootprintVertex& vertex : footprints.beyond) {
      for (const float w : vertex.w) EXPECT_GE(w, 0.999e-3f);
    }
    std::vector<outlines::FootprintVertex> all = footprints.beside;
    all.insert(all.end(), footprints.beyond.begin(), footprints.beyond.end());
    ASSERT_EQ(all.size() % 3, 0u);
    for (int i = 0; i < 100; ++i) {
      const double s = std::sqrt(unit(random)), t = unit(random);
      const glm::dvec3 point = (1.0 - s) * glm::dvec3(mesh.positions[0]) +
                               s * (1.0 - t) * glm::dvec3(mesh.positions[1]) +
                               s * t * glm::dvec3(mesh.positions[2]);
      const glm::dvec3 abh = plane.fromWorld(point);
      const bool in = inVolume(piece.extent, abh, 1e-3), out = !inVolume(piece.extent, abh, -1e-3);
      if (!in && !out) continue;
      int holding = 0, touching = 0;
      for (std::size_t first = 0; first < all.size(); first += 3) {
        const outlines::FootprintVertex &a = all[first], &b = all[first + 1], &c = all[first + 2];
        const glm::dvec3 w = weights(glm::dvec3(a.positionObject), glm::dvec3(b.positionObject),
                                     glm::dvec3(c.positionObject), point);
        const double least = std::min({w.x, w.y, w.z});
        // Slivers have no weights to speak of; points on seams belong to either side.
        if (!(least > -1e-4)) continue;
        ++touching;
        if (least < 1e-4) continue;
        ++holding;
        for (std::uint32_t k = 0; k < outlines::kPieceVertices; ++k) {
          const glm::dvec3& e = pieces.vertices[piece.firstVertex + std::min(k, piece.vertexCount - 1)];
          const double size = piece.size();
          EXPECT_NEAR(size * (w.x * a.x[k] + w.y * b.x[k] + w.z * c.x[k]), abh.z * e.x - e.z * abh.x, 1e-4);
          EXPECT_NEAR(size * (w.x * a.y[k] + w.y * b.y[k] + w.z * c.y[k]), abh.z * e.y - e.z * abh.y, 1e-4);
          EXPECT_NEAR(size * (w.x * a.w[k] + w.y * b.w[k] + w.z * c.w[k]), abh.z - e.z, 1e-5);
        }
      }
      if (in) {
        EXPECT_GE(touching, 1) << "round " << round;
        EXPECT_LE(holding, 1) << "round " << round;
        ++inside;
      } else {
        EXPECT_EQ(holding, 0) << "round " << round;
        ++outside;
      }
    }
  }
  // The test met what it is about.
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
  EXPECT_GT(besides, 10);
}

TEST(Footprints, NeighboursAreCutAtTheSamePoints) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> wide(-12.0, 12.0), height(0.0, 4.0);
  int cuts = 0;
  for (int round = 0; round < 200; ++round) {
    const outlines::WedgePieces pieces = somePiece(random);
    scene::TriangleMesh mesh;
    for (int i = 0; i < 4; ++i) mesh.positions.emplace_back(wide(random), height(random), wide(random));
    const auto cutPoints = [&](std::vector<std::uint32_t> indices) {
      scene::TriangleMesh one = mesh;
      one.indices = std::move(indices);
      outlines::Footprints footprints;
      addFootprints(outlines::ReceiverTriangles(one, glm::dmat4(1.0), lightPlane()), pieces, pieces.pieces[0],
                    footprints);
      const glm::dvec3 from(mesh.positions[0]), along = glm::normalize(glm::dvec3(mesh.positions[1]) - from);
      std::set<std::array<float, 3>> points;
      for (const auto* part : {&footprints.beside, &footprints.beyond}) {
        for (const outlines::FootprintVertex& vertex : *part) {
          const glm::dvec3 p = glm::dvec3(vertex.positionObject) - from;
          if (glm::length(p - glm::dot(p, along) * along) < 1e-5)
            points.insert({vertex.positionObject.x, vertex.positionObject.y, vertex.positionObject.z});
        }
      }
      return points;
    };
    const auto left = cutPoints({0, 1, 2}), right = cutPoints({1, 0, 3});
    if (left.empty() || right.empty()) continue;
    ++cuts;
    EXPECT_EQ(left, right) << "round " << round;
  }
  EXPECT_GT(cuts, 20);
}

TEST(WedgeBounds, ScreenRectanglesHoldWhatTheCameraSees) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> wide(-6.0, 6.0), unit(0.0, 1.0);
  constexpr int kWide = 200, kHigh = 150;
  // The same in units of any size: powers of two, so that no bit of the rectangles may differ.
  const auto inUnits = [](double unit) {
    return glm::perspective(1.0, 4.0 / 3.0, 0.1 * unit, 100.0 * unit) *
           glm::lookAt(unit * glm::dvec3(0, 1, 4), glm::dvec3(0), glm::dvec3(0, 1, 0));
  };
  const glm::dmat4 clipFromWorld = inUnits(1.0);
  int seen = 0, smaller = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<glm::dvec3> hull;
    const glm::dvec3 center(wide(random), wide(random), wide(random));
    for (int i = 0; i < 8; ++i)
      hull.push_back(center + 0.3 * glm::dvec3(wide(random), wide(random), wide(random)));
    const auto rect = outlines::screenBounds(hull, clipFromWorld, kWide, kHigh);
    if (rect && rect->width * rect->height < kWide * kHigh) ++smaller;
    for (const double unit : {0x1p-96, 0x1p-40, 0x1p96}) {
      std::vector<glm::dvec3> resized = hull;
      for (glm::dvec3& corner : resized) corner *= unit;
      EXPECT_EQ(outlines::screenBounds(resized, inUnits(unit), kWide, kHigh), rect)
          << "round " << round << ", units of " << unit;
    }
    for (int i = 0; i < 100; ++i) {
      glm::dvec3 point(0.0);
      double sum = 0.0;
      for (const glm::dvec3& corner : hull) {
        const double weight = unit(random);
        point += weight * corner, sum += weight;
      }
      const glm::dvec4 clip = clipFromWorld * glm::dvec4(point / sum, 1.0);
      if (clip.z < -clip.w || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
      ++seen;
      ASSERT_TRUE(rect) << "round " << round;
      const glm::dvec2 window = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(kWide, kHigh);
      EXPECT_TRUE(window.x >= rect->x && window.x <= rect->x + rect->width && window.y >= rect->y &&
                  window.y <= rect->y + rect->height)
          << "round " << round;
    }
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(smaller, 100);
}

TEST(WedgeBounds, DisjointRectanglesHoldAllAndMeetNowhere) {
  std::mt19937 random(29);
  std::uniform_int_distribution<int> place(0, 90), size(1, 12);
  for (int round = 0; round < 100; ++round) {
    std::vector<Rect> rects;
    for (int i = 0; i < 20; ++i) rects.push_back({place(random), place(random), size(random), size(random)});
    const std::vector<Rect> apart = outlines::disjointRects(rects);
    for (std::size_t i = 0; i < apart.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(outlines::commonRect(apart[i], apart[k]));
    for (const Rect& rect : rects) {
      EXPECT_EQ(
          std::ranges::count_if(apart, [&](const Rect& r) { return outlines::commonRect(r, rect) == rect; }),
          1);
    }
  }
}

}  // namespace
}  // namespace halfshadow::techniques
