// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Large contents known again by 128 bits of hash.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace halfshadow {

/// Two contents that share it are taken for one.
struct ContentKey {
  std::uint64_t low = 0, high = 0;
  bool operator==(const ContentKey&) const = default;
  struct Hash {
    std::size_t operator()(const ContentKey& key) const { return static_cast<std::size_t>(key.low); }
  };
};

/// Two lanes of multiply and rotate, with odd constants of random bits.
class ContentHasher {
 public:
  void add(std::uint64_t value) {
    low_ = std::rotl((low_ ^ value) * 0x9fb21c651e98df25ull, 29);
    high_ = std::rotl((high_ + value) * 0xd6e8feb86659fd93ull, 37) ^ low_;
  }
  void add(const void* data, std::size_t byteCount) {
    const auto* bytes = static_cast<const std::byte*>(data);
    for (; byteCount >= 8; bytes += 8, byteCount -= 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, 8);
      add(word);
    }
    std::uint64_t rest = 0;
    std::memcpy(&rest, bytes, byteCount);
    add(rest);
  }
  ContentKey key() const { return {low_, high_ * 0x9fb21c651e98df25ull ^ high_ >> 31}; }

 private:
  std::uint64_t low_ = 0x3c79ac492ba7b653ull, high_ = 0x1c69b3f74ac4ae35ull;
};

}  // namespace halfshadow
