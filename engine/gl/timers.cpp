// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/timers.hpp"

namespace halfshadow::gl {

Timer::Timer(Context& context)
    : context_(context),
      kind_(context.capabilities().has(device::Capability::timerQuery) ? TimerKind::gpuQuery
                                                                       : TimerKind::finishBounded) {
  if (kind_ != TimerKind::gpuQuery) return;
  query_ = Object<ObjectKind::query>::create(context_);
  if (!query_) kind_ = TimerKind::finishBounded;
}

void Timer::begin() {
  if (context_.lost()) return;
  const Functions& gl = context_.functions();
  if (kind_ == TimerKind::gpuQuery) {
    GLint disjoint = 0;
    gl.getIntegerv(GL_GPU_DISJOINT_EXT, &disjoint);  // reading clears what happened before
    gl.beginQuery(GL_TIME_ELAPSED_EXT, query_.name());
  } else {
    gl.finish();
    beginTime_ = std::chrono::steady_clock::now();
  }
}

void Timer::end() {
  if (context_.lost()) return;
  const Functions& gl = context_.functions();
  if (kind_ == TimerKind::gpuQuery) {
    gl.endQuery(GL_TIME_ELAPSED_EXT);
  } else {
    gl.finish();
    finishBoundedMilliseconds_ =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - beginTime_).count();
  }
}

std::optional<double> Timer::milliseconds() {
  if (context_.lost()) return std::nullopt;
  if (kind_ == TimerKind::finishBounded) return finishBoundedMilliseconds_;
  const Functions& gl = context_.functions();
  GLuint64 nanoseconds = 0;
  gl.getQueryObjectui64v(query_.name(), GL_QUERY_RESULT_EXT, &nanoseconds);
  GLint disjoint = 0;
  gl.getIntegerv(GL_GPU_DISJOINT_EXT, &disjoint);
  if (disjoint) return std::nullopt;
  return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace halfshadow::gl
