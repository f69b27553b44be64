// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Hard shadows of a light's centre by ray casting, and where a rasteriser may differ from it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine_fixture.hpp"

namespace halfshadow::test {

struct HardTruth {
  std::vector<std::uint8_t> receiver;  ///< 1 where a surface is visible and faces the light's centre
  std::vector<std::uint8_t> lit;       ///< 1 where nothing lies between it and the centre
  /// 1 where a pixel's neighbourhood shows one surface, all lit or all shadowed, not seen or lit at a grazing
  /// angle: no rasteriser may differ there.
  std::vector<std::uint8_t> certain;
};
/// Of the scene's first light and its camera, kWidth × kHeight.
HardTruth hardTruth(const scene::SceneDescription& scene, std::size_t light = 0);

struct HardError {
  int receivers = 0, shadowed = 0, certain = 0;
  int wrongCertain = 0;    ///< pixels that no rounding explains
  int wrongElsewhere = 0;  ///< outlines of shadows and surfaces
};
/// Of one channel of a visibility image, which must hold 0 and 255 only.
HardError compareHard(const HardTruth& truth, const Image& image, int channel = 0);

/// Certain pixels that may be wrong for each surface of a volume that is seen edge-on: none but under ANGLE,
/// whose SwiftShader takes a triangle's side from its corners before it rounds them to pixels' sixteenths, so
/// that slivers are counted on the wrong side (measured: up to 3 pixels an image, 55 of 300 in one plane).
int allowedSlivers(int surfacesInLine = 1);

/// Asserts that at most allowedSlivers() certain pixels are wrong and that few of the receivers differ
/// elsewhere; saves a picture beside the build when they do.
void expectHard(const std::string& name, const HardTruth& truth, const Image& image, int channel = 0,
                int surfacesInLine = 1);

/// The scene moved and scaled about the origin, with everything in it.
scene::SceneDescription transformedScene(const scene::SceneDescription& scene, double scale,
                                         const glm::dvec3& shift);

}  // namespace halfshadow::test
