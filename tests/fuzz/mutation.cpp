// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "mutation.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace halfshadow::fuzz {
namespace {
constexpr const char* kNumbers[] = {"0",     "-1",         "1",          "2",   "3",          "255",
                                    "65535", "2147483647", "4294967295", "-0",  "1e999",      "-1e300",
                                    "0.5",   "1e-300",     "5126",       "4e9", "1000000000", "null"};

std::size_t below(Random& random, std::size_t count) {
  return count == 0 ? 0 : random() % count;
}

bool isNumberByte(std::uint8_t byte) {
  return (byte >= '0' && byte <= '9') || byte == '.' || byte == '-' || byte == '+' || byte == 'e';
}

/// The next number written in the text behind a random place; false where there is none.
bool findNumber(const Bytes& input, Random& random, std::size_t& first, std::size_t& last) {
  first = below(random, input.size());
  while (first < input.size() && !(input[first] >= '0' && input[first] <= '9')) ++first;
  if (first == input.size()) return false;
  while (first > 0 && isNumberByte(input[first - 1])) --first;
  for (last = first; last < input.size() && isNumberByte(input[last]);) ++last;
  return true;
}

void replace(Bytes& input, std::size_t first, std::size_t last, std::string_view text) {
  input.erase(input.begin() + static_cast<std::ptrdiff_t>(first),
              input.begin() + static_cast<std::ptrdiff_t>(last));
  input.insert(input.begin() + static_cast<std::ptrdiff_t>(first), text.begin(), text.end());
}

template <typename T>
void overwrite(Bytes& input, std::size_t at, T value) {
  if (at + sizeof value <= input.size()) std::memcpy(&input[at], &value, sizeof value);
}

void overwriteWord(Bytes& input, Random& random) {
  constexpr std::uint32_t kWords[] = {0, 1, 2, 0x7f, 0xff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff};
  constexpr float kFloats[] = {0.0f,
                               -0.0f,
                               1.0f,
                               -1.0f,
                               1e-30f,
                               1e30f,
                               std::numeric_limits<float>::max(),
                               std::numeric_limits<float>::denorm_min(),
                               std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN()};
  const std::size_t at = below(random, input.size()) / 4 * 4 + (random() % 4 == 0 ? random() % 4 : 0);
  if (random() % 2 == 0) {
    overwrite(input, at, kWords[below(random, std::size(kWords))]);
  } else {
    overwrite(input, at, kFloats[below(random, std::size(kFloats))]);
  }
}
}  // namespace

void require(bool holds, const std::string& sentence) {
  if (holds) return;
  std::fprintf(stderr, "fuzz target %s: %s\n", target().name, sentence.c_str());
  std::abort();
}

Bytes bytesOf(std::string_view text) {
  return Bytes(text.begin(), text.end());
}

Mutator::Mutator(const Target& target) : target_(target) {
  if (target.dictionary) words_ = target.dictionary();
}

void Mutator::mutate(Bytes& input, std::span<const Bytes> others, Random& random) const {
  for (std::size_t count = std::size_t{1} << below(random, 4); count > 0; --count)
    mutateOnce(input, others, random);
  if (input.size() > target_.largestInput) input.resize(target_.largestInput);
  repair(input, random);
}

void Mutator::repair(Bytes& input, Random& random) const {
  if (target_.repair && random() % 4 != 0) target_.repair(input);
}

void Mutator::mutateOnce(Bytes& input, std::span<const Bytes> others, Random& random) const {
  if (input.empty()) input.push_back(static_cast<std::uint8_t>(random()));
  const std::size_t at = below(random, input.size());
  const std::size_t length = 1 + below(random, std::min<std::size_t>(input.size() - at, 64));
  const auto begin = input.begin() + static_cast<std::ptrdiff_t>(at),
             end = begin + static_cast<std::ptrdiff_t>(length);
  std::size_t first = 0, last = 0;
  switch (below(random, 12)) {
    case 0:
      input[at] = static_cast<std::uint8_t>(input[at] ^ (1u << below(random, 8)));
      return;
    case 1:
      input[at] = static_cast<std::uint8_t>(random());
      return;
    case 2:
    case 3:
      return overwriteWord(input, random);
    case 4:
      input.erase(begin, end);
      return;
    case 5: {
      const Bytes copy(begin, end);
      input.insert(input.begin() + static_cast<std::ptrdiff_t>(below(random, input.size())), copy.begin(),
                   copy.end());
      return;
    }
    case 6:
      std::reverse(begin, end);
      return;
    case 7:
    case 8:
      if (findNumber(input, random, first, last))
        replace(input, first, last, kNumbers[below(random, std::size(kNumbers))]);
      return;
    case 9:
    case 10:
      if (!words_.empty())
        replace(input, at, random() % 2 == 0 ? at : at + length, words_[below(random, words_.size())]);
      return;
    default: {
      const Bytes& other = others[below(random, others.size())];
      const std::size_t from = below(random, other.size());
      input.resize(at);
      input.insert(input.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
    }
  }
}

}  // namespace halfshadow::fuzz
