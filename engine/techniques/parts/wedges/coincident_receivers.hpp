// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Receivers whose surfaces lie in each other, as two floors in one plane: a pixel shows one of them, but
/// both pass its depth test. CPU only.
#pragma once

#include <map>
#include <span>
#include <utility>

#include "techniques/core/draw_item.hpp"

namespace halfshadow::techniques {

/// Whether triangles of the two receivers, or two of the same one, overlap in one plane, as far as the
/// rounding of their vertices tells.
bool surfacesCoincide(const DrawItem& a, const DrawItem& b);

/// Keeps what was found while receivers stay.
class CoincidentReceivers {
 public:
  /// Whether some two of them do, or one does with itself. Of receivers of many triangles only those are
  /// found that fill the same box.
  bool among(std::span<const DrawItem> receivers);

 private:
  struct Known {
    std::uint64_t revisionA = 0, revisionB = 0;
    bool coincide = false;
  };
  bool coincide(const DrawItem& a, const DrawItem& b);
  /// By their triangles where both have few, else by their boxes.
  bool compare(const DrawItem& a, const DrawItem& b, double rounding);
  std::map<std::pair<std::uint64_t, std::uint64_t>, Known> known_;
};

}  // namespace halfshadow::techniques
