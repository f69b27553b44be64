// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of visibility functions that read vertex lists; see LightLists::provide().
#pragma once

#include "techniques/core/shader_families.hpp"
#include "techniques/parts/screen/screen_shaders.hpp"

namespace halfshadow::techniques {

/// Always: all receivers have lists; else casting ones may.
enum class ListedIn { always, castingReceivers };

inline std::vector<ShaderFamily> listReceiverFamilies(const std::string& fragmentFile, ListedIn which,
                                                      std::vector<ShaderAxis> axes) {
  const bool always = which == ListedIn::always;
  axes.push_back(always ? ShaderAxis{{{"HS_LISTS"}}} : flag("HS_LISTS"));
  axes.push_back({{.needs = always ? std::vector<std::string>{"HS_DERIVATIVES"} : std::vector<std::string>{}},
                  {{"HS_FACET_NORMAL"}, {"HS_LISTS"}}});
  axes.push_back(castingAxis({"HS_LISTS"}));
  for (const char* macro : {"HS_ONE_SIDED", "HS_BEHIND_FACETS", "HS_SIDES", "HS_AMONG_RECEIVERS"})
    axes.push_back(flag(macro, {"HS_LISTS"}));
  axes.push_back(flag("HS_TREES", {"HS_LISTS", "HS_ONE_SIDED", "HS_BEHIND_FACETS"}));
  return receiverFamilies(fragmentFile, {.twoDraws = always, .forward = false}, std::move(axes));
}

/// What casting receivers are drawn with where they walk their lists on the screen. `axes`: of the walk's
/// fragment file.
inline std::vector<ShaderFamily> screenWalkFamilies(const std::string& fragmentFile,
                                                    std::vector<ShaderAxis> axes) {
  // Nothing of it is drawn without highp.
  axes.push_back({{.needs = {"!HS_NO_HIGHP"}}});
  for (const char* macro : {"HS_ONE_SIDED", "HS_BEHIND_FACETS", "HS_SIDES"}) axes.push_back(flag(macro));
  axes.push_back(flag("HS_TREES", {"HS_ONE_SIDED", "HS_BEHIND_FACETS"}));
  axes.push_back(flag("HS_COUNT_TAPS"));
  return joined({{receiverDepthShader(), receiverFacetShader(), fullscreen(fragmentFile, std::move(axes))},
                 receiverFamilies("screen/screen_visibility.frag", {.forward = false})});
}

}  // namespace halfshadow::techniques
