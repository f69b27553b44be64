// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "base/log.hpp"

#include <utility>

namespace halfshadow {
namespace {
LogSink& sink() {
  static LogSink instance;
  return instance;
}
}  // namespace

void setLogSink(LogSink replacement) {
  sink() = std::move(replacement);
}

void logMessage(LogLevel level, std::string_view message) {
  if (sink()) sink()(level, message);
}

}  // namespace halfshadow
