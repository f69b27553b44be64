// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Emulated fp16 (what `mediump` is on many GPUs), and the scalar functions that the coverage templates use.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace halfshadow::coverage {

/// The nearest fp16 value, ties to even: 11 significant bits, subnormals below 2^-14, infinite from 65520.
inline float roundToHalf(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude >= 0x7f800000u) return value;
  if (magnitude < 0x38800000u) {
    // Adding 2^-14 · 2^10 aligns the last bit kept with fp32's last bit: fp32 itself rounds to even.
    constexpr float kAligner = 0.75f;
    const float rounded = (std::bit_cast<float>(magnitude) + kAligner) - kAligner;
    return std::copysign(rounded, value);
  }
  const std::uint32_t rounded = (magnitude + 0x0fffu + ((magnitude >> 13) & 1u)) & ~0x1fffu;
  if (rounded >= 0x47800000u) return std::copysign(std::numeric_limits<float>::infinity(), value);
  return std::bit_cast<float>((bits & 0x80000000u) | rounded);
}

/// fp16, rounded to nearest even after each operation. fp32 has more than twice the bits and two to spare,
/// so rounding its results once more gives the correctly rounded fp16 result of + - * /.
class Half {
 public:
  Half() = default;
  Half(float value) : value_(roundToHalf(value)) {}
  Half(double value) : Half(static_cast<float>(value)) {}
  Half(int value) : Half(static_cast<float>(value)) {}
  explicit operator float() const { return value_; }
  explicit operator double() const { return value_; }

  friend Half operator+(Half a, Half b) { return {a.value_ + b.value_}; }
  friend Half operator-(Half a, Half b) { return {a.value_ - b.value_}; }
  friend Half operator*(Half a, Half b) { return {a.value_ * b.value_}; }
  friend Half operator/(Half a, Half b) { return {a.value_ / b.value_}; }
  friend Half operator-(Half a) { return {-a.value_}; }
  friend bool operator<(Half a, Half b) { return a.value_ < b.value_; }
  friend bool operator>(Half a, Half b) { return a.value_ > b.value_; }
  friend bool operator<=(Half a, Half b) { return a.value_ <= b.value_; }
  friend bool operator>=(Half a, Half b) { return a.value_ >= b.value_; }
  friend bool operator==(Half a, Half b) { return a.value_ == b.value_; }

 private:
  float value_ = 0.0f;
};

template <typename T>
T absolute(T a) {
  return a < T(0) ? -a : a;
}
template <typename T>
T smaller(T a, T b) {
  return b < a ? b : a;
}
template <typename T>
T larger(T a, T b) {
  return a < b ? b : a;
}
template <typename T>
T clamped(T a, T low, T high) {
  return smaller(larger(a, low), high);
}

/// Divisors are never below this: far under every value that matters, yet its reciprocal is finite. The
/// shaders use the fp32 value in highp and the fp16 value in mediump.
template <typename T>
T smallestDivisor() {
  return T(1e-30);
}
template <>
inline Half smallestDivisor<Half>() {
  return {6.2e-5f};
}

}  // namespace halfshadow::coverage
