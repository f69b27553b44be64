// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What the tool says, and its exit status.
#pragma once

#include <chrono>
#include <string>

#include "base/error.hpp"

namespace halfshadow::cli {

enum ExitStatus : int { kDone = 0, kFailed = 1, kBadUsage = 2 };

/// "halfshadow: <message>" on standard error.
void say(const std::string& message);
/// Says the error and gives its exit status: kBadUsage for arguments, techniques and settings that do not
/// exist.
ExitStatus fail(const Error& error);

/// Percentages on standard error for work that takes longer than a second: on a terminal one line that renews
/// itself, elsewhere a line every five seconds.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void update(const std::string& stage, double share);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_, last_;
  bool terminal_ = false, shown_ = false;
};

}  // namespace halfshadow::cli
