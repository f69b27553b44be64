// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/host_state.hpp"

#include "base/log.hpp"
#include "gl/later_state.hpp"
#include "gl/state_list.hpp"

namespace halfshadow::gl {
namespace state {

StateValues captureState(const Functions& gl) {
  StateValues values;
  forEachState([&]<typename State, std::size_t i>() { std::get<i>(values) = State::get(gl); });
  ActiveTexture::set(gl, std::get<0>(values));  // reading the texture bindings moved it
  return values;
}

void applyState(const Functions& gl, const StateValues& values) {
  forEachStateReversed([&]<typename State, std::size_t i>() { State::set(gl, std::get<i>(values)); });
}

StateValues initialState(const StateValues& host) {
  StateValues values;
  forEachState([&]<typename State, std::size_t i>() {
    if constexpr (requires { State::kInitialIsHostValue; }) {
      std::get<i>(values) = std::get<i>(host);
    } else {
      std::get<i>(values) = State::initial();
    }
  });
  return values;
}

}  // namespace state

struct HostStateGuard::Snapshot {
  state::StateValues values;
  LaterState later;
};

HostStateGuard::HostStateGuard(Context& context, HostStatePolicy policy)
    : context_(context), policy_(policy) {
  if (context_.lost()) return;
  if (policy_ != HostStatePolicy::leaveDirty) snapshot_ = std::make_unique<Snapshot>();
  takePendingErrors();
  const Functions& gl = context_.functions();
  if (policy_ == HostStatePolicy::restore) snapshot_->later.capture(context_);
  LaterState::neutralize(context_);
  if (policy_ == HostStatePolicy::leaveDirty) return;
  if (policy_ == HostStatePolicy::restore) {
    snapshot_->values = state::captureState(gl);
    return;
  }
  state::forEachState([&]<typename State, std::size_t i>() {
    if constexpr (requires { State::kInitialIsHostValue; }) std::get<i>(snapshot_->values) = State::get(gl);
  });
}

HostStateGuard::~HostStateGuard() {
  if (context_.lost()) return;
  context_.dropFaults();
  if (snapshot_) {
    const bool restores = policy_ == HostStatePolicy::restore;
    state::applyState(context_.functions(),
                      restores ? snapshot_->values : state::initialState(snapshot_->values));
    if (restores) snapshot_->later.restore(context_);
    context_.noteBindingsChanged();
  }
  raisePendingErrors();
}

void HostStateGuard::takePendingErrors() {
  for (GLenum& error : pendingErrors_) {
    error = context_.takeError();
    if (error == GL_NO_ERROR) return;
  }
}

/// By calls that can do nothing else.
void HostStateGuard::raisePendingErrors() const {
  const Functions& gl = context_.functions();
  for (const GLenum error : pendingErrors_) {
    if (error == GL_NO_ERROR) return;
    if (error == GL_INVALID_ENUM) {
      gl.enable(0x7fffffff);
    } else if (error == GL_INVALID_VALUE) {
      gl.viewport(0, 0, -1, -1);
    } else if (error == GL_INVALID_OPERATION) {
      gl.uniform1i(0x7ffffff0, 0);  // a location that no program has
    } else if (error == GL_INVALID_FRAMEBUFFER_OPERATION) {
      const GLint bound = state::FramebufferBinding::get(gl);
      GLuint incomplete = 0;
      gl.genFramebuffers(1, &incomplete);
      gl.bindFramebuffer(GL_FRAMEBUFFER, incomplete);
      gl.clear(GL_COLOR_BUFFER_BIT);
      gl.bindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
      gl.deleteFramebuffers(1, &incomplete);
    } else {
      logMessage(LogLevel::warning, "the host had a GL error pending that cannot be raised again (" +
                                        std::to_string(error) + "); ask glGetError before calls");
    }
  }
}

}  // namespace halfshadow::gl
