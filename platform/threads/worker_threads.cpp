// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "threads/worker_threads.hpp"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace halfshadow {

void WorkerThreads::parallelFor(std::size_t count, void (*work)(std::size_t index, void* job), void* job,
                                void* user) {
  std::atomic<std::size_t> next{0};
  const auto help = [&] {
    for (std::size_t index = next++; index < count; index = next++) work(index, job);
  };
  const int most = static_cast<const WorkerThreads*>(user)->count_;
  const std::size_t helpers = std::min(count, static_cast<std::size_t>(std::max(most, 1))) - 1;
  std::vector<std::thread> threads;
  threads.reserve(helpers);
  try {
    while (threads.size() < helpers) threads.emplace_back(help);
  } catch (const std::system_error&) {
    // As many as the system gives.
  }
  help();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace halfshadow
