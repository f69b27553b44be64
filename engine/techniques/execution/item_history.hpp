// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lists of drawn items followed from frame to frame: what is different in them, and where each item lies in
/// a map. No GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/list_changes.hpp"
#include "base/rect.hpp"
#include "scene/bounds.hpp"
#include "techniques/core/draw_item.hpp"

namespace halfshadow::techniques {

/// One list. What it held is known by a generation, which no other state of any list has.
class ItemHistory {
 public:
  struct Known {
    scene::Bounds boundsWorld;  ///< of what is rasterised: grown by what single precision may be off
    std::uint32_t work = 0;     ///< see workOf()
  };
  static constexpr std::uint32_t kNowhere = ~0u;
  /// An item that is another than before: its places in the list then and now, kNowhere where it was not, or
  /// is no more.
  struct Change {
    std::uint32_t before = kNowhere, after = kNowhere;
    scene::Bounds boundsBefore, boundsAfter;
  };

  /// What tells an item from others and from itself at another time.
  struct Key {
    std::uint64_t object = 0, revision = 0;
    bool operator==(const Key&) const = default;
  };
  /// Takes over what the list holds now. `keys`: of its items, where the caller has them apart, so that
  /// looking through all touches little memory. `nextGeneration` is counted on where the list is different.
  /// `changes`: of the items, by place.
  void update(std::span<const DrawItem> items, std::span<const Key> keys, std::uint64_t& nextGeneration,
              const ListChanges& changes = {});

  std::uint64_t generation() const { return generation_; }
  /// Of which the changes lead to the generation that is now; 0: of none, since too much is different.
  std::uint64_t generationBefore() const { return generationBefore_; }
  /// Ascending, both by place before and by place now; what is not named kept its order.
  std::span<const Change> changes() const { return changes_; }
  std::span<const Known> items() const { return items_; }
  std::uint64_t work() const { return work_; }  ///< of all

 private:
  bool findChanges(std::span<const DrawItem> items, std::span<const Key> keys);
  bool takeChanges(std::span<const DrawItem> items, std::span<const std::uint32_t> places);
  void takeOver(std::span<const DrawItem> items, std::span<const Key> keys);

  std::vector<Key> keys_, listed_;
  std::vector<Known> items_, before_;
  std::vector<Change> changes_;
  std::uint64_t generation_ = 0, generationBefore_ = 0;
  std::uint64_t seen_ = 0;  ///< revision of the items
  std::uint64_t work_ = 0;
};

/// What drawing an item costs, in draw calls of a small mesh.
std::uint32_t workOf(const DrawItem& item);

/// A rectangle of texels, without its upper ends; empty where they are not above the lower ones.
struct TexelRect {
  std::int16_t lowX = 0, lowY = 0, highX = 0, highY = 0;
  bool empty() const { return lowX >= highX || lowY >= highY; }
  bool meets(const TexelRect& other) const {
    return lowX < other.highX && other.lowX < highX && lowY < other.highY && other.lowY < highY;
  }
  void include(const TexelRect& other);
  Rect rect() const { return {lowX, lowY, highX - lowX, highY - lowY}; }
};

/// A projection into a part of a target.
struct MapWindow {
  glm::dmat4 clipFromWorld{1.0};
  Rect viewport;
  /// Where something inside the bounds can set texels. All of the viewport for what reaches behind the centre
  /// of projection.
  TexelRect texelsOf(const scene::Bounds& boundsWorld) const;
};

/// Of all items of a list through one window.
class ItemPlaces {
 public:
  void update(const ItemHistory& list, const MapWindow& window);
  std::span<const TexelRect> texels() const { return texels_; }

 private:
  void follow(const ItemHistory& list, const MapWindow& window);
  std::vector<TexelRect> texels_, before_;
  std::uint64_t generation_ = 0;  ///< of the list
};

}  // namespace halfshadow::techniques
