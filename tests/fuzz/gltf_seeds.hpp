// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Small valid glTF files that together hold everything that the loader reads.
#pragma once

#include "fuzz_target.hpp"

namespace halfshadow::fuzz {

std::vector<Bytes> gltfSeeds();
std::vector<std::string> gltfWords();

}  // namespace halfshadow::fuzz
