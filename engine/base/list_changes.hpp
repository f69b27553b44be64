// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What is different in a list, for those who follow it.
#pragma once

#include <cstdint>
#include <span>

namespace halfshadow {

/// How a list came to its present revision. A list counts on by one where some of its values changed in their
/// places, and by two where it is another list.
struct ListChanges {
  std::uint64_t revision = 0;  ///< 0: nobody counts
  /// That changed since the revision before this one, ascending; they stay while the revision does.
  std::span<const std::uint32_t> places;
  /// What to look at again: places of the list, or all of it where they are not known.
  struct Since {
    std::span<const std::uint32_t> places;
    bool known = false;
    explicit operator bool() const { return known; }
  };
  /// For one who saw the list at that revision, and 0 for never.
  Since since(std::uint64_t seen) const {
    if (seen == 0 || revision == 0) return {};
    if (seen == revision) return {.known = true};
    return seen + 1 == revision ? Since{places, true} : Since{};
  }
};

}  // namespace halfshadow
