// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Techniques that plan their passes without GL. The registry names every technique but needs GL, so that
/// these are listed here again; tests/architecture asserts that none is missing.
#pragma once

#include "techniques/hard/hard.hpp"
#include "techniques/none/none.hpp"
#include "techniques/occlusion_textures/occlusion_textures.hpp"
#include "techniques/pcf/pcf.hpp"
#include "techniques/pcf_quantized/pcf_quantized.hpp"
#include "techniques/pcss/pcss.hpp"
#include "techniques/pcss_mip/pcss_mip.hpp"
#include "techniques/sampled/sampled.hpp"
#include "techniques/shadow_volume/shadow_volume.hpp"
#include "techniques/shadow_width/shadow_width.hpp"
#include "techniques/vsm/vsm.hpp"

namespace halfshadow::test {

inline std::vector<std::unique_ptr<techniques::Technique>> plannedTechniques() {
  using namespace techniques;
  std::vector<std::unique_ptr<Technique>> planned;
  for (const auto make : {makeNone, makeHard, makePcf, makePcfMasked, makePcfQuantized, makePcss, makePcssMip,
                          makeVsm, makeOcclusionTextures, makeShadowWidth, makeShadowVolume, makeSampled}) {
    planned.push_back(make());
  }
  return planned;
}

}  // namespace halfshadow::test
