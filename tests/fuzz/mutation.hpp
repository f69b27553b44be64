// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Mutations of inputs, of bytes and of numbers in text; the same on every machine.
#pragma once

#include <random>

#include "fuzz_target.hpp"

namespace halfshadow::fuzz {

using Random = std::mt19937;  ///< its numbers are the standard's, those of distributions are not

class Mutator {
 public:
  explicit Mutator(const Target& target);
  /// One to eight mutations; three times in four repaired. `others`: what may be spliced in; not empty.
  void mutate(Bytes& input, std::span<const Bytes> others, Random& random) const;
  void repair(Bytes& input, Random& random) const;

 private:
  void mutateOnce(Bytes& input, std::span<const Bytes> others, Random& random) const;
  const Target& target_;
  std::vector<std::string> words_;
};

}  // namespace halfshadow::fuzz
