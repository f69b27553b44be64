// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A total over a list of which few values change at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace halfshadow {

/// Keeps totals of blocks of the list: where a value changes its block is looked at again, not the list. For
/// totals that are the same in whatever order they are made, such as bounds.
template <typename Total>
class BlockFold {
 public:
  /// The list is another.
  void forget() { blocks_.clear(); }
  /// The value at this place is another.
  void changed(std::size_t place) {
    if (place / kBlock < blocks_.size()) blocks_[place / kBlock].known = false;
  }
  /// Of `count` values; `add(total, place)` includes one of them, `join(total, other)` another total.
  template <typename Add, typename Join>
  Total total(std::size_t count, Add add, Join join) {
    blocks_.resize((count + kBlock - 1) / kBlock);
    Total all;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      Block& block = blocks_[i];
      if (!block.known) {
        block.total = {};
        for (std::size_t place = i * kBlock; place < std::min(count, (i + 1) * kBlock); ++place)
          add(block.total, place);
        block.known = true;
      }
      join(all, block.total);
    }
    return all;
  }

 private:
  /// About the root of some thousand values: as many blocks as values in one.
  static constexpr std::size_t kBlock = 64;
  struct Block {
    Total total;
    bool known = false;
  };
  std::vector<Block> blocks_;
};

}  // namespace halfshadow
