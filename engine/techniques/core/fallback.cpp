// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/fallback.hpp"

namespace halfshadow::techniques {

Fallback shadedApart(std::vector<std::pair<std::string, std::string>> settings, std::string text) {
  settings.emplace_back("shading", "apart");
  return {.text = text.empty() ? "shaded in a pass of its own"
                               : std::move(text) + ", shaded in a pass of its own",
          .settings = std::move(settings)};
}

}  // namespace halfshadow::techniques
