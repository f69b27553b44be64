// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How places in (t, i) stand in records of eight bytes: see EncodedLists.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>

namespace halfshadow::techniques {

/// Bytes of a record.
inline constexpr std::size_t kRecordBytes = 8;
/// A centre is counted in so many steps.
inline constexpr float kCenterSteps = 256.0f;

/// Where the vertices of one list are counted from, and in what.
struct ListPlacement {
  glm::vec3 center{0.0f}, step{1.0f};
};

/// About `center`, with steps that are powers of two and at least `least`.
ListPlacement placementAbout(const glm::vec3& center, glm::vec3 least);

/// Two bytes, high first, of the nearest whole number.
inline void putCode(float value, std::uint8_t* texels) {
  // To the nearest whole number without a call of the library, in double so that no half is lost.
  const double clamped = std::clamp(value, -32768.0f, 32767.0f);
  const int code = static_cast<int>(clamped + (clamped < 0.0 ? -0.5 : 0.5)) + 32768;
  texels[0] = static_cast<std::uint8_t>(code >> 8);
  texels[1] = static_cast<std::uint8_t>(code & 255);
}

/// The record that a list begins with.
void encodePlacement(const ListPlacement& placement, std::uint8_t* texels);

}  // namespace halfshadow::techniques
