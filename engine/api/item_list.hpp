// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lists of what passes draw, kept from frame to frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "techniques/core/draw_item.hpp"
#include "techniques/execution/item_history.hpp"

namespace halfshadow::api {

/// A list of values made from objects. One is made anew where another object stands in its place, or the
/// object changed.
template <typename Value>
class KeptList {
 public:
  std::span<const Value> values() const { return values_; }
  std::span<const techniques::ItemHistory::Key> keys() const { return slots_; }

  void resize(std::size_t count) {
    slots_.resize(count);
    values_.resize(count);
  }
  /// `key`: of all that the value is made from, never 0.
  bool holds(std::size_t place, std::uint64_t object, std::uint64_t key) const {
    return slots_[place].object == object && slots_[place].revision == key;
  }
  void put(std::size_t place, std::uint64_t object, std::uint64_t key, Value value) {
    slots_[place] = {object, key};
    values_[place] = std::move(value);
  }
  void clear() {
    slots_.clear();
    values_.clear();
  }

 private:
  std::vector<techniques::ItemHistory::Key>
      slots_;  ///< apart from the values: comparing them touches little memory
  std::vector<Value> values_;
};

using ItemList = KeptList<techniques::DrawItem>;

}  // namespace halfshadow::api
