// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Occlusion textures against truth: ray traced for the benchmark scenes, closed forms for plates.
#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "metrics/metrics.hpp"
#include "reference/closed_forms.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

Configuration occlusion(std::vector<Setting> settings = {}) {
  for (Setting& setting : settings) setting.key = "occlusion-textures." + setting.key;
  return {"occlusion-textures", std::move(settings)};
}

class OcclusionAccuracy : public SharedEngineTest {
 protected:
  struct Mean {
    double rmse = 0.0;
    double brightest = 0.0;  ///< largest error towards light
  };
  /// Over penumbra pixels of the ground, mean of the benchmark scenes.
  static Mean meanError(const Configuration& configuration) {
    Mean mean;
    for (const std::string& name : kBenchmarkScenes) {
      const Truth& truth = truthOf(name);
      renderer().load(builtinScene(name));
      const std::vector<float> visibility = renderer().render(configuration).visibility();
      const std::vector<std::uint8_t> judged = truth.penumbraOnGround();
      const auto error = metrics::errorStatistics(visibility, truth.visibility, judged);
      EXPECT_EQ(error.nanPixels, 0u);
      mean.rmse += error.rmse / static_cast<double>(kBenchmarkScenes.size());
      for (std::size_t i = 0; i < judged.size(); ++i) {
        if (judged[i]) mean.brightest = std::max<double>(mean.brightest, visibility[i] - truth.visibility[i]);
      }
    }
    std::printf("%-70s rmse %.4f, brightest error %.2f\n", configuration.text().c_str(), mean.rmse,
                mean.brightest);
    return mean;
  }
  /// Largest difference to the closed form of a plate parallel to the light.
  static double plateError(const Configuration& configuration, double plateHalf, double halfU, double halfV) {
    const double plateHeight = 3.0;
    const scene::AreaLight light = lightAbove({0, 12, 0}, halfU, halfV);
    scene::SceneDescription scene{.name = "plate"};
    scene.objects = {boxObject({0, plateHeight, 0}, {plateHalf, 0.001, plateHalf}), groundPlane(20.0)};
    scene.camera = cameraAbove(0.0, 0.0, 4.0);
    scene.lights = {light};
    renderer().load(scene);
    const std::vector<float> visibility = renderer().render(configuration).visibility();
    double worst = 0.0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double truth =
            reference::rectangleVisibility(light, groundPoint(*scene.camera, kWidth, kHeight, x, y),
                                           {0, plateHeight, 0}, plateHalf, plateHalf);
        worst = std::max(worst, std::abs(truth - visibility[static_cast<std::size_t>(y * kWidth + x)]));
      }
    }
    return worst;
  }
};

// Measured .019 and .010 at four sub-lights against .047 and .026, mipmaps .024 and .014 against .066 and
// .051.
TEST_F(OcclusionAccuracy, ASplitLightErrsLessOnEachFilter) {
  for (const char* name : {"spheres27", "figure"}) {
    const Truth& truth = truthOf(name);
    renderer().load(builtinScene(name));
    const std::vector<std::uint8_t> judged = truth.penumbraOnGround();
    for (const char* filter : {"nbuffer", "sat", "mipmap"}) {
      const auto rmse = [&](const char* subLights) {
        Configuration configuration = occlusion({{"filter", filter}});
        configuration.settings.push_back({"sub_lights", subLights});
        const std::vector<float> visibility = renderer().render(configuration).visibility();
        const auto error = metrics::errorStatistics(visibility, truth.visibility, judged);
        EXPECT_EQ(error.nanPixels, 0u);
        std::printf("%s %s sub_lights=%s rmse %.4f\n", name, filter, subLights, error.rmse);
        return error.rmse;
      };
      const double whole = rmse("1");
      EXPECT_LE(rmse("2"), 0.6 * whole) << name << " " << filter;
      EXPECT_LE(rmse("auto"), 0.6 * whole) << name << " " << filter;
    }
  }
}

// The project's figure of all configurations, .018, is reached by each of those whose penumbrae are the
// fewest texels wide but for the fence: its posts are two texels thin even so (.022, with 256 texels a side
// .042).
TEST_F(OcclusionAccuracy, NarrowPenumbraeGetMoreTexels) {
  if (isForcedOff("highp")) GTEST_SKIP() << "mediump coordinates could not tell more texels apart";
  for (const auto& [name, most] : {std::pair{"spheres27@light=0.3", 0.018}, {"fence@light=0.3", 0.025}}) {
    const Truth& truth = truthOf(name);
    renderer().load(builtinScene(name));
    const std::vector<float> visibility = renderer().render(occlusion()).visibility();
    const auto error = metrics::errorStatistics(visibility, truth.visibility, truth.penumbraOnGround());
    std::printf("%s rmse %.4f\n", name, error.rmse);
    EXPECT_LE(error.rmse, most) << name;
  }
}

TEST_F(OcclusionAccuracy, ASplitLightTakesNoMorePassesThanOneMap) {
  for (const char* filter : {"nbuffer", "sat", "mipmap"}) {
    const auto passes = [&](const char* subLights) {
      renderer().load(builtinScene("spheres27"));  // nothing is kept of the last pictures
      Configuration configuration = occlusion({{"filter", filter}});
      configuration.settings.push_back({"sub_lights", subLights});
      renderer().render(configuration);
      return renderer().report().lightPasses();
    };
    const auto whole = passes("1");
    for (const char* several : {"2", "3", "auto"})
      EXPECT_LE(passes(several), whole) << filter << " " << several;
  }
}

// The project's figures; measured .032 at both (one depth layer is the wall, as for pcss). Without highp map
// coordinates have 11 bits, steps of a third of a texel: measured .004 more, inside the same figures.
TEST_F(OcclusionAccuracy, TunedReachesTheProjectsFigures) {
  const Mean four = meanError(occlusion());
  EXPECT_LE(four.rmse, 0.045);
  EXPECT_LE(four.brightest, 0.45);
  const Mean eight = meanError(occlusion({{"slices", "8"}}));
  EXPECT_LE(eight.rmse, 0.042);
  EXPECT_LE(eight.brightest, 0.45);
}

// The published method: .08-.10, and worse with more slices, since a surface that spans slices counts as
// independent pieces.
TEST_F(OcclusionAccuracy, PaperIsReproducedWithItsFaults) {
  const Mean four = meanError(occlusion({{"preset", "paper"}}));
  const Mean eight = meanError(occlusion({{"preset", "paper"}, {"slices", "8"}}));
  const Mean sixteen = meanError(occlusion({{"preset", "paper"}, {"slices", "16"}}));
  EXPECT_GE(four.rmse, 0.07);
  EXPECT_LE(four.rmse, 0.10);
  EXPECT_GT(eight.rmse, four.rmse);
  EXPECT_GT(sixteen.rmse, eight.rmse);
  EXPECT_LE(sixteen.rmse, 0.12);
  // Mipmaps' kernels sit on a coarse grid (prototype: .10 and more).
  EXPECT_GT(meanError(occlusion({{"preset", "paper"}, {"filter", "mipmap"}})).rmse, four.rmse);
  // The paper's figure 3: the sum of dependent slices is too dark by far.
  EXPECT_GT(meanError(occlusion({{"preset", "paper"}, {"combine", "sum"}})).rmse, 1.2 * four.rmse);
}

TEST_F(OcclusionAccuracy, NBuffersAreAsAccurateAsExactSums) {
  const double nbuffer = meanError(occlusion()).rmse;
  const double exact = meanError(occlusion({{"filter", "sat"}})).rmse;
  // The project's figure. Sums address whole texels, so that mediump costs them less than it costs N-buffers.
  EXPECT_LE(nbuffer - exact, isForcedOff("highp") ? 0.004 : 0.002);
}

// A light whose section is wider than the plate and the map around it: kernels jut out on all sides.
TEST_F(OcclusionAccuracy, KernelsThatLeaveTheMapFindNothingThere) {
  // Exact sums: what remains is 8-bit depth and a texel's rounding.
  EXPECT_LE(plateError(occlusion({{"filter", "sat"}}), 0.5, 3.0, 3.0), 0.06);
  // The plate's two faces lie in different slices: only the maximum does not count them twice.
  EXPECT_LE(
      plateError(occlusion({{"filter", "sat"}, {"preset", "paper"}, {"center", "light"}, {"combine", "max"}}),
                 0.5, 3.0, 3.0),
      0.06);
  // An object that the kernel holds whole covers 1/r^2 of it for r from 1 to 2; the mix of the kernels at
  // both ends says up to .23 more. This is what interpolating between levels costs at worst; measured .21.
  EXPECT_LE(plateError(occlusion(), 0.5, 3.0, 3.0), 0.25);
}

TEST_F(OcclusionAccuracy, ElongatedLightsGetElongatedKernels) {
  for (const char* filter : {"nbuffer", "sat"}) {
    for (const auto& [halfU, halfV] : {std::pair{2.0, 0.25}, std::pair{0.25, 2.0}, std::pair{2.0, 0.8}}) {
      EXPECT_LE(plateError(occlusion({{"filter", filter}}), 1.5, halfU, halfV), 0.09)
          << filter << " " << halfU << " " << halfV;
    }
  }
}

// A thin plate at 45 degrees spans all slices; below its middle nothing of the light is seen.
TEST_F(OcclusionAccuracy, ThinTiltedOccludersDoNotLeak) {
  scene::SceneDescription scene{.name = "wing"};
  scene::SceneObject wing = boxObject({0, 0, 0}, {2.0, 0.002, 2.0});
  // Two wings, as a butterfly's.
  for (const double side : {-1.0, 1.0}) {
    wing.worldFromObject =
        glm::rotate(glm::translate(glm::dmat4(1.0), {side * 1.4, 3.0, 0.0}), side * 0.785, {0.0, 0.0, 1.0});
    scene.objects.push_back(wing);
  }
  scene.objects.push_back(groundPlane(20.0));
  scene.camera = cameraAbove(0.0, 0.0, 0.9);
  scene.lights = {lightAbove({0, 12, 0}, 1.0, 1.0)};
  renderer().load(scene);
  const auto brightest = [&](const Configuration& configuration) {
    const std::vector<float> visibility = renderer().render(configuration).visibility();
    return *std::ranges::max_element(visibility);
  };
  // Two of 255 for each of four slices' roundings.
  constexpr double kRounding = 8.0 / 255.0;
  // Where two slices meet, their shares are taken with kernels of slightly different size: measured .043.
  EXPECT_LE(brightest(occlusion()), 2.0 * kRounding);
  EXPECT_LE(brightest(occlusion({{"slices", "16"}})), 4.0 * kRounding);
  EXPECT_LE(brightest(occlusion({{"preset", "paper"}, {"leak_fix", "on"}})), kRounding);
  EXPECT_GT(brightest(occlusion({{"preset", "paper"}})), 0.1) << "the leak that the fix is for has gone";
}

// The paper's figure 6: the thin wings of a butterfly rise through all slices.
TEST_F(OcclusionAccuracy, ButterflyWingsDoNotLeak) {
  struct Result {
    double rmse = 0.0, leak = 0.0;
  };
  const std::string name = "butterfly@light=0.5";
  const Truth& truth = truthOf(name);
  renderer().load(builtinScene(name));
  const auto resultOf = [&](const Configuration& configuration) {
    const std::vector<float> visibility = renderer().render(configuration).visibility();
    Result result{.rmse =
                      metrics::errorStatistics(visibility, truth.visibility, truth.penumbraOnGround()).rmse};
    for (std::size_t i = 0; i < visibility.size(); ++i) {
      // Not beside outlines, where rasteriser and ray tracer may see different surfaces.
      const bool umbra =
          truth.kind[i] == reference::kGroundReceiver && truth.interior[i] && truth.visibility[i] == 0.0f;
      if (umbra) result.leak = std::max<double>(result.leak, visibility[i]);
    }
    std::printf("%-70s rmse %.4f, leak %.3f\n", configuration.text().c_str(), result.rmse, result.leak);
    return result;
  };
  const Result tuned = resultOf(occlusion()), fine = resultOf(occlusion({{"slices", "16"}}));
  const Result paper = resultOf(occlusion({{"preset", "paper"}}));
  const Result closed = resultOf(occlusion({{"preset", "paper"}, {"leak_fix", "on"}}));
  // The figure of the benchmark scenes; measured .018, since no two wings overlap.
  EXPECT_LE(tuned.rmse, 0.03);
  // Rounding of four slices, and of kernels whose sizes differ by slice; measured .047 and .035.
  EXPECT_LE(tuned.leak, 0.07);
  EXPECT_LE(fine.leak, 0.07);
  // Published: gaps where a wing passes from slice to slice, .26 here; the fix closes them (.02), but
  // darkens.
  EXPECT_GT(paper.leak, 0.15);
  EXPECT_LE(closed.leak, 0.04);
  EXPECT_GT(closed.rmse, paper.rmse);
}

// "Quality and speed independent of the light's size" is about fetches: two of a prefiltered texture for a
// slice, and two more where it is refined.
TEST_F(OcclusionAccuracy, FetchesDependNeitherOnTheLightNorOnTheScene) {
  for (const std::string& name :
       {std::string("figure@light=0.3"), std::string("figure@light=2"), std::string("spheres27@light=1")}) {
    renderer().load(builtinScene(name));
    const auto mostFetches = [&](const char* subLights) {
      const Image counts =
          renderer().render({"occlusion-textures", {{"sub_lights", subLights}}}, Output::taps);
      int most = 0;
      for (std::size_t i = 0; i < counts.pixels(); ++i)
        most = std::max(most, counts.byte(i, 0) + 256 * counts.byte(i, 1));
      return most;
    };
    const int whole = mostFetches("1");
    EXPECT_GT(whole, 8) << name;
    EXPECT_LE(whole, 16) << name;
    // Two for a texture, in which all sub-lights' occluders are looked for; then as many for each of four.
    EXPECT_LE(mostFetches("auto"), 2 * 2 + 4 * 16) << name;
  }
}

}  // namespace
}  // namespace halfshadow::test
