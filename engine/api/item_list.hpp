// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lists of what passes draw, kept from frame to frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/list_changes.hpp"
#include "techniques/core/draw_item.hpp"
#include "techniques/execution/item_history.hpp"

namespace halfshadow::api {

/// A list of values made from some of the scene's objects. One is made anew where another object stands in
/// its place, or the object changed.
template <typename Value>
class KeptList {
 public:
  using Key = techniques::ItemHistory::Key;
  std::span<const Value> values() const { return values_; }
  std::span<const Key> keys() const { return keys_; }
  /// Of the values, by place.
  ListChanges changes() const { return {revision_, changed_}; }
  /// Whether it holds values of these objects, in this order.
  bool isOf(std::span<const std::uint32_t> objects) const { return std::ranges::equal(objects_, objects); }

  /// Brings it to these objects, given by index. `scene`: what changed of them. `keyOf(object)`: of all that
  /// the value is made from, with a revision that is never 0; `make(object)`: a Result. Errors: those of
  /// `make`.
  template <typename KeyOf, typename Make>
  Status follow(std::span<const std::uint32_t> objects, const ListChanges& scene, KeyOf keyOf, Make make) {
    const bool same = isOf(objects);
    const auto few = same ? scene.since(seen_) : ListChanges::Since{};
    // Whoever follows looks at all of it after an error or an exception.
    if (std::exchange(unfinished_, true)) revision_ += 2;
    seen_ = 0;
    now_.clear();
    if (!same) {
      keys_.resize(objects.size());
      values_.resize(objects.size());
      objects_.assign(objects.begin(), objects.end());
    }
    const auto look = [&](std::size_t place) -> Status {
      const Key key = keyOf(objects[place]);
      if (keys_[place] == key) return {};
      Result<Value> value = make(objects[place]);
      if (!value) return value.error();
      keys_[place] = key;
      values_[place] = std::move(value).value();
      now_.push_back(static_cast<std::uint32_t>(place));
      return {};
    };
    Status looked;
    if (few && few.places.size() <= kFewChanged) {
      for (const std::uint32_t object : few.places) {
        const auto place = std::ranges::find(objects_, object);
        if (place != objects_.end() && looked)
          looked = look(static_cast<std::size_t>(place - objects_.begin()));
      }
      std::ranges::sort(now_);
    } else {
      for (std::size_t place = 0; place < objects.size() && looked; ++place) looked = look(place);
    }
    if (!looked) return looked;
    unfinished_ = false;
    if (!same) revision_ += 2;
    if (same && !now_.empty()) {
      ++revision_;
      std::swap(changed_, now_);
    }
    seen_ = scene.revision;
    return {};
  }

 private:
  /// Each is searched for in the list.
  static constexpr std::size_t kFewChanged = 16;
  std::vector<std::uint32_t> objects_;
  std::vector<Key> keys_;  ///< apart from the values: comparing them touches little memory
  std::vector<Value> values_;
  std::vector<std::uint32_t> changed_, now_;  ///< places: that led to the revision; while following
  std::uint64_t revision_ = 0, seen_ = 0;     ///< its own, and the scene's that it follows
  bool unfinished_ = false;
};

using ItemList = KeptList<techniques::DrawItem>;

}  // namespace halfshadow::api
