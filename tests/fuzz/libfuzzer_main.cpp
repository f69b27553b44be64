// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The target as libFuzzer wants it: half of the mutations are libFuzzer's own, half those of the driver.
#include <cstring>

#include "mutation.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const halfshadow::fuzz::Target& target = halfshadow::fuzz::target();
  if (size <= target.largestInput) target.test({data, size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t largest,
                                               unsigned seed) {
  using namespace halfshadow::fuzz;
  static const Mutator mutator(target());
  static const std::vector<Bytes> seeds = target().seeds();
  Random random(seed);
  Bytes input;
  if (random() % 2 == 0) {
    size = LLVMFuzzerMutate(data, size, largest);
    input.assign(data, data + size);
    mutator.repair(input, random);
  } else {
    input.assign(data, data + size);
    mutator.mutate(input, seeds, random);
  }
  if (input.size() > largest) input.resize(largest);
  std::memcpy(data, input.data(), input.size());
  return input.size();
}
