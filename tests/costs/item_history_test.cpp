// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What is followed from frame to frame is what looking at everything finds.
#include "techniques/execution/item_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "api/item_list.hpp"
#include "api/receiver_reach.hpp"

namespace halfshadow::techniques {
namespace {

class RandomItems {
 public:
  explicit RandomItems(std::uint32_t seed) : random_(seed) {
    while (items.size() < 50) add();
  }
  double at(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::size_t any() { return random_() % items.size(); }

  void place(DrawItem& item) {
    const glm::dvec3 center(at(-9, 9), at(-9, 9), at(-20, 3)), half(at(0.1, 2), at(0.1, 2), at(0.1, 2));
    item.boundsWorld = {center - half, center + half};
    item.worldFromObject = glm::translate(glm::dmat4(1.0), center);
    item.revision = ++lastRevision_;
  }
  void add() { place(items.emplace_back(DrawItem{.object = ++lastObject_})); }
  void step() {
    const std::uint32_t what = random_() % 8;
    if (what == 0) add();
    if (what == 1 && items.size() > 2) items.erase(items.begin() + static_cast<std::ptrdiff_t>(any()));
    if (what == 2) std::swap(items[any()], items[any()]);  // out of the order of objects
    if (what == 3 && at(0, 1) < 0.2) items.clear(), add(), add();
    while (what == 4 && items.size() < 50) add();
    for (std::uint32_t i = 0; i < what; ++i) place(items[any()]);
  }
  std::vector<ItemHistory::Key> keys() const {
    std::vector<ItemHistory::Key> keys;
    for (const DrawItem& item : items) keys.push_back({item.object, item.revision});
    return keys;
  }
  std::vector<DrawItem> items;

 private:
  std::mt19937 random_;
  std::uint64_t lastRevision_ = 0, lastObject_ = 0;
};

bool sameTexels(const TexelRect& a, const TexelRect& b) {
  return (a.empty() && b.empty()) ||
         (a.lowX == b.lowX && a.lowY == b.lowY && a.highX == b.highX && a.highY == b.highY);
}

/// How one list became the other: which places changed, or that it is another list.
class Counted {
 public:
  ListChanges changes(std::span<const ItemHistory::Key> keys) {
    const bool same =
        std::ranges::equal(keys, keys_, {}, &ItemHistory::Key::object, &ItemHistory::Key::object);
    places_.clear();
    for (std::uint32_t i = 0; i < keys.size() && same; ++i) {
      if (keys[i] != keys_[i]) places_.push_back(i);
    }
    revision_ += same ? 1 : 2;
    keys_.assign(keys.begin(), keys.end());
    return {revision_, places_};
  }

 private:
  std::vector<ItemHistory::Key> keys_;
  std::vector<std::uint32_t> places_;
  std::uint64_t revision_ = 0;
};

const MapWindow kWindow{glm::perspective(1.2, 1.0, 0.5, 100.0), {64, 128, 512, 256}};

TEST(ItemHistory, FollowsListsAsTheyChange) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    RandomItems list(seed);
    ItemHistory history;
    ItemPlaces places;
    std::uint64_t generation = 1, told = 0;
    Counted counted;
    for (int frame = 0; frame < 300; ++frame) {
      const std::vector<ItemHistory::Key> before = list.keys();
      if (frame > 0) list.step();
      const std::vector<ItemHistory::Key> keys = list.keys();
      const std::uint64_t held = history.generation();
      // Now and then it is told what changed.
      const ListChanges changes = counted.changes(keys);
      history.update(list.items, frame % 2 == 0 ? std::span(keys) : std::span<const ItemHistory::Key>{},
                     generation, frame % 5 < 3 ? changes : ListChanges{});
      EXPECT_EQ(history.generation() == held, frame > 0 && before == keys) << frame;
      places.update(history, kWindow);
      ASSERT_EQ(places.texels().size(), list.items.size());
      std::uint64_t work = 0;
      for (std::size_t i = 0; i < list.items.size(); ++i) {
        EXPECT_TRUE(sameTexels(places.texels()[i], kWindow.texelsOf(history.items()[i].boundsWorld)))
            << frame;
        work += workOf(list.items[i]);
      }
      EXPECT_EQ(history.work(), work);
      if (frame == 0 || history.generationBefore() != held) continue;
      ++told;
      // What is not named is in both lists, in the same order.
      std::vector<ItemHistory::Key> unnamedBefore = before, unnamed = keys;
      for (auto change = history.changes().rbegin(); change != history.changes().rend(); ++change) {
        if (change->before != ItemHistory::kNowhere)
          unnamedBefore.erase(unnamedBefore.begin() + change->before);
        if (change->after != ItemHistory::kNowhere) unnamed.erase(unnamed.begin() + change->after);
      }
      EXPECT_TRUE(unnamedBefore == unnamed) << frame;
    }
    EXPECT_GT(told, 100u);
  }
}

TEST(ItemHistory, TexelsHoldAllThatIsProjected) {
  RandomItems list(4);
  for (const DrawItem& item : list.items) {
    const TexelRect texels = kWindow.texelsOf(item.boundsWorld);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 share(list.at(0, 1), list.at(0, 1), list.at(0, 1));
      const glm::dvec3 point = glm::mix(item.boundsWorld.low, item.boundsWorld.high, share);
      const glm::dvec4 clip = kWindow.clipFromWorld * glm::dvec4(point, 1.0);
      if (!(clip.w > 0.0)) continue;
      const glm::dvec2 place = (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(512, 256);
      if (glm::any(glm::lessThan(place, glm::dvec2(0.0))) ||
          glm::any(glm::greaterThanEqual(place, glm::dvec2(512, 256))))
        continue;
      const glm::ivec2 texel = glm::ivec2(place) + glm::ivec2(64, 128);
      EXPECT_TRUE(texel.x >= texels.lowX && texel.x < texels.highX && texel.y >= texels.lowY &&
                  texel.y < texels.highY);
    }
  }
}

/// A scene of numbers, of which a list keeps some; values are made from what an object is, and whoever
/// follows the list by what it says of its changes has them all.
TEST(KeptList, HoldsWhatItsObjectsAreAndSaysWhatChanged) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    std::vector<std::uint64_t> revisions(60, 1);
    std::uint64_t sceneRevision = 2, seen = 0, made = 0, lookedAt = 0;
    api::KeptList<std::uint64_t> list;
    std::vector<std::uint64_t> follower;
    std::vector<std::uint32_t> lastChanged;
    const auto keyOf = [&](std::uint32_t object) {
      ++lookedAt;
      return ItemHistory::Key{object, revisions[object]};
    };
    for (int frame = 0; frame < 400; ++frame) {
      std::vector<std::uint32_t> objects, changed;
      for (int i = 0; i < frame % 4; ++i) changed.push_back(random() % revisions.size());
      if (frame % 50 == 0) changed.resize(20, 7u);
      std::ranges::sort(changed);
      const auto repeated = std::ranges::unique(changed);
      changed.erase(repeated.begin(), repeated.end());
      for (const std::uint32_t object : changed) ++revisions[object];
      if (!changed.empty()) {
        ++sceneRevision;
        lastChanged = changed;
      }
      // Another selection every now and then, in any order; frames that the list does not hear of; failures.
      const std::uint32_t selection = static_cast<std::uint32_t>(frame) / 20;
      for (std::uint32_t object = 0; object < revisions.size(); ++object) {
        if ((object + selection) % 3 != 0) objects.push_back(selection % 2 == 0 ? object : 59 - object);
      }
      if (frame % 17 == 0) continue;
      const bool fails = frame % 23 == 0;
      const auto make = [&](std::uint32_t object) -> Result<std::uint64_t> {
        if (fails && object % 4 == 0) return Error{ErrorCode::outOfMemory, "no memory"};
        ++made;
        return 1000 * object + revisions[object];
      };
      lookedAt = 0;
      const bool same = list.isOf(objects);
      if (!list.follow(objects, {sceneRevision, lastChanged}, keyOf, make)) continue;
      if (same && frame % 17 != 1 && frame % 23 != 1) {
        EXPECT_LE(lookedAt, lastChanged.size());
      }
      ASSERT_EQ(list.values().size(), objects.size());
      for (std::size_t place = 0; place < objects.size(); ++place)
        EXPECT_EQ(list.values()[place], 1000 * objects[place] + revisions[objects[place]]) << frame;
      const ListChanges changes = list.changes();
      if (const auto places = changes.since(seen)) {
        for (const std::uint32_t place : places.places) follower[place] = list.values()[place];
      } else {
        follower.assign(list.values().begin(), list.values().end());
      }
      seen = changes.revision;
      EXPECT_TRUE(std::ranges::equal(follower, list.values())) << frame;
    }
    EXPECT_LT(made, 400u * 8u);
  }
}

/// Boxes under a light, of which some move: kept or found anew, the farthest reaches as far.
TEST(ReceiverReach, IsKept) {
  std::mt19937 random(7);
  const auto at = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const scene::TriangleMesh mesh{.positions = {{-0.5f, 0, -0.5f}, {0.5f, 0, -0.5f}, {0, 0, 0.5f}},
                                 .indices = {0, 1, 2}};
  std::vector<planner::PlannedObject> objects(100);
  const auto place = [&](std::size_t i) {
    planner::PlannedObject& object = objects[i];
    object = {.id = static_cast<std::uint32_t>(i + 1),
              .receives = i % 5 != 0,
              .mesh = &mesh,
              .worldFromObject = glm::translate(glm::dmat4(1.0), {at(-5, 5), at(-4, 1), at(-5, 5)})};
    object.boundsWorld = scene::transformed(object.worldFromObject, scene::boundsOf(mesh));
  };
  for (std::size_t i = 0; i < objects.size(); ++i) place(i);
  const scene::AreaLight light{.centerWorld = {0, 6, 0}, .emission = {0, -1, 0}};
  const std::vector<glm::dvec3> corners{{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 1, 2}};
  planner::LightFit fit = planner::fitLight(light, corners, {});
  api::ReceiverReach reach;
  std::uint64_t revision = 1;
  for (int frame = 0; frame < 400; ++frame) {
    std::vector<std::uint32_t> changed;
    for (int i = 0; i < frame % 3; ++i) place(changed.emplace_back(random() % objects.size()));
    // Now and then a frame is not asked about, or the window is another.
    revision += frame % 19 == 0 ? 2 : 1;
    const bool told = frame % 23 != 0;
    if (frame % 31 == 0) fit.tangentHigh.x += 0.01;
    const ListChanges changes{told ? revision : 0, changed};
    EXPECT_EQ(reach.update(fit, objects, changes), api::receiverFarDistance(fit, objects)) << frame;
  }
}

}  // namespace
}  // namespace halfshadow::techniques
