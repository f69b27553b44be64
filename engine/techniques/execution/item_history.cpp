// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/item_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfshadow::techniques {
namespace {
/// Where more than this share of a list is different, it is drawn anew: the changes' rectangle is then mostly
/// the whole map, and finding that out costs as much as the draws that it could save.
constexpr double kMostChanged = 0.25;
/// Lists so short that all of them may change.
constexpr std::size_t kFewItems = 8;
/// Triangles that take a phone as long as the call that draws them: some 10 microseconds of the driver, at
/// 100 million triangles a second.
constexpr std::size_t kTrianglesPerCall = 1000;
/// Texels beyond the bounds on each side: one for rounding of what the rasteriser is given.
constexpr double kMarginTexels = 1.0;

/// Vertices reach the clip space by a matrix in single precision from the object's origin: four products and
/// their sums.
scene::Bounds rasterisedBounds(const DrawItem& item) {
  constexpr double kRounding = 1.0 / (1 << 21);
  scene::Bounds bounds = item.boundsWorld;
  const glm::dvec3 origin(item.worldFromObject[3]);
  const double reach = glm::length(glm::max(glm::abs(bounds.low - origin), glm::abs(bounds.high - origin)));
  bounds.low -= kRounding * reach;
  bounds.high += kRounding * reach;
  return bounds;
}

std::size_t mostChanges(std::size_t items) {
  return static_cast<std::size_t>(kMostChanged * static_cast<double>(items)) + kFewItems;
}

ItemHistory::Known knownOf(const DrawItem& item) {
  return {rasterisedBounds(item), workOf(item)};
}

bool stay(std::span<const ItemHistory::Change> changes) {
  return std::ranges::all_of(changes, [](const ItemHistory::Change& change) {
    return change.before != ItemHistory::kNowhere && change.after != ItemHistory::kNowhere;
  });
}

/// Values of a list's items, to the places that the items have now; those of changed ones are made anew.
template <typename Value>
void moveAlong(std::span<const ItemHistory::Change> changes, std::vector<Value>& values,
               std::vector<Value>& scratch) {
  constexpr std::uint32_t kNowhere = ItemHistory::kNowhere;
  if (stay(changes)) return;
  std::swap(values, scratch);
  values.clear();
  auto from = scratch.begin();
  for (const ItemHistory::Change& change : changes) {
    const auto end = change.before != kNowhere
                         ? scratch.begin() + change.before
                         : from + (change.after - static_cast<std::ptrdiff_t>(values.size()));
    values.insert(values.end(), from, end);
    from = change.before != kNowhere ? end + 1 : end;
    if (change.after != kNowhere) values.emplace_back();
  }
  values.insert(values.end(), from, scratch.end());
}
}  // namespace

std::uint32_t workOf(const DrawItem& item) {
  const std::size_t triangles = item.sourceMesh == nullptr ? 0 : item.sourceMesh->triangleCount();
  return static_cast<std::uint32_t>(1 + triangles / kTrianglesPerCall);
}

/// False when too many are different.
bool ItemHistory::takeChanges(std::span<const DrawItem> items, std::span<const std::uint32_t> places) {
  changes_.clear();
  if (places.size() > mostChanges(items.size())) return false;
  for (const std::uint32_t place : places)
    changes_.push_back({place, place, items_[place].boundsWorld, rasterisedBounds(items[place])});
  return true;
}

/// The same where they are to be found.
bool ItemHistory::findChanges(std::span<const DrawItem> items, std::span<const Key> keys) {
  const std::size_t most = mostChanges(items.size());
  changes_.clear();
  std::uint32_t before = 0, after = 0;
  while (before < keys_.size() || after < keys.size()) {
    const bool hasBefore = before < keys_.size(), hasAfter = after < keys.size();
    if (hasBefore && hasAfter && keys_[before] == keys[after]) {
      ++before, ++after;
      continue;
    }
    if (changes_.size() >= most) return false;
    Change& change = changes_.emplace_back();
    // Lists stand in the order of objects; in another order more counts as changed.
    if (hasBefore && (!hasAfter || keys_[before].object <= keys[after].object)) {
      change.before = before;
      change.boundsBefore = items_[before++].boundsWorld;
      if (!hasAfter || keys[after].object != keys_[change.before].object) continue;
    }
    change.after = after;
    change.boundsAfter = rasterisedBounds(items[after++]);
  }
  return true;
}

void ItemHistory::takeOver(std::span<const DrawItem> items, std::span<const Key> keys) {
  for (const Change& change : changes_) {
    if (change.before != kNowhere) work_ -= items_[change.before].work;
  }
  moveAlong(changes_, items_, before_);
  for (const Change& change : changes_) {
    if (change.after == kNowhere) continue;
    items_[change.after] = knownOf(items[change.after]);
    work_ += items_[change.after].work;
  }
  if (stay(changes_)) {
    for (const Change& change : changes_) keys_[change.after] = keys[change.after];
  } else {
    keys_.assign(keys.begin(), keys.end());
  }
}

void ItemHistory::update(std::span<const DrawItem> items, std::span<const Key> keys,
                         std::uint64_t& nextGeneration, const ListChanges& changes) {
  const auto places = changes.since(std::exchange(seen_, 0));
  if (keys.size() != items.size()) {
    listed_.clear();
    for (const DrawItem& item : items) listed_.push_back({item.object, item.revision});
    keys = listed_;
  }
  const std::uint64_t held = generation_;
  if (generation_ != 0 && (places ? takeChanges(items, places.places) : findChanges(items, keys))) {
    generationBefore_ = held;
    if (changes_.empty()) {
      seen_ = changes.revision;
      return;
    }
    takeOver(items, keys);
  } else {
    changes_.clear();
    generationBefore_ = 0;
    keys_.assign(keys.begin(), keys.end());
    items_.clear();
    work_ = 0;
    for (const DrawItem& item : items) {
      items_.push_back(knownOf(item));
      work_ += items_.back().work;
    }
  }
  generation_ = nextGeneration++;
  seen_ = changes.revision;
}

void TexelRect::include(const TexelRect& other) {
  if (other.empty()) return;
  if (empty()) *this = other;
  lowX = std::min(lowX, other.lowX), lowY = std::min(lowY, other.lowY);
  highX = std::max(highX, other.highX), highY = std::max(highY, other.highY);
}

TexelRect MapWindow::texelsOf(const scene::Bounds& boundsWorld) const {
  if (boundsWorld.empty()) return {};
  const auto texel = [](double at, int least, int extent) {
    return static_cast<std::int16_t>(
        std::clamp(at, static_cast<double>(least), static_cast<double>(least + extent)));
  };
  glm::dvec2 low(INFINITY), high(-INFINITY);
  const glm::dvec3 extent = boundsWorld.high - boundsWorld.low;
  const glm::dvec4 first = clipFromWorld * glm::dvec4(boundsWorld.low, 1.0);
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec4 clip = first;
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0) clip += extent[axis] * clipFromWorld[axis];
    }
    if (!(clip.w > 0.0)) {
      low = glm::dvec2(-INFINITY), high = glm::dvec2(INFINITY);
      break;
    }
    const glm::dvec2 place = glm::dvec2(clip) / clip.w;
    low = glm::min(low, place), high = glm::max(high, place);
  }
  const glm::dvec2 size(viewport.width, viewport.height), origin(viewport.x, viewport.y);
  low = origin + glm::floor((0.5 * low + 0.5) * size) - kMarginTexels;
  high = origin + glm::ceil((0.5 * high + 0.5) * size) + kMarginTexels;
  return {texel(low.x, viewport.x, viewport.width), texel(low.y, viewport.y, viewport.height),
          texel(high.x, viewport.x, viewport.width), texel(high.y, viewport.y, viewport.height)};
}

void ItemPlaces::update(const ItemHistory& list, const MapWindow& window) {
  if (generation_ == list.generation()) return;
  if (generation_ != 0 && generation_ == list.generationBefore()) {
    follow(list, window);
  } else {
    texels_.clear();
    for (const ItemHistory::Known& item : list.items()) texels_.push_back(window.texelsOf(item.boundsWorld));
  }
  generation_ = list.generation();
}

void ItemPlaces::follow(const ItemHistory& list, const MapWindow& window) {
  moveAlong(list.changes(), texels_, before_);
  for (const ItemHistory::Change& change : list.changes()) {
    if (change.after != ItemHistory::kNowhere) texels_[change.after] = window.texelsOf(change.boundsAfter);
  }
}

}  // namespace halfshadow::techniques
