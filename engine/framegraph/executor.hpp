// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Runs a plan: makes textures and framebuffers, binds, clears, discards, times and counts per pass.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framegraph/plan.hpp"
#include "gl/encoder.hpp"

namespace halfshadow::framegraph {

/// What a pass sees while it runs.
class PassContext {
 public:
  PassContext(gl::Encoder& encoderToUse, const gl::Rect& viewportToUse)
      : encoder(encoderToUse), viewport(viewportToUse) {}
  gl::Encoder& encoder;
  gl::Rect viewport;
  /// The targets hold what PassDesc::update says: the pass draws what lies in its parts, into them alone.
  bool updates = false;
  /// Texture behind a resource that the pass reads.
  const gl::Texture& texture(ResourceId resource) const;

 private:
  friend class Executor;
  const class Executor* executor_ = nullptr;
};

/// Numbers alone; what a pass is called and draws into, its place in the plan tells.
struct PassReport {
  std::size_t planned = 0;  ///< in Plan::passes
  gl::Counters counters;
  double milliseconds = 0.0;  ///< 0 unless timed
};

enum class PassTiming { off, perPass };

class Executor {
 public:
  explicit Executor(gl::Context& context);
  ~Executor();

  /// Key of what a persistent resource holds (its size, format and filter must match too); 0 = nothing.
  std::uint64_t contentKeyOf(const ResourceDesc& desc) const;
  Result<std::vector<PassReport>> run(const Graph& graph, const Plan& plan, gl::Encoder& encoder,
                                      PassTiming timing);

  /// After run() of the same plan, and no other since: those passes alone that draw into the host's
  /// framebuffers, which need not hold what they did. Empty when an image that one of them reads has gone to
  /// another since: then only run() draws them.
  Result<std::vector<PassReport>> runImportedAgain(const Graph& graph, const Plan& plan,
                                                   gl::Encoder& encoder);

  /// Texture of a resource after run(), until the next run() or trim(). Null when it was not made.
  const gl::Texture* texture(const Graph& graph, ResourceId resource) const;
  /// Framebuffer over the resource's texture, for read-back.
  const gl::Framebuffer* framebufferFor(const Graph& graph, ResourceId resource) const;

  std::uint64_t memoryBytes() const;  ///< of all textures and renderbuffers held now
  /// Frees images that the last `frames` runs did not use (0 = everything). Runs free by themselves what the
  /// few before them did not use.
  void trim(int frames);
  /// A frame passed that needs nothing but what the last run left. After some of them running, one frees.
  void repeatRun();
  void forgetContent();  ///< persistent content becomes invalid (context loss, device change)

 private:
  friend class PassContext;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace halfshadow::framegraph
