// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "base/workers.hpp"

#include <atomic>
#include <exception>
#include <vector>

namespace halfshadow {
namespace {
/// What the host's function is given: nothing that it does makes a piece run twice, or throws through it.
struct Job {
  explicit Job(std::size_t count) : begun(count), thrown(count) {}
  void (*work)(std::size_t index, void* job) = nullptr;
  void* job = nullptr;
  std::vector<std::atomic<bool>> begun;
  std::vector<std::exception_ptr> thrown;

  void run(std::size_t index) {
    if (index >= begun.size() || begun[index].exchange(true)) return;
    try {
      work(index, job);
    } catch (...) {
      thrown[index] = std::current_exception();
    }
  }
};
}  // namespace

void Workers::run(std::size_t count, void (*work)(std::size_t index, void* job), void* job) const {
  if (parallelFor_ == nullptr || count < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i, job);
    return;
  }
  Job shared(count);
  shared.work = work;
  shared.job = job;
  parallelFor_(
      count, [](std::size_t index, void* of) { static_cast<Job*>(of)->run(index); }, &shared, user_);
  // What the host left out.
  for (std::size_t i = 0; i < count; ++i) shared.run(i);
  for (const std::exception_ptr& thrown : shared.thrown) {
    if (thrown) std::rethrow_exception(thrown);
  }
}

}  // namespace halfshadow
