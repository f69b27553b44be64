// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The host's OpenGL ES state around a frame.
#pragma once

#include <array>
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
/// drives capture, restore, defaults and the hostile-host test. The list is OpenGL ES 2.0; what later
/// versions and common extensions add, LaterState sets aside, whatever the policy. GL errors that the host
/// had pending are the host's again afterwards.
class HostStateGuard {
 public:
  HostStateGuard(Context& context, HostStatePolicy policy);
  ~HostStateGuard();
  HostStateGuard(const HostStateGuard&) = delete;
  HostStateGuard& operator=(const HostStateGuard&) = delete;

 private:
  struct Snapshot;
  void takePendingErrors();
  void raisePendingErrors() const;
  Context& context_;
  HostStatePolicy policy_;
  std::unique_ptr<Snapshot> snapshot_;
  std::array<GLenum, 8> pendingErrors_{};  ///< GL_NO_ERROR after the last
};

}  // namespace halfshadow::gl
