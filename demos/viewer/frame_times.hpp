// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Times of the last frames.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace halfshadow::viewer {

class FrameTimes {
 public:
  static constexpr std::size_t kKept = 120;
  /// The engine's on the CPU, and until the GPU was done; the window's, with panels and swap, likewise done.
  void add(double cpuMs, double totalMs, double windowMs) {
    frames_[next_++ % kKept] = {static_cast<float>(cpuMs), static_cast<float>(totalMs),
                                static_cast<float>(windowMs)};
  }
  void clear() { next_ = 0; }
  std::size_t count() const { return next_ < kKept ? next_ : kKept; }
  /// Oldest first, milliseconds.
  std::vector<float> cpu() const { return values(&Frame::cpuMs); }
  std::vector<float> total() const { return values(&Frame::totalMs); }
  std::vector<float> window() const { return values(&Frame::windowMs); }

 private:
  struct Frame {
    float cpuMs = 0.0f, totalMs = 0.0f, windowMs = 0.0f;
  };
  std::vector<float> values(float Frame::*member) const {
    std::vector<float> list;
    for (std::size_t i = next_ - count(); i < next_; ++i) list.push_back(frames_[i % kKept].*member);
    return list;
  }
  std::array<Frame, kKept> frames_{};
  std::size_t next_ = 0;
};

}  // namespace halfshadow::viewer
