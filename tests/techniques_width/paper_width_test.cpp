// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The paper's width map: the same on GPU and CPU, and close to the distances that it stands for.
#include "techniques/shadow_width/paper_width.hpp"

#include <algorithm>
#include <cmath>

#include "light_rig.hpp"

namespace halfshadow::test {
namespace {
using techniques::LightDepth;
using techniques::MapContent;
using techniques::WidthBuild;
using techniques::WidthStep;

std::vector<std::uint8_t> firstChannel(const std::vector<std::uint8_t>& rgba) {
  std::vector<std::uint8_t> channel;
  for (std::size_t i = 0; i < rgba.size(); i += 4) channel.push_back(rgba[i]);
  return channel;
}

struct Maps {
  std::vector<std::uint8_t> occlusion, width;
};
Maps mapsOf(gl::Context& context, const std::string& scene, int side, const std::vector<WidthStep>& steps,
            WidthBuild build, MapContent content = MapContent::casters) {
  Maps maps;
  LightRig rig(context, openBuiltin(scene), side);
  const auto planWidth = [&](const techniques::LightScene& light, techniques::PassPlan& plan) {
    const LightDepth depth = techniques::planLightDepth(light, light.center, plan, content);
    return techniques::planPaperWidth(light, plan, depth, steps, build);
  };
  maps.width = firstChannel(rig.run(planWidth));
  maps.occlusion = firstChannel(rig.run([&](const techniques::LightScene& light, techniques::PassPlan& plan) {
    planWidth(light, plan);
    return imageNamed(plan, "light 0 shadow width occlusion");
  }));
  return maps;
}

using PaperWidth = GlTest;

TEST_F(PaperWidth, BuildsAreEqualToTheByte) {
  for (const int neighbours : {3, 6}) {
    for (const int start : {4, 64, 256}) {
      const auto steps = techniques::widthSteps(neighbours, start);
      Maps gpu = mapsOf(context(), "figure@light=1", 128, steps, WidthBuild::gpu);
      const Maps cpu = mapsOf(context(), "figure@light=1", 128, steps, WidthBuild::cpu);
      EXPECT_EQ(gpu.occlusion, cpu.occlusion);
      // 0 LSB: both add and compare whole bytes.
      EXPECT_EQ(gpu.width, cpu.width) << neighbours << " neighbours, start 1/" << start;
      techniques::widthMapOnCpu(gpu.occlusion, 128, steps);
      EXPECT_EQ(gpu.occlusion, gpu.width);
    }
  }
}

TEST_F(PaperWidth, StepsDoubleUntilTheDifferenceIsOne) {
  // 1/256 is one byte: 1, 2 … 128; the next would be 256. 1/4 is 64 bytes: 64, 128.
  EXPECT_EQ(techniques::widthSteps(6, 256).size(), 8u);
  EXPECT_EQ(techniques::widthSteps(6, 4).size(), 2u);
  const auto steps = techniques::widthSteps(3, 16);
  ASSERT_EQ(steps.size(), 4u);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].differenceBytes, 16 << i);
    EXPECT_EQ(steps[i].neighbours.size(), 3u);
    for (const auto& offset : steps[i].neighbours) {
      // Rounded to whole texels along both axes.
      EXPECT_NEAR(std::hypot(offset.x, offset.y), std::exp2(i), std::sqrt(0.5));
    }
  }
}

/// Distance in texels from every occluded texel to the nearest lit one.
std::vector<double> distances(const std::vector<std::uint8_t>& occlusion, int side) {
  std::vector<double> result(occlusion.size(), 0.0);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (occlusion[static_cast<std::size_t>(y * side + x)] == 0) continue;
      double best = 1e9;
      for (int v = 0; v < side; ++v) {
        for (int u = 0; u < side; ++u) {
          if (occlusion[static_cast<std::size_t>(v * side + u)] == 0)
            best = std::min(best, std::hypot(u - x, v - y));
        }
      }
      result[static_cast<std::size_t>(y * side + x)] = best;
    }
  }
  return result;
}

TEST_F(PaperWidth, ApproximatesDistances) {
  constexpr int kSide = 64;
  for (const int neighbours : {3, 6}) {
    const Maps maps =
        mapsOf(context(), "box@light=1", kSide, techniques::widthSteps(neighbours, 256), WidthBuild::gpu);
    const std::vector<double> truth = distances(maps.occlusion, kSide);
    double worst = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_EQ(maps.width[i] == 0, truth[i] == 0.0);
      if (truth[i] == 0.0) continue;
      const double error = std::abs(maps.width[i] - truth[i]);
      worst = std::max(worst, error / truth[i]);
      sum += error / truth[i], count += 1.0;
    }
    ASSERT_GT(count, 500.0);
    std::printf("%d neighbours: mean %.3f worst %.3f\n", neighbours, sum / count, worst);
    EXPECT_LT(sum / count, neighbours == 6 ? 0.15 : 0.30);
  }
}

TEST_F(PaperWidth, BackFacesCoverTheSameTexels) {
  const auto steps = techniques::widthSteps(6, 256);
  const Maps front = mapsOf(context(), "figure@light=1", 128, steps, WidthBuild::gpu);
  const Maps back =
      mapsOf(context(), "figure@light=1", 128, steps, WidthBuild::gpu, MapContent::castersFarthest);
  // Closed casters: both kinds of faces have the same silhouette. A texel centre on it may fall to either.
  std::size_t different = 0, occluded = 0;
  for (std::size_t i = 0; i < front.occlusion.size(); ++i) {
    different += front.occlusion[i] != back.occlusion[i];
    occluded += front.occlusion[i] != 0;
  }
  EXPECT_GT(occluded, 1000u);
  EXPECT_LE(different, occluded / 200);
}

}  // namespace
}  // namespace halfshadow::test
