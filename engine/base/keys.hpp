// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Content keys: hashes of everything that some content depends on.
#pragma once

#include <cstdint>

namespace halfshadow {

/// 64-bit mixing of revisions into content keys.
std::uint64_t combineKeys(std::uint64_t seed, std::uint64_t value);

}  // namespace halfshadow
