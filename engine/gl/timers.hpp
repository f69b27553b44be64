// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Times of GPU work: EXT_disjoint_timer_query where it works, else CPU time between two glFinish.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "gl/objects.hpp"

namespace halfshadow::gl {

enum class TimerKind { gpuQuery, finishBounded };

/// Times consecutive spans; begin/end pairs do not nest (a limit of the extension).
class Timer {
 public:
  explicit Timer(Context& context);
  TimerKind kind() const { return kind_; }
  void begin();
  void end();
  /// Milliseconds of the last begin/end pair; waits for the result. Empty when the GPU reported a disjoint
  /// event (the clock changed) — repeat the measurement.
  std::optional<double> milliseconds();

 private:
  Context& context_;
  TimerKind kind_;
  Object<ObjectKind::query> query_;
  std::chrono::steady_clock::time_point beginTime_;
  double finishBoundedMilliseconds_ = 0.0;
};

}  // namespace halfshadow::gl
