// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a fuzz target is. One source file defines target(); it is linked with the replaying driver (every
/// build), or with libFuzzer (clang).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace halfshadow::fuzz {

using Bytes = std::vector<std::uint8_t>;
using Input = std::span<const std::uint8_t>;

struct Target {
  const char* name = "";
  /// Any bytes at all. What must hold is said with require(); crashes, hangs and leaks fail by themselves.
  void (*test)(Input input) = nullptr;
  /// Valid inputs, the same in every run: where mutations start from.
  std::vector<Bytes> (*seeds)() = nullptr;
  /// Words that mutations put in; may be null.
  std::vector<std::string> (*dictionary)() = nullptr;
  /// Makes lengths and the like agree again with what a mutation did, so that more than the first check is
  /// reached; may be null.
  void (*repair)(Bytes& input) = nullptr;
  std::size_t largestInput = 4096;  ///< bytes
};

const Target& target();

/// Ends the process, as a crash does, with the sentence of what does not hold.
void require(bool holds, const std::string& sentence);

Bytes bytesOf(std::string_view text);

}  // namespace halfshadow::fuzz
