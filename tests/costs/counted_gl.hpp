// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// OpenGL ES calls of an engine, and the states in which it draws.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>

#include "halfshadow/halfshadow.hpp"

namespace halfshadow::test {

/// On the process's context, with HostState::leaveDirty; its calls are counted by glCallCount().
std::unique_ptr<Engine> makeCountedEngine();
std::uint64_t glCallCount();

/// The states of draws that drivers compile programs for, as far as tests know: program, blending, colour
/// mask, depth and stencil operations, culling, polygon offset. Not depth range, viewport, scissor and
/// stencil reference, which are data everywhere. One entry for each combination since the last call.
std::set<std::string> takeDrawnStates();

}  // namespace halfshadow::test
