// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/engine_state.hpp"

namespace halfshadow {

void Engine::State::forgetDerived() noexcept {
  lastFrame.reset();
  lightCaches = {};
  receivers = {};
  lists.listChanged();
  planner = planner::FramePlanner();
  shared.forget();
  if (executor) executor->trim(0);
  for (auto& [id, object] : objects) object.cutReceiver = {};
}

bool Engine::State::freeForRetry(int attempt) noexcept {
  if (attempt > 1) return false;
  const bool ownLimit = context->takeLimitReached();
  if (attempt == 0 && ownLimit) {
    // Of the frame that failed, or where that took no images yet, of the last one.
    executor->trim(1);
    return true;
  }
  forgetDriverWork();
  return true;
}

/// A driver that failed once may have dropped anything that it was told of late, uniforms included.
void Engine::State::forgetDriverWork() noexcept {
  forgetDerived();
  programs->clear();
  forwardPrograms.clear();
}

MemoryRecord Engine::memory() const {
  const gl::Context& context = *state_->context;
  const gl::Context::LiveObjects& live = state_->context->liveObjects();
  return {.bytes = context.storedBytes(),
          .limitBytes = context.memoryLimit(),
          .textures = live.textures,
          .renderbuffers = live.renderbuffers,
          .framebuffers = live.framebuffers,
          .buffers = live.buffers,
          .programs = live.programs};
}

Outcome Engine::trim(Trim what) {
  State& state = *state_;
  if (what != Trim::unused && what != Trim::everything)
    return {ErrorCode::invalidArgument, "trim() knows Trim::unused and Trim::everything"};
  if (state.context->lost())
    return {ErrorCode::contextLost, "the context was lost, and all that it held with it"};
  return state.guarded([&]() -> Outcome {
    gl::HostStateGuard guard(*state.context, state.policy());
    if (what == Trim::everything) {
      state.forgetDerived();
      state.programs->clear();
    } else {
      state.executor->trim(1);
      state.programs->trim();
    }
    return {};
  });
}

void Engine::setMemoryLimit(std::uint64_t bytes) {
  state_->context->setMemoryLimit(bytes);
}

}  // namespace halfshadow
