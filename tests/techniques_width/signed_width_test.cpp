// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The two-sided width map against distances and sums computed by brute force from the depth map's own
// silhouette.
#include "techniques/shadow_width/signed_width.hpp"

#include <algorithm>
#include <cmath>

#include "light_rig.hpp"
#include "techniques/shadow_width/paper_width.hpp"

namespace halfshadow::test {
namespace {
using techniques::MapContent;
using techniques::SignedWidthMap;
using techniques::WidthBuild;

/// What width_distance.glsl packs, in texels.
double unpackedDistance(int byte, const SignedWidthMap& map) {
  const double share = std::clamp((byte - 127) / 127.0, -1.0, 1.0);
  return share * map.kneeTexels / (map.kneeTexels / map.reachTexels + 1.0 - std::abs(share));
}
/// Width of a storage step there.
double stepAt(double distance, const SignedWidthMap& map) {
  const double sum = map.kneeTexels + std::abs(distance);
  return sum * sum / (map.kneeTexels * (map.kneeTexels + map.reachTexels) / map.reachTexels) / 127.0;
}

struct Planned {
  LightRig rig;
  SignedWidthMap map;
  Planned(gl::Context& context, const scene::SceneDescription& scene, int side) : rig(context, scene, side) {
    techniques::PassPlan plan;
    map = planMap(rig.scene(), plan);
  }
  static SignedWidthMap planMap(const techniques::LightScene& light, techniques::PassPlan& plan) {
    const auto depth = techniques::planLightDepth(light, light.center, plan, MapContent::casters);
    return techniques::planSignedWidth(light, plan, depth, techniques::WidthCorners::receivers);
  }
  std::vector<std::uint8_t> runMap() {
    return rig.run([](const auto& light, techniques::PassPlan& plan) { return planMap(light, plan).map; });
  }
  std::vector<std::uint8_t> runBoxes() {
    return rig.run(
        [](const auto& light, techniques::PassPlan& plan) { return planMap(light, plan).boxes.atlas; });
  }
};

std::vector<std::uint8_t> occlusionOf(gl::Context& context, const scene::SceneDescription& scene, int side) {
  LightRig rig(context, scene, side);
  const std::vector<std::uint8_t> rgba = rig.run([](const auto& light, techniques::PassPlan& plan) {
    const auto depth = techniques::planLightDepth(light, light.center, plan, MapContent::casters);
    techniques::planPaperWidth(light, plan, depth, techniques::widthSteps(3, 4), WidthBuild::gpu);
    return imageNamed(plan, "light 0 shadow width occlusion");
  });
  std::vector<std::uint8_t> occluded;
  for (std::size_t i = 0; i < rgba.size(); i += 4) occluded.push_back(rgba[i]);
  return occluded;
}

using SignedWidth = GlTest;

TEST_F(SignedWidth, HoldsTheDistanceToTheSilhouette) {
  constexpr int kSide = 512;
  for (const char* name : {"box@light=1", "spheres27@light=1", "figure@light=0.3"}) {
    scene::SceneDescription scene = openBuiltin(name);
    // A light of another shape stretches the width map's texels.
    if (scene.name.find("figure") != std::string::npos) scene.lights[0].halfV *= 0.3;
    Planned planned(context(), scene, kSide);
    const SignedWidthMap& map = planned.map;
    const std::vector<std::uint8_t> pixels = planned.runMap();
    const std::vector<std::uint8_t> occlusion = occlusionOf(context(), scene, kSide);
    const auto occluded = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < kSide && y < kSide &&
             occlusion[static_cast<std::size_t>(y * kSide + x)] != 0;
    };
    // Borders between depth texels, in texels of the width map.
    const glm::dvec2 scale = 1.0 / map.depthTexelsPerTexel;
    std::vector<glm::dvec2> silhouette;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (occluded(x, y) != occluded(x + 1, y)) silhouette.push_back(scale * glm::dvec2(x + 1.0, y + 0.5));
        if (occluded(x, y) != occluded(x, y + 1)) silhouette.push_back(scale * glm::dvec2(x + 0.5, y + 1.0));
      }
    }
    double sum = 0.0, worst = 0.0, count = 0.0;
    for (int y = 0; y < map.height; y += 3) {
      for (int x = 0; x < map.width; x += 3) {
        const glm::dvec2 at(x + 0.5 - map.margin, y + 0.5 - map.margin);
        double nearest = 1e9;
        for (const glm::dvec2& point : silhouette) nearest = std::min(nearest, glm::length(point - at));
        if (nearest > map.reachTexels - 1.0) continue;
        const double stored = unpackedDistance(pixels[4 * static_cast<std::size_t>(y * map.width + x)], map);
        const double error = std::abs(std::abs(stored) - nearest) - stepAt(nearest, map);
        sum += std::max(error, 0.0), count += 1.0;
        worst = std::max(worst, error);
        const glm::dvec2 depthTexel = at * map.depthTexelsPerTexel;
        // On the silhouette's own texels the side is a matter of rounding.
        if (nearest > 1.0) {
          EXPECT_EQ(stored > 0.0, occluded(static_cast<int>(std::floor(depthTexel.x)),
                                           static_cast<int>(std::floor(depthTexel.y))));
        }
      }
    }
    ASSERT_GT(count, 300.0) << name;
    std::printf("%s: mean %.4f worst %.3f of %g, reach %g, texels %g x %g\n", name, sum / count, worst, count,
                map.reachTexels, map.depthTexelsPerTexel.x, map.depthTexelsPerTexel.y);
    // Coverage knows an edge to a tenth of a texel; the depth texels of the brute force are a quarter of one.
    EXPECT_LT(sum / count, 0.1) << name;
    // Gaps and casters narrower than a texel have no coverage of one half: they may be missed.
    EXPECT_LT(worst, 3.0) << name;
  }
}

TEST_F(SignedWidth, BoxesHoldTheOccupiedShare) {
  constexpr int kSide = 256;
  const scene::SceneDescription scene = openBuiltin("box@light=1");
  Planned planned(context(), scene, kSide);
  const SignedWidthMap& map = planned.map;
  const std::vector<std::uint8_t> atlas = planned.runBoxes();
  const std::vector<std::uint8_t> occlusion = occlusionOf(context(), scene, kSide);
  const int rowTexels = 2 * map.width;
  int checked = 0;
  for (int tile = 0; tile < map.boxes.tiles; ++tile) {
    for (int larger = 0; larger < 2; ++larger) {
      const int level = tile + 1 + larger;
      const int side = 1 << level;
      // The boxes' centre relative to that of the texel: that of the tile's smaller boxes.
      const double center = (1.0 - std::pow(-2.0, tile + 1)) / 6.0;
      for (int y = 20; y < map.height - 20; y += 7) {
        for (int x = 20; x < map.width - 20; x += 7) {
          const glm::dvec2 low =
              (glm::dvec2(x, y) + 0.5 + center - 0.5 * side - double(map.margin)) * map.depthTexelsPerTexel;
          const glm::dvec2 high = low + double(side) * map.depthTexelsPerTexel;
          double share = 0.0, texels = 0.0;
          for (int v = static_cast<int>(std::ceil(low.y - 0.5)); v + 0.5 < high.y; ++v) {
            for (int u = static_cast<int>(std::ceil(low.x - 0.5)); u + 0.5 < high.x; ++u) {
              texels += 1.0;
              if (u >= 0 && v >= 0 && u < kSide && v < kSide)
                share += occlusion[static_cast<std::size_t>(v * kSide + u)] != 0;
            }
          }
          const int column = (tile % 2) * map.width + x, row = (tile / 2) * map.height + y;
          const double stored =
              atlas[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(rowTexels) +
                         static_cast<std::size_t>(column)) +
                    2 * static_cast<std::size_t>(larger)] /
              255.0;
          // Half a step of rounding a level; and texels that are no whole number of depth texels wide count
          // those on their border twice or not at all.
          EXPECT_NEAR(stored, share / texels, 0.5 * (level + 1) / 255.0 + 1.0 / side) << "level " << level;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 500);
}

TEST_F(SignedWidth, EmptyDepthHoldsNoSilhouette) {
  // A single far texel-sized caster leaves nearly all of the map without a silhouette in reach: distance
  // -reach, lit.
  Planned planned(context(), openBuiltin("box@light=0.05"), 256);
  const SignedWidthMap& map = planned.map;
  const std::vector<std::uint8_t> pixels = planned.runMap();
  EXPECT_EQ(pixels[0], 0) << "corner of the margin: outside by the reach or more";
  EXPECT_GT(map.margin, 0);
}

}  // namespace
}  // namespace halfshadow::test
