// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The engine's hold on the host's OpenGL ES 2.0 context: entry points, capabilities, live-object counts.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
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

  /// Bytes behind all live textures, renderbuffers and buffers, by their formats.
  std::uint64_t storedBytes() const { return storedBytes_; }
  void noteStorage(std::uint64_t before, std::uint64_t now) { storedBytes_ += now - before; }
  /// No more than this is asked of the driver; 0 = no limit. What is held already stays.
  void setMemoryLimit(std::uint64_t bytes) { memoryLimit_ = bytes; }
  std::uint64_t memoryLimit() const { return memoryLimit_; }
  /// Before so many more are asked for. Errors: outOfMemory.
  Status checkMemory(std::uint64_t moreBytes, const std::string& what);
  /// checkMemory() refused something since this was last asked.
  bool takeLimitReached() { return std::exchange(limitReached_, false); }

  /// Every change of a binding outside the encoder (uploads, deletion) counts here, so that the encoder's
  /// cache knows when it is stale.
  void noteBindingsChanged() { ++bindingRevision_; }
  std::uint64_t bindingRevision() const { return bindingRevision_; }

  /// After the host lost its context: objects forget their names and delete nothing, and no entry point is
  /// called any more, not even by a call that is under way.
  void markLost();
  bool lost() const { return lost_; }
  /// The same again on a new context that is current now, as create() would; all objects of the old one are
  /// gone. Errors: those of create(); then it stays lost.
  Status reopen(const GetProcAddress& getProcAddress, const ContextOptions& options);
  /// Of the version text; 0 when it is of another form.
  int majorVersion() const { return majorVersion_; }
  bool advertises(std::string_view extension) const;

  /// glGetError; a context that says that it is gone is marked as lost.
  GLenum takeError();
  /// Drains glGetError: what is found is an error of the frame, told by the next checkErrors().
  void collectErrors();
  bool hasFaults() const { return !faults_.empty(); }
  /// Drains and forgets: between the engine's calls errors are the host's.
  void dropFaults();
  /// Something failed where no error can be returned; `what` has failed.
  void noteFault(const std::string& what);
  /// Drains glGetError. Errors: contextLost after markLost(); outOfMemory, driverFault naming the errors
  /// and `where`.
  Status checkErrors(const char* where);

 private:
  Context() = default;
  Status open(const GetProcAddress& getProcAddress, const ContextOptions& options);
  Functions functions_;
  device::Capabilities capabilities_;
  LiveObjects liveObjects_;
  Uploads uploads_;
  std::uint64_t storedBytes_ = 0, memoryLimit_ = 0;
  std::uint64_t bindingRevision_ = 0;
  bool limitReached_ = false;
  int majorVersion_ = 0;
  std::string faults_;  ///< found, and not told yet
  bool faultsAreMemory_ = false;
  bool lost_ = false;
};

}  // namespace halfshadow::gl
