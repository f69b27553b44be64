// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How places in (t, i) stand in records of eight bytes: see EncodedLists.
#pragma once

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
void putCode(float value, std::uint8_t* texels);

/// The record that a list begins with.
void encodePlacement(const ListPlacement& placement, std::uint8_t* texels);

}  // namespace halfshadow::techniques
