// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Threads for an engine of a host that has no scheduler of its own.
#pragma once

#include <cstddef>

namespace halfshadow {

/// Lives as long as the engine that it is lent to: EngineDesc::parallelFor and parallelForUser.
class WorkerThreads {
 public:
  /// `count`: at least 1, the calling thread among them.
  explicit WorkerThreads(int count) : count_(count) {}
  int count() const { return count_; }
  /// `user`: a WorkerThreads.
  static void parallelFor(std::size_t count, void (*work)(std::size_t index, void* job), void* job,
                          void* user);

 private:
  int count_;
};

}  // namespace halfshadow
