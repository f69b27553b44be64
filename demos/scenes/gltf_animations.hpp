// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Which animations a glTF file holds.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"

namespace halfshadow::scenes {

struct AnimationInfo {
  std::string name;      ///< the file's, else its number
  double seconds = 0.0;  ///< last key of all its channels
};

/// In the file's order; none is no error. Errors: those of loadGltf for files that cannot be parsed.
Result<std::vector<AnimationInfo>> gltfAnimations(const std::string& path);

}  // namespace halfshadow::scenes
