// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// wedges-cells against ray-traced truth: 17 configurations of casters and lights.
#include <algorithm>
#include <cstdio>

#include "metrics/metrics.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

const std::vector<std::string> kWedgeScenes = {
    "spheres27@light=0.3", "spheres27@light=1", "spheres27@light=2", "spheres81@light=1", "spheres81@light=2",
    "box@light=0.3",       "box@light=1",       "box@light=2",       "bars@light=1",      "bars@light=2",
    "fence@light=0.3",     "fence@light=1",     "leaves@light=0.3",  "leaves@light=1",    "leaves@light=2",
    "figure@light=0.3",    "figure@light=1"};

Configuration cells(const std::string& bytes) {
  return {"wedges-cells", {{"wedges-cells.bytes", bytes}}};
}

class CellsAccuracy : public SharedEngineTest {
 protected:
  struct Mean {
    double rmse = 0.0, p99 = 0.0, largest = 0.0;
  };
  static std::vector<float> visibility(const std::string& scene, const Configuration& configuration) {
    renderer().load(builtinScene(scene));
    return renderer().render(configuration).visibility();
  }
  /// Penumbra pixels of the ground that no outline of a caster cuts: there, rasterisers and rays see
  /// different surfaces.
  static std::vector<std::uint8_t> judged(const Truth& truth) {
    std::vector<std::uint8_t> pixels = truth.penumbraOnGround();
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = pixels[i] && truth.interior[i];
    return pixels;
  }
  /// `largest` is over all scenes.
  static Mean meanError(const Configuration& configuration) {
    Mean mean;
    const auto share = 1.0 / static_cast<double>(kWedgeScenes.size());
    for (const std::string& scene : kWedgeScenes) {
      const Truth& truth = truthOf(scene);
      const auto error =
          metrics::errorStatistics(visibility(scene, configuration), truth.visibility, judged(truth));
      EXPECT_EQ(error.nanPixels, 0u) << scene;
      mean.rmse += error.rmse * share;
      mean.p99 += error.p99 * share;
      mean.largest = std::max(mean.largest, error.max);
    }
    std::printf("%-34s rmse %.5f, p99 %.4f, largest %.3f\n", configuration.text().c_str(), mean.rmse,
                mean.p99, mean.largest);
    return mean;
  }
  /// fp16 knows a fragment's place to 11 bits: twice the error is the price of a device without highp.
  static double precision() { return isForcedOff("highp") ? 2.0 : 1.0; }
};

TEST_F(CellsAccuracy, SixteenCellsReachTheProjectsFigures) {
  const Mean mean = meanError(cells("16"));
  EXPECT_LE(mean.rmse, 0.0062 * precision());
  EXPECT_LE(mean.p99, 0.024 * precision());
  // In fp16 a vertex next to the receiver projects anywhere: single pixels at contacts, so p99 judges there.
  if (!isForcedOff("highp")) {
    EXPECT_LE(mean.largest, 0.07);
  }
}

TEST_F(CellsAccuracy, MoreCellsErrLess) {
  const Mean few = meanError(cells("4")), many = meanError(cells("32"));
  // One cell a sub-light: .0136 in the prototype.
  EXPECT_LE(few.rmse, 0.0145 * precision());
  EXPECT_LE(many.rmse, 0.0052 * precision());
  EXPECT_LT(many.rmse, few.rmse);
}

TEST_F(CellsAccuracy, OneConvexCasterIsLimitedBySilhouettesAlone) {
  // Four silhouettes for the whole light; one from its centre gives .021 at h = 1 and .029 at h = 2.
  const struct {
    const char* scene;
    double rmse;
  } kBounds[] = {{"box@light=0.3", 0.004}, {"box@light=1", 0.008}, {"box@light=2", 0.008}};
  for (const auto& bound : kBounds) {
    const Truth& truth = truthOf(bound.scene);
    for (const char* bytes : {"4", "16", "32"}) {
      const auto error =
          metrics::errorStatistics(visibility(bound.scene, cells(bytes)), truth.visibility, judged(truth));
      EXPECT_LE(error.rmse, bound.rmse * precision()) << bound.scene << ", " << bytes;
    }
  }
}

TEST_F(CellsAccuracy, CastersReceiveAsWellAsTheGround) {
  if (isForcedOff("highp"))
    GTEST_SKIP() << "without highp a fragment does not know which side of its own facet it is on";
  // Lifted off their facets as the truth's rays are. Silhouettes from a light's centre err by .30.
  for (const std::string& scene : kWedgeScenes) {
    const Truth& truth = truthOf(scene);
    std::vector<std::uint8_t> onCasters(truth.kind.size());
    for (std::size_t i = 0; i < onCasters.size(); ++i) {
      onCasters[i] = truth.kind[i] == reference::kCasterReceiver && truth.interior[i] &&
                     truth.visibility[i] > 0.005f && truth.visibility[i] < 0.995f;
    }
    const auto error = metrics::errorStatistics(visibility(scene, cells("16")), truth.visibility, onCasters);
    if (error.pixels == 0) continue;
    std::printf("%-20s casters rmse %.4f, largest %.3f\n", scene.c_str(), error.rmse, error.max);
    // A flat plate whose own plane cuts the light loses it sub-light by sub-light: each errs by half of its
    // quarter at most, two at a time rarely.
    const bool plates = scene.find("leaves") != std::string::npos;
    EXPECT_LE(error.rmse, plates ? 0.07 : 0.01) << scene;
    EXPECT_LE(error.max, plates ? 0.19 : 0.06) << scene;
  }
}

TEST_F(CellsAccuracy, TilesDoNotShow) {
  // Lists are simplified exactly: fewer tiles mean longer lists and the same picture.
  for (const char* scene : {"leaves@light=1", "figure@light=0.3"}) {
    const std::vector<float> fine = visibility(scene, {"wedges-cells", {{"wedges-cells.tiles", "128"}}});
    const std::vector<float> coarse = visibility(scene, {"wedges-cells", {{"wedges-cells.tiles", "12"}}});
    const Truth& truth = truthOf(scene);
    int ground = 0, differing = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
      if (truth.kind[i] != reference::kGroundReceiver) continue;
      ++ground;
      differing += std::abs(fine[i] - coarse[i]) > (isForcedOff("highp") ? 6.5f : 2.5f) / 255.0f;
    }
    // Where a caster touches the ground its loops are cut at the farthest receiver of the tile.
    EXPECT_LE(differing, ground / 500) << scene;
  }
}

}  // namespace
}  // namespace halfshadow::test
