// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Bytes as decisions, for targets whose inputs are no files; and those decisions as bytes, for seeds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "fuzz_target.hpp"

namespace halfshadow::fuzz {

/// Behind the end everything is 0.
class InputReader {
 public:
  explicit InputReader(Input input) : input_(input) {}
  bool atEnd() const { return at_ >= input_.size(); }
  std::uint8_t byte() { return atEnd() ? 0 : input_[at_++]; }
  bool flag() { return (byte() & 1) != 0; }
  /// 0 … count - 1, count at most 256.
  std::size_t below(std::size_t count) { return byte() % count; }
  template <typename T>
  T raw() {
    T value{};
    const std::size_t there = std::min(sizeof value, input_.size() - std::min(at_, input_.size()));
    if (there > 0) std::memcpy(&value, input_.data() + at_, there);
    at_ += there;
    return value;
  }
  /// One byte: mostly a multiple of 1/8 in [-12, 12), else one of those that break things.
  double number() {
    constexpr double kOdd[] = {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(),
                               1e300,
                               -1e300,
                               1e38,
                               3e38,
                               1e18,
                               -1e9,
                               1e6,
                               1e-6,
                               1e-30,
                               1e-200,
                               5e-324,
                               -0.0,
                               1e15};
    const std::uint8_t code = byte();
    return code >= kFirstOdd ? kOdd[code - kFirstOdd] : (code - kZero) / 8.0;
  }
  /// Never one of the odd ones.
  double plainNumber() {
    const std::uint8_t code = byte();
    return (code % kFirstOdd - kZero) / 8.0;
  }
  std::string text(std::size_t longest) {
    const std::size_t length = std::min({below(256), longest, input_.size() - std::min(at_, input_.size())});
    std::string text(reinterpret_cast<const char*>(input_.data()) + at_, length);
    at_ += length;
    return text;
  }

  static constexpr int kFirstOdd = 240, kZero = 120;

 private:
  Input input_;
  std::size_t at_ = 0;
};

/// Writes what InputReader reads.
class InputWriter {
 public:
  Bytes bytes;
  InputWriter& byte(std::size_t value) {
    bytes.push_back(static_cast<std::uint8_t>(value));
    return *this;
  }
  template <typename T>
  InputWriter& raw(const T& value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
    return *this;
  }
  /// The nearest multiple of 1/8 in [-15, 15).
  InputWriter& number(double value) {
    return byte(static_cast<std::size_t>(std::lround(value * 8.0) + InputReader::kZero));
  }
  InputWriter& numbers(std::initializer_list<double> values) {
    for (const double value : values) number(value);
    return *this;
  }
  InputWriter& text(std::string_view text) {
    byte(text.size());
    bytes.insert(bytes.end(), text.begin(), text.end());
    return *this;
  }
};

}  // namespace halfshadow::fuzz
