// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What the techniques made from silhouettes are judged by: 17 configurations of casters and lights.
#pragma once

#include <algorithm>
#include <cstdio>

#include "metrics/metrics.hpp"
#include "truth.hpp"

namespace halfshadow::test {

inline const std::vector<std::string> kWedgeScenes = {
    "spheres27@light=0.3", "spheres27@light=1", "spheres27@light=2", "spheres81@light=1", "spheres81@light=2",
    "box@light=0.3",       "box@light=1",       "box@light=2",       "bars@light=1",      "bars@light=2",
    "fence@light=0.3",     "fence@light=1",     "leaves@light=0.3",  "leaves@light=1",    "leaves@light=2",
    "figure@light=0.3",    "figure@light=1"};

class WedgeAccuracyTest : public SharedEngineTest {
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
    return offOutlines(truth, truth.penumbraOnGround());
  }
  /// The same of casters.
  static std::vector<std::uint8_t> judgedOnCasters(const Truth& truth) {
    return offOutlines(truth, truth.penumbraOnCasters());
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
  static std::vector<std::uint8_t> offOutlines(const Truth& truth, std::vector<std::uint8_t> pixels) {
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = pixels[i] && truth.interior[i];
    return pixels;
  }
  /// fp16 knows a fragment's place to 11 bits: twice the error is the price of a device without highp.
  static double precision() { return isForcedOff("highp") ? 2.0 : 1.0; }
};

}  // namespace halfshadow::test
