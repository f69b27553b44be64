// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/registry/registry.hpp"

#include <algorithm>

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
#include "techniques/wedges/wedges.hpp"
#include "techniques/wedges_blended/wedges_blended.hpp"
#include "techniques/wedges_cells/wedges_cells.hpp"

namespace halfshadow::techniques {

std::vector<std::unique_ptr<Technique>> makeAllTechniques() {
  std::vector<std::unique_ptr<Technique>> techniques;
  for (const auto make : {makeNone, makeHard, makePcf, makePcfMasked, makePcfQuantized, makePcss, makePcssMip,
                          makeVsm, makeOcclusionTextures, makeShadowWidth, makeShadowVolume, makeWedges,
                          makeWedgesProbabilistic, makeWedgesBlended, makeWedgesCells, makeSampled}) {
    techniques.push_back(make());
  }
  return techniques;
}

std::vector<SettingInfo> allSettings(const std::vector<std::unique_ptr<Technique>>& techniques) {
  std::vector<SettingInfo> settings = commonSettings();
  for (const auto& technique : techniques) {
    for (SettingInfo& info : technique->settings()) settings.push_back(std::move(info));
  }
  return settings;
}

std::vector<ShaderFamily> allShaderFamilies(const std::vector<std::unique_ptr<Technique>>& techniques) {
  // What several lights left on the screen is shaded for all techniques alike.
  std::vector<ShaderAxis> axes = surfaceAxes(true);
  axes.push_back({{{"HS_SHADED"}}, {{"HS_SHADED", "HS_BASE_COLOR_TEXTURE"}}});
  std::vector<ShaderFamily> families = {
      {"receiver/receiver.vert", "receiver/shade_lights.frag", std::move(axes)}};
  for (const auto& technique : techniques) {
    for (ShaderFamily& family : technique->shaderFamilies()) {
      if (std::ranges::find(families, family) == families.end()) families.push_back(std::move(family));
    }
  }
  return families;
}

}  // namespace halfshadow::techniques
