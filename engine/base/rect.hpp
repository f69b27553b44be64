// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Rectangles of pixels or texels.
#pragma once

namespace halfshadow {

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;  ///< from the lower left corner
  bool operator==(const Rect&) const = default;
};

}  // namespace halfshadow
