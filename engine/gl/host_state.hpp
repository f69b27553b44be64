// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The host's OpenGL ES state around a frame.
#pragma once

#include <memory>

#include "gl/context.hpp"

namespace halfshadow::gl {

/// What the engine leaves behind.
enum class HostStatePolicy {
  restore,        ///< every value that the engine touches is read first and put back
  leaveDefaults,  ///< every value that the engine touches is left at the initial value of the specification
  leaveDirty      ///< undefined; the host sets all state it relies on
};

/// Captures on construction (policy restore), acts on destruction. One list of state types (state_list.hpp)
/// drives capture, restore, defaults and the hostile-host test. The list is OpenGL ES 2.0: a host on a later
/// version unbinds its vertex array object, pixel buffers and separate read framebuffer before the frame.
class HostStateGuard {
 public:
  HostStateGuard(Context& context, HostStatePolicy policy);
  ~HostStateGuard();
  HostStateGuard(const HostStateGuard&) = delete;
  HostStateGuard& operator=(const HostStateGuard&) = delete;

 private:
  struct Snapshot;
  Context& context_;
  HostStatePolicy policy_;
  std::unique_ptr<Snapshot> snapshot_;
};

}  // namespace halfshadow::gl
