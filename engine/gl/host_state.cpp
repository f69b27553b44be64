// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/host_state.hpp"

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
};

HostStateGuard::HostStateGuard(Context& context, HostStatePolicy policy)
    : context_(context), policy_(policy) {
  if (policy_ == HostStatePolicy::leaveDirty || context_.lost()) return;
  const Functions& gl = context_.functions();
  snapshot_ = std::make_unique<Snapshot>();
  if (policy_ == HostStatePolicy::restore) {
    snapshot_->values = state::captureState(gl);
    return;
  }
  state::forEachState([&]<typename State, std::size_t i>() {
    if constexpr (requires { State::kInitialIsHostValue; }) std::get<i>(snapshot_->values) = State::get(gl);
  });
}

HostStateGuard::~HostStateGuard() {
  if (!snapshot_ || context_.lost()) return;
  const Functions& gl = context_.functions();
  state::applyState(
      gl, policy_ == HostStatePolicy::restore ? snapshot_->values : state::initialState(snapshot_->values));
  context_.noteBindingsChanged();
}

}  // namespace halfshadow::gl
