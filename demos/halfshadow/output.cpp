// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "output.hpp"

#include <unistd.h>

#include <cstdio>

namespace halfshadow::cli {

void say(const std::string& message) {
  std::fprintf(stderr, "halfshadow: %s\n", message.c_str());
}

ExitStatus fail(const Error& error) {
  say(error.message);
  switch (error.code) {
    case ErrorCode::invalidArgument:
    case ErrorCode::unknownTechnique:
    case ErrorCode::unknownSetting:
      return kBadUsage;
    default:
      return kFailed;
  }
}

ProgressLine::ProgressLine() : start_(Clock::now()), last_(start_), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::update(const std::string& stage, double share) {
  using namespace std::chrono_literals;
  const Clock::time_point now = Clock::now();
  if (now - start_ < 1s) return;
  if (shown_ && now - last_ < (terminal_ ? Clock::duration(100ms) : Clock::duration(5s))) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, terminal_ ? "\rhalfshadow: %s %3.0f %%\033[K" : "halfshadow: %s %.0f %%\n",
               stage.c_str(), 100.0 * share);
  std::fflush(stderr);
}

}  // namespace halfshadow::cli
