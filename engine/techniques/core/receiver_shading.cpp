// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/receiver_shading.hpp"

namespace halfshadow::techniques {

FilterSkip filterSkipFromName(std::string_view name) {
  if (name == "branch") return FilterSkip::branch;
  return name == "loop" ? FilterSkip::loop : FilterSkip::stencil;
}

}  // namespace halfshadow::techniques
