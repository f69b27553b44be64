// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/casters_apart.hpp"

#include <algorithm>
#include <array>

namespace halfshadow::outlines {
namespace {
/// Casters of a list that are tested against each other.
constexpr std::size_t kMostApart = 32;

/// Ranges of a caster along an axis of the light, as the corners of a receiver box see it.
struct SeenRange {
  std::array<float, 4> low, high;
};
}  // namespace

bool castersApart(std::span<const ListRecord> list, const TangentBox& receivers) {
  std::vector<std::array<SeenRange, 2>> casters;
  bool starts = true;
  for (const ListRecord& record : list) {
    if (record.behindFacet != ListRecord::kVertex || record.ti.z <= receivers.iHigh) return false;
    if (starts) {
      SeenRange none;
      none.low.fill(1e30f), none.high.fill(-1e30f);
      casters.push_back({none, none});
      if (casters.size() > kMostApart) return false;
    }
    starts = record.end != ListRecord::End::none;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const glm::vec2 t = corner & 1 ? receivers.tHigh : receivers.tLow;
      const float inverse = 1.0f / (record.ti.z - (corner & 2 ? receivers.iHigh : receivers.iLow));
      for (int axis = 0; axis < 2; ++axis) {
        SeenRange& range = casters.back()[static_cast<std::size_t>(axis)];
        const float seen = (record.ti[axis] - t[axis]) * inverse;
        range.low[corner] = std::min(range.low[corner], seen);
        range.high[corner] = std::max(range.high[corner], seen);
      }
    }
  }
  const auto before = [](const SeenRange& a, const SeenRange& b) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (a.high[c] > b.low[c]) return false;
    }
    return true;
  };
  for (std::size_t k = 0; k < casters.size(); ++k) {
    for (std::size_t m = 0; m < k; ++m) {
      const auto &a = casters[k], &b = casters[m];
      if (!before(a[0], b[0]) && !before(b[0], a[0]) && !before(a[1], b[1]) && !before(b[1], a[1]))
        return false;
    }
  }
  return true;
}

}  // namespace halfshadow::outlines
