// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

FilterSkip preferredSkip(const LightScene& scene) {
  return filterSkipFromName(scene.settings.choice("filter_skip"));
}

}  // namespace halfshadow::techniques
