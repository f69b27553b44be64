// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "base/keys.hpp"

namespace halfshadow {

// Based on: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014 (the mixing).
std::uint64_t combineKeys(std::uint64_t seed, std::uint64_t value) {
  std::uint64_t z = seed * 0x9e3779b97f4a7c15ull + value + 0x632be59bd9b4e019ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

std::uint64_t textKey(std::string_view text) {
  std::uint64_t key = 14695981039346656037ull;
  for (const char c : text) key = (key ^ static_cast<std::uint8_t>(c)) * 1099511628211ull;
  return key;
}

}  // namespace halfshadow
