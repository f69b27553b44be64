// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A pass that makes one image of another.
#pragma once

#include <string>
#include <vector>

#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

/// One full-screen draw. The fragment shader gets u_sourceSize: (side of the source, 1 / side, side of the
/// target, 0).
struct FilterPass {
  std::string name;
  std::string fragmentFile;
  std::vector<std::string> defines{};
  framegraph::ResourceId source, target;
  int sourceSize = 0;
  int targetSize = 0;  ///< for shaders that ask which of its texels they write
  std::uint64_t contentKey = 0;
  device::UniformKey sampler;
  device::UniformList uniforms{};
};
void addFilterPass(PassPlan& plan, FilterPass pass);

}  // namespace halfshadow::techniques
