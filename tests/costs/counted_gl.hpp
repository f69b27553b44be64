// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// OpenGL ES calls of an engine.
#pragma once

#include <cstdint>
#include <memory>

#include "halfshadow/halfshadow.hpp"

namespace halfshadow::test {

/// On the process's context, with HostState::leaveDirty; its calls are counted by glCallCount().
std::unique_ptr<Engine> makeCountedEngine();
std::uint64_t glCallCount();

}  // namespace halfshadow::test
