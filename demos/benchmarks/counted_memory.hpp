// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Calls of operator new.
#pragma once

#include <cstdint>

namespace halfshadow::test {

/// On this thread since it began: a software renderer's own threads do not count.
std::uint64_t allocationCount();

}  // namespace halfshadow::test
