// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What mobile GPUs' open compilers made of the programs, beside run times of this device.
#pragma once

#include <string>
#include <vector>

#include "profile/suite.hpp"

namespace halfshadow::profile {

/// Rows of technique, path (of a receiver pixel: "lit or umbra", "penumbra, after it" or "every pixel"), and
/// a cell for each GPU.
struct CompiledCounts {
  std::string note;  ///< that they are compiled, not measured, and what cells mean
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};
/// Of the suite's techniques, from profiles/compiled/mobile.json, which tests/mobile/compile.py writes; empty
/// when there is no such file. Errors: fileMalformed.
Result<CompiledCounts> compiledCounts(const Suite& suite);

}  // namespace halfshadow::profile
