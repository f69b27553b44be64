// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// wedges-cells against ray-traced truth: 17 configurations of casters and lights.
#include <cstdio>

#include "metrics/metrics.hpp"
#include "reference/reference.hpp"
#include "wedge_accuracy.hpp"

namespace halfshadow::test {
namespace {

Configuration cells(const std::string& bytes) {
  return {"wedges-cells", {{"wedges-cells.bytes", bytes}}};
}

using CellsAccuracy = WedgeAccuracyTest;

TEST_F(CellsAccuracy, SixteenCellsReachTheProjectsFigures) {
  const Mean mean = meanError(cells("16"));
  EXPECT_LE(mean.rmse, 0.0062 * precision());
  EXPECT_LE(mean.p99, 0.024 * precision());
  // In fp16 a vertex next to the receiver projects anywhere: single pixels at contacts, so p99 judges there.
  if (!isForcedOff("highp")) {
    // Of touching casters the outline alone counts: rails that stick out behind pickets, seen from the side
    // of a sub-light, are lost (.037 -> .053 in the fence), for a fifth less error over all penumbrae.
    EXPECT_LE(mean.largest, 0.072);
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
    const auto error =
        metrics::errorStatistics(visibility(scene, cells("16")), truth.visibility, judgedOnCasters(truth));
    if (error.pixels == 0) continue;
    std::printf("%-20s casters rmse %.4f, largest %.3f\n", scene.c_str(), error.rmse, error.max);
    EXPECT_LE(error.rmse, 0.01) << scene;
    // Next to each other two thin leaves see a third by its edge: at h = 2 single pixels change from .36 to 0
    // and back within a hundredth of a unit.
    EXPECT_LE(error.max, scene == "leaves@light=2" ? 0.17 : 0.06) << scene;
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
