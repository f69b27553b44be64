// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/shader_families.hpp"

#include <algorithm>

namespace halfshadow::techniques {

ShaderAxis flag(std::string macro, std::vector<std::string> needs) {
  return {{}, {{std::move(macro)}, std::move(needs)}};
}

ShaderAxis values(const std::string& macro, std::initializer_list<int> numbers) {
  ShaderAxis axis;
  for (const int number : numbers) axis.push_back({{macro + " " + std::to_string(number)}});
  return axis;
}

ShaderAxis range(const std::string& macro, int lowest, int highest, std::initializer_list<int> compiled) {
  ShaderAxis axis;
  for (int number = lowest; number <= highest; ++number) {
    axis.push_back({.defines = {macro + " " + std::to_string(number)},
                    .compiled = std::ranges::find(compiled, number) != compiled.end()});
  }
  return axis;
}

ShaderAxis range(const std::string& macro, const SettingInfo& setting, std::initializer_list<int> compiled) {
  return range(macro, static_cast<int>(setting.low), static_cast<int>(setting.high), compiled);
}

ShaderFamily fullscreen(std::string fragmentFile, std::vector<ShaderAxis> axes) {
  return {"screen/fullscreen.vert", std::move(fragmentFile), std::move(axes)};
}

ShaderAxis alphaAxis() {
  return {{}, {{"HS_ALPHA_MASK"}}, {.defines = {"HS_ALPHA_MASK", "HS_VERTEX_COLORS"}}};
}

ShaderAxis castingAxis(std::vector<std::string> needs) {
  needs.emplace_back("!HS_FORWARD");
  return flag("HS_CASTING_RECEIVER", std::move(needs));
}

std::vector<ShaderAxis> surfaceAxes(bool compiled) {
  // The same few lines in all of them.
  return {{{},
           {{"HS_ALPHA_MASK"}, {}, compiled},
           {{"HS_ALPHA_MASK", "HS_VERTEX_COLORS"}, {}, compiled},
           {{"HS_VERTEX_COLORS"}, {"HS_SHADED"}, compiled}},
          {{}, {{"HS_DARK"}, {"HS_SHADED", "!HS_BASE_COLOR_TEXTURE", "!HS_VERTEX_COLORS"}, compiled}},
          {{}, {{"HS_LIGHT_BEHIND"}, {"HS_SHADED"}, compiled}},
          {{}, {{"HS_LIGHT_CONES"}, {"HS_SHADED"}, compiled}},
          {{}, {{"HS_LIGHT_FADES"}, {"HS_SHADED"}, compiled}}};
}

std::vector<ShaderFamily> receiverFamilies(const std::string& fragmentFile, const ReceiverTraits& traits,
                                           std::vector<ShaderAxis> axes) {
  // Without derivatives the facet's plane comes as a vertex attribute.
  if (traits.usesFacetPlane) axes.push_back({{.needs = {"HS_DERIVATIVES"}}, {{"HS_FACET_NORMAL"}}});
  std::vector<ShaderFamily> families;
  if (traits.forward) {
    families.push_back({"receiver/forward.vert", fragmentFile, axes});
    families.back().axes.push_back({{{"HS_FORWARD"}}});
  }
  axes.push_back({{},
                  {{"HS_VISIBILITY_16"}},
                  {{"HS_COUNT_TAPS"}},
                  {{"HS_SHADED"}},
                  {{"HS_SHADED", "HS_BASE_COLOR_TEXTURE"}}});
  // Compiled where there is little else.
  for (ShaderAxis& axis : surfaceAxes(fragmentFile == "receiver/none.frag")) axes.push_back(std::move(axis));
  if (traits.twoDraws) {
    axes.push_back(
        {{}, {{"HS_PHASE_CLASSIFY"}, {"!HS_COUNT_TAPS"}}, {{"HS_PHASE_FILTER"}, {"!HS_COUNT_TAPS"}}});
    if (traits.filterTrustsClasses)
      axes.back().push_back(
          {{"HS_PHASE_FILTER", "HS_CLASSIFIED"}, {"!HS_COUNT_TAPS", "!HS_CASTING_RECEIVER"}});
  }
  families.push_back({"receiver/receiver.vert", fragmentFile, std::move(axes)});
  return families;
}

std::vector<ShaderFamily> joined(std::initializer_list<std::vector<ShaderFamily>> lists) {
  std::vector<ShaderFamily> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace halfshadow::techniques
