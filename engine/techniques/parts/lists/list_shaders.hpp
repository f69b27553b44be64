// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of visibility functions that read vertex lists; see LightLists::provide().
#pragma once

#include "techniques/core/shader_families.hpp"

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

}  // namespace halfshadow::techniques
