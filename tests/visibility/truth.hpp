// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Ray-traced truth of built-in scenes, kept in files of the build folder: traced once (see truth_test.cpp),
/// read by every configuration of the accuracy suite.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine_fixture.hpp"

namespace halfshadow::test {

/// Its noise, RMSE .0026 over penumbra pixels, is a fifteenth of the smallest error that is judged against
/// it.
inline constexpr int kTruthSamples = 1024;

struct Truth {
  std::vector<std::uint8_t> kind;      ///< reference::ReceiverKind
  std::vector<std::uint8_t> interior;  ///< 1 where the pixel and its eight neighbours show one smooth surface
  std::vector<std::uint8_t>
      facesWholeLight;  ///< 1 where all of the light lies above the plane of the pixel's triangle
  std::vector<float> visibility;
  /// 1 on penumbra pixels of receivers that cast nothing.
  std::vector<std::uint8_t> penumbraOnGround() const;
  std::vector<std::uint8_t> penumbraOnCasters() const;  ///< the same of those that cast
};

/// Penumbra RMSE is judged over these, whose truth others published too.
inline const std::vector<std::string> kBenchmarkScenes = {
    "figure@light=0.05", "figure@light=0.1",    "figure@light=0.3",  "figure@light=1",
    "box@light=0.3",     "spheres27@light=0.3", "spheres27@light=1", "bars@light=1",
    "fence@light=0.3",   "leaves@light=0.3",    "leaves@light=1"};
/// One convex caster each: none of its surface lies in the shadow of another, or within reach of a kernel
/// that is wider than a penumbra.
inline const std::vector<std::string> kAcneScenes = {"box@light=0.3", "box@light=1", "convex@light=0.3",
                                                     "convex@light=1"};

/// Reads the file of this scene as it is now (its name holds a hash of triangles, light and camera), else
/// traces it and writes the file. Two processes may do so at the same time.
const Truth& truthOf(const std::string& sceneName);

/// Writes truth | actual | error (red: too bright, blue: too dark; times 4) beside the build and returns the
/// path.
std::string saveComparison(const std::string& name, const Truth& truth, std::span<const float> actual);
std::string saveComparison(const std::string& name, int width, int height, std::span<const float> expected,
                           std::span<const float> actual);

}  // namespace halfshadow::test
