// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The host's threads, where it lends some.
#pragma once

#include <cstddef>
#include <type_traits>

namespace halfshadow {

/// Spreads pieces of work over threads of the host (EngineDesc::parallelFor), or does one after another.
class Workers {
 public:
  using ParallelFor = void (*)(std::size_t count, void (*work)(std::size_t index, void* job), void* job,
                               void* user);
  Workers() = default;
  Workers(ParallelFor parallelFor, void* user) : parallelFor_(parallelFor), user_(user) {}

  bool lent() const { return parallelFor_ != nullptr; }

  /// work(0) to work(count - 1), each once, in any order and some at the same time. Returns when all have
  /// ended, and throws what the first of those that threw did.
  template <typename Work>
  void forEach(std::size_t count, Work&& work) const {
    run(
        count,
        [](std::size_t index, void* job) { (*static_cast<std::remove_reference_t<Work>*>(job))(index); },
        &work);
  }

 private:
  void run(std::size_t count, void (*work)(std::size_t index, void* job), void* job) const;

  ParallelFor parallelFor_ = nullptr;
  void* user_ = nullptr;
};

}  // namespace halfshadow
