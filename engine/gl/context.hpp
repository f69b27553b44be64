// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The engine's hold on the host's OpenGL ES 2.0 context: entry points, capabilities, live-object counts.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "device/capabilities.hpp"
#include "gl/functions.hpp"

namespace halfshadow::gl {

/// Address of an OpenGL ES entry point by name, or null; the host's eglGetProcAddress or its like.
using GetProcAddress = std::function<void*(const char* name)>;

struct ContextOptions {
  std::vector<device::Capability> forcedOff;  ///< treated as absent, for testing fallbacks
};

/// Owns no context: the host's is current on the calling thread for every call, here and in all objects
/// made from it. Not copyable; objects keep a pointer to it, so it outlives them.
class Context {
 public:
  /// Loads entry points, reads limits and runs the probes (a few tiny draws; host state is restored).
  /// Errors: driverMissing (an entry point is absent or the version is below ES 2.0).
  static Result<std::unique_ptr<Context>> create(const GetProcAddress& getProcAddress,
                                                 const ContextOptions& options);

  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const Functions& functions() const { return functions_; }
  const device::Capabilities& capabilities() const { return capabilities_; }

  /// Objects made and not yet destroyed, for leak tests.
  struct LiveObjects {
    int textures = 0, renderbuffers = 0, framebuffers = 0, buffers = 0, programs = 0, queries = 0;
    int total() const { return textures + renderbuffers + framebuffers + buffers + programs + queries; }
  };
  LiveObjects& liveObjects() { return liveObjects_; }

  /// Bytes and values sent to the driver since the context was made.
  struct Uploads {
    std::uint64_t uniforms = 0, textureBytes = 0, bufferBytes = 0;
  };
  Uploads& uploads() { return uploads_; }

  /// Every change of a binding outside the encoder (uploads, deletion) counts here, so that the encoder's
  /// cache knows when it is stale.
  void noteBindingsChanged() { ++bindingRevision_; }
  std::uint64_t bindingRevision() const { return bindingRevision_; }

  /// After the host lost its context: objects forget their names and delete nothing.
  void markLost() { lost_ = true; }
  bool lost() const { return lost_; }

  /// Drains glGetError. Errors: contextLost after markLost(); driverFault naming the errors
  /// and `where`.
  Status checkErrors(const char* where) const;

 private:
  Context() = default;
  Functions functions_;
  device::Capabilities capabilities_;
  LiveObjects liveObjects_;
  Uploads uploads_;
  std::uint64_t bindingRevision_ = 0;
  bool lost_ = false;
};

}  // namespace halfshadow::gl
