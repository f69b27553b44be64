// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Casters that are not convex as receivers of their own shadows: bent sheets, terrain, real models.
#include <cstdio>
#include <filesystem>

#include "metrics/metrics.hpp"
#include "reference/reference.hpp"
#include "wedge_accuracy.hpp"

namespace halfshadow::test {
namespace {

class OwnSurfaces : public WedgeAccuracyTest {
 protected:
  static metrics::ErrorStatistics errorOnCasters(const std::string& scene,
                                                 const Configuration& configuration) {
    const Truth& truth = truthOf(scene);
    // Of small models hardly any pixel is free of outlines; there they count, too.
    const std::vector<std::uint8_t> onCasters =
        scene.ends_with(".glb") ? truth.penumbraOnCasters() : judgedOnCasters(truth);
    const std::vector<float> actual = visibility(scene, configuration);
    const auto error = metrics::errorStatistics(actual, truth.visibility, onCasters);
    std::printf("%-24s %-28s casters rmse %.4f, p99 %.3f (%zu pixels)\n",
                std::filesystem::path(scene).filename().c_str(), configuration.text().c_str(), error.rmse,
                error.p99, static_cast<std::size_t>(error.pixels));
    EXPECT_EQ(error.nanPixels, 0u) << scene;
    return error;
  }
  void SetUp() override {
    if (isForcedOff("highp"))
      GTEST_SKIP() << "without highp a fragment does not know which side of its own facet it is on";
  }
};

// Lists of faces are exact; what is left are layers of one caster that overlap within a cell: sixteen in
// wedges-cells, the quadrants of the light in the others. pcss errs by .13 to .24 here.
constexpr double kCells = 0.03, kQuadrants = 0.08;

TEST_F(OwnSurfaces, OfBuiltinScenes) {
  for (const char* scene : {"terrain", "sheets"}) {
    EXPECT_LE(errorOnCasters(scene, {"wedges-cells", {}}).rmse, kCells) << scene;
    EXPECT_LE(errorOnCasters(scene, {"wedges", {}}).rmse, kQuadrants) << scene;
    EXPECT_LE(errorOnCasters(scene, {"wedges-probabilistic", {}}).rmse, kQuadrants) << scene;
    EXPECT_LE(errorOnCasters(scene, {"wedges-blended", {}}).rmse, kQuadrants) << scene;
  }
}

TEST_F(OwnSurfaces, OfRealModels) {
  for (const char* name : {"cat.glb", "CesiumMan.glb"}) {
    const std::string path = std::string(HALFSHADOW_SHARED_DIR) + "/scenes/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << name << " is not here: clone it beside the project";
    EXPECT_LE(errorOnCasters(path, {"wedges-cells", {}}).rmse, kCells) << name;
    for (const char* technique : {"wedges", "wedges-probabilistic", "wedges-blended"}) {
      EXPECT_LE(errorOnCasters(path, {technique, {}}).rmse, kQuadrants) << name << ", " << technique;
    }
    for (const char* route : {"scatter", "fetch"}) {
      EXPECT_LE(errorOnCasters(path, {"wedges-cells", {{"wedges-cells.route", route}}}).rmse, kCells)
          << name << ", " << route;
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
