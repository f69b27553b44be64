// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Simplified loops against whole ones: the same coverage of every cell for every receiver of the box.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "coverage/trapezoid.hpp"
#include "outlines/outline_detail.hpp"
#include "outlines/tile_lists.hpp"
#include "scenes/builtin_scenes.hpp"

namespace halfshadow::techniques {
namespace {

/// Occluded shares of the four cells of a sub-light.
std::array<double, 4> cellsOf(const outlines::CasterLoops& caster, const outlines::SubLight& light,
                              const glm::dvec3& receiver) {
  std::array<double, 4> covered{};
  std::vector<coverage::Projected<double>> projected;
  std::vector<coverage::FlatPoint<double>> flat;
  for (const outlines::CasterLoops::Loop& loop : caster.loops) {
    projected.clear();
    for (std::uint32_t k = 0; k < loop.count; ++k) {
      const glm::dvec3 q = glm::dvec3(caster.points[loop.first + k]) - receiver;
      projected.push_back(
          {(q.x - light.center.x * q.z) / light.half, (q.y - light.center.y * q.z) / light.half, q.z});
    }
    coverage::clipNear<double>(projected, 1e-7, flat);
    for (int cell = 0; cell < 4; ++cell) {
      covered[static_cast<std::size_t>(cell)] +=
          coverage::loopCoverage<double>(flat, {cell % 2 == 0 ? -1.0 : 0.0, cell < 2 ? -1.0 : 0.0, 1.0, 1.0});
    }
  }
  return covered;
}

/// A loop of `count` vertices around `center`, counter-clockwise; `turns` of its radii differ.
outlines::CasterLoops wreath(std::mt19937& random, int count, const glm::vec3& center, float radius,
                             float rise) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<glm::vec3> loop;
  for (int k = 0; k < count; ++k) {
    const float angle =
        6.2831853f * (static_cast<float>(k) + 0.8f * unit(random)) / static_cast<float>(count);
    const float r = radius * (0.5f + unit(random));
    loop.emplace_back(center.x + r * std::cos(angle), center.y + r * std::sin(angle),
                      center.z + rise * (unit(random) - 0.5f));
  }
  outlines::CasterLoops caster;
  caster.addLoop(loop);
  return caster;
}

TEST(CellLoops, SimplifiedLoopsCoverTheSameCells) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  int dropped = 0, full = 0, partial = 0;
  std::size_t before = 0, after = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const outlines::SubLight light = outlines::subLights()[static_cast<std::size_t>(trial % 4)];
    const float gap = 0.02f + 0.6f * unit(random);
    outlines::TangentBox box;
    box.tLow = glm::vec2(unit(random), unit(random)) - 0.5f;
    box.tHigh = box.tLow + 0.05f * glm::vec2(unit(random), unit(random));
    box.iLow = 1.0f;
    box.iHigh = 1.0f + 0.05f * unit(random);
    // Half of the casters cross the receivers' heights.
    const float rise = trial % 2 == 0 ? 0.0f : 2.5f * gap;
    const outlines::CasterLoops whole = wreath(
        random, 3 + trial % 20, {2.0f * unit(random) - 1.0f, 2.0f * unit(random) - 1.0f, box.iHigh + gap},
        0.05f + unit(random), rise);
    outlines::CasterLoops simplified;
    outlines::SimplifyScratch scratch;
    const outlines::Coverage coverage = simplify(whole, light, box, scratch, simplified);
    dropped += coverage == outlines::Coverage::none;
    full += coverage == outlines::Coverage::full;
    partial += coverage == outlines::Coverage::partial;
    if (coverage == outlines::Coverage::partial) {
      before += whole.points.size();
      after += simplified.points.size();
    }
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 receiver(glm::mix(box.tLow.x, box.tHigh.x, unit(random)),
                                glm::mix(box.tLow.y, box.tHigh.y, unit(random)),
                                glm::mix(box.iLow, box.iHigh, unit(random)));
      const auto expected = cellsOf(whole, light, receiver);
      const auto actual = cellsOf(simplified, light, receiver);
      for (std::size_t cell = 0; cell < 4; ++cell) {
        const double value = coverage == outlines::Coverage::full ? 1.0 : actual[cell];
        // Vertices are single precision and w as small as 1e-2 here: 1e-7 / 1e-2 each, a few at once.
        ASSERT_NEAR(value, expected[cell], 1e-4) << "trial " << trial << " cell " << cell;
      }
    }
  }
  // All three answers must have been met, or the test has seen little.
  EXPECT_GT(dropped, 1000);
  EXPECT_GT(full, 200);
  EXPECT_GT(partial, 5000);
  EXPECT_LT(after, before / 2 * 2) << "simplification must shorten lists";
  std::printf("none %d, full %d, partial %d; vertices %zu -> %zu\n", dropped, full, partial, before, after);
}

TEST(OutlineDetail, WhatIsLeftOutChangesNoMoreOfTheLightThanWasAsked) {
  std::mt19937 random(19);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  constexpr double kShare = 0.002;
  double largest = 0.0, squares = 0.0;
  int seen = 0;
  std::size_t before = 0, after = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const float gap = 0.05f + unit(random);
    outlines::TangentBox box;
    box.tLow = glm::vec2(unit(random), unit(random)) - 0.5f;
    box.tHigh = box.tLow + 0.05f * glm::vec2(unit(random), unit(random));
    box.iLow = 1.0f;
    box.iHigh = 1.0f + 0.05f * unit(random);
    // Smooth and toothed outlines, about as large as the light and some times larger or smaller.
    const int count = 8 << (trial % 6);
    const float radius = gap * std::exp2(4.0f * unit(random) - 2.0f),
                teeth = trial % 3 == 0 ? 0.0f : 0.2f * unit(random);
    std::vector<glm::vec3> loop;
    const glm::vec2 center =
        glm::vec2(unit(random), unit(random)) - 0.5f + radius * (2.0f * unit(random) - 1.0f);
    for (int k = 0; k < count; ++k) {
      const float angle = 6.2831853f * static_cast<float>(k) / static_cast<float>(count);
      const float r = radius * (1.0f + teeth * (unit(random) - 0.5f));
      loop.emplace_back(center.x + r * std::cos(angle), center.y + r * std::sin(angle),
                        box.iHigh + gap * (1.0f + 0.3f * teeth * unit(random)));
    }
    outlines::CasterLoops whole;
    whole.addLoop(loop);
    outlines::CasterLoops fewer = whole;
    dropDetail(fewer, box, 0.0);
    ASSERT_EQ(fewer.points, whole.points);
    dropDetail(fewer, box, kShare);
    before += whole.points.size();
    after += fewer.points.size();
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 receiver(glm::mix(box.tLow.x, box.tHigh.x, unit(random)),
                                glm::mix(box.tLow.y, box.tHigh.y, unit(random)),
                                glm::mix(box.iLow, box.iHigh, unit(random)));
      const auto expected = cellsOf(whole, outlines::kWholeLight, receiver);
      const auto actual = cellsOf(fewer, outlines::kWholeLight, receiver);
      double change = 0.0;
      for (std::size_t cell = 0; cell < 4; ++cell) change += 0.25 * (actual[cell] - expected[cell]);
      largest = std::max(largest, std::abs(change));
      squares += change * change;
      ++seen;
    }
  }
  // The light's sides cut what lies at the ends of a stretch, a quarter of the share each at most.
  EXPECT_LE(largest, 1.5 * kShare);
  EXPECT_GT(largest, 0.2 * kShare) << "nothing was left out";
  EXPECT_LE(std::sqrt(squares / seen), 0.5 * kShare);
  EXPECT_LT(after, before * 6 / 10);
  std::printf("vertices %zu -> %zu; largest change %.5f, rms %.5f\n", before, after, largest,
              std::sqrt(squares / seen));
}

TEST(TileLists, CastersThatAreApartCoverNoPointTwice) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  int apart = 0, together = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    outlines::SubLightLoops loops{.light = outlines::kWholeLight};
    for (int k = 0; k < 2 + trial % 3; ++k) {
      loops.casters.push_back(
          wreath(random, 5 + trial % 9,
                 {2.4f * unit(random) - 1.2f, 2.4f * unit(random) - 1.2f, 1.4f + unit(random)},
                 0.1f + 0.2f * unit(random), 0.2f));
      loops.casters.back().deepest = loops.casters.back().low.z;
    }
    outlines::ReceiverTiles tiles{.columns = 1, .rows = 1};
    outlines::TangentBox box;
    box.tLow = 0.2f * glm::vec2(unit(random), unit(random)) - 0.1f;
    box.tHigh = box.tLow + 0.03f;
    box.iLow = 1.0f;
    box.iHigh = 1.02f;
    tiles.boxes = {box};
    outlines::NearSurfaces none;
    const outlines::TileLists lists = tileLists({&loops, 1}, none, tiles, {}, outlines::ListedEdges::all);
    if (lists.tiles[0].casters < 2) continue;
    if (!lists.tiles[0].apart) {
      ++together;
      continue;
    }
    ++apart;
    for (int r = 0; r < 3; ++r) {
      const glm::dvec3 receiver(glm::mix(box.tLow.x, box.tHigh.x, unit(random)),
                                glm::mix(box.tLow.y, box.tHigh.y, unit(random)),
                                glm::mix(box.iLow, box.iHigh, unit(random)));
      for (int cell = 0; cell < 64; ++cell) {
        // A small light in the cell's place: four cells of it in one go.
        const outlines::SubLight part{{(cell % 8 - 3.5f) / 4.0f, (cell / 8 - 3.5f) / 4.0f}, 0.125f};
        double most = 0.0;
        std::array<double, 4> sum{};
        for (const outlines::CasterLoops& caster : loops.casters) {
          const auto covered = cellsOf(caster, part, receiver);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += covered[c];
        }
        for (const double value : sum) most = std::max(most, value);
        // Loops may run over themselves within a rounding of single precision.
        ASSERT_LE(most, 1.0 + 1e-4) << trial;
      }
    }
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(together, 200);
}

TEST(ReceiverTiles, HoldEverySurfacePoint) {
  // Points of a turned box's light-facing faces lie in the box of their tile.
  const auto light = scene::areaLightFromVectors({0, 12, 0}, {1, 0, 0}, {0, 0, 1});
  ASSERT_TRUE(light.ok());
  auto scene = scenes::makeBuiltinScene("leaves");
  ASSERT_TRUE(scene.ok());
  const scene::LightPlane plane(scene->lights[0], 16.0, 1e-3);
  outlines::TangentRect all{.low = glm::dvec2(-100.0), .high = glm::dvec2(100.0)};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int inside = 0;
  for (const scene::SceneObject& object : scene->objects) {
    const outlines::ReceiverTiles tiles = receiverTiles(
        {.mesh = object.mesh.get(), .worldFromObject = object.worldFromObject, .closed = object.casts}, plane,
        all, 0.05, 64, 1e-3);
    if (tiles.empty()) continue;
    const scene::TriangleMesh& mesh = *object.mesh;
    for (std::size_t f = 0; f + 2 < mesh.indices.size(); f += 3) {
      const auto corner = [&](std::size_t k) {
        return glm::dvec3(object.worldFromObject *
                          glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[f + k]]), 1.0));
      };
      const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
      const glm::dvec3 outward = glm::cross(b - a, c - a);
      if (glm::dot(outward, scene->lights[0].centerWorld - a) <= 0.0) continue;
      for (int k = 0; k < 20; ++k) {
        double s = unit(random), t = unit(random);
        if (s + t > 1.0) s = 1.0 - s, t = 1.0 - t;
        const glm::dvec3 abh = plane.fromWorld(a + s * (b - a) + t * (c - a));
        if (abh.z < 1e-3) continue;
        const glm::dvec3 p = outlines::tangentPoint(abh);
        const glm::ivec2 tile(glm::floor((glm::dvec2(p) - tiles.low) / tiles.tileSize));
        if (tile.x < 0 || tile.y < 0 || tile.x >= tiles.columns || tile.y >= tiles.rows) continue;
        const outlines::TangentBox& box =
            tiles.boxes[static_cast<std::size_t>(tile.y * tiles.columns + tile.x)];
        ASSERT_FALSE(box.empty()) << object.name;
        EXPECT_GE(p.z, box.iLow) << object.name;
        EXPECT_LE(p.z, box.iHigh) << object.name;
        ++inside;
      }
    }
  }
  EXPECT_GT(inside, 5000);
}

}  // namespace
}  // namespace halfshadow::techniques
