// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Content keys: hashes of everything that some content depends on.
#pragma once

#include <cstdint>
#include <string_view>

namespace halfshadow {

/// 64-bit mixing of revisions into content keys.
std::uint64_t combineKeys(std::uint64_t seed, std::uint64_t value);
/// The same in every run and on every machine (FNV-1a of 64 bits).
std::uint64_t textKey(std::string_view text);

}  // namespace halfshadow
