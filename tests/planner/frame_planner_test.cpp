// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/frame_planner.hpp"
#include "base/keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace halfshadow::planner {
namespace {

scene::Bounds box(const glm::dvec3& center, double half) {
  return {.low = center - glm::dvec3(half), .high = center + glm::dvec3(half)};
}

using Indices = std::vector<std::uint32_t>;

// Two casters over two ground tiles 40 units apart, one light between them, high up.
struct World {
  std::vector<PlannedObject> objects{
      {.id = 10, .boundsWorld = {{-25, -1, -5}, {-15, 0, 5}}, .revision = 1, .casts = false},
      {.id = 11, .boundsWorld = {{15, -1, -5}, {25, 0, 5}}, .revision = 1, .casts = false},
      {.id = 12, .boundsWorld = box({-18, 2, 0}, 1), .revision = 1, .receives = false},
      {.id = 13, .boundsWorld = box({18, 2, 0}, 1), .revision = 1, .receives = false},
  };
  std::vector<scene::AreaLight> lights{
      {.centerWorld = {0, 30, 0}, .halfU = {1, 0, 0}, .halfV = {0, 0, 1}, .emission = {0, -1, 0}}};
  std::vector<std::uint64_t> lightRevisions{1};
  scene::Camera camera;

  void lookAt(double x) {
    camera.eyeWorld = {x, 6, 14};
    camera.targetWorld = {x, 0, 0};
  }
  void lookAtAll() {
    camera.eyeWorld = {0, 30, 90};
    camera.targetWorld = {0, 0, 0};
  }
  FramePlan plan(FramePlanner& planner) const {
    return planner.plan(
        {.objects = objects, .camera = &camera, .lights = lights, .lightRevisions = lightRevisions});
  }
};

bool hasSkip(const FramePlan& plan, const std::string& what, SkipReason reason) {
  for (const Skip& skip : plan.skips) {
    if (skipName(skip) == what && skip.reason == reason) return true;
  }
  return false;
}

TEST(FramePlanner, ReceiversAreDrawnFrontToBack) {
  World world;
  for (PlannedObject& object : world.objects) object.receives = true;
  // The same box once more: coincident surfaces keep the order of their objects.
  world.objects.push_back(world.objects[2]);
  world.objects.back().id = 14;
  world.camera.eyeWorld = {-90, 20, 0};
  world.camera.targetWorld = {0, 0, 0};
  FramePlanner planner;
  EXPECT_EQ(world.plan(planner).receivers, (Indices{0, 2, 4, 1, 3}));
  world.camera.eyeWorld = {90, 20, 0};
  EXPECT_EQ(world.plan(planner).receivers, (Indices{1, 3, 0, 2, 4}));
}

TEST(FramePlanner, CameraOnlyMoveChangesNoKey) {
  World world;
  FramePlanner planner;
  world.lookAt(-20);
  const FramePlan first = world.plan(planner);
  EXPECT_EQ(first.lights[0].casters, (Indices{2, 3}));  // both: the right one is out of view, yet static
  EXPECT_EQ(first.receivers, (Indices{0}));
  EXPECT_TRUE(hasSkip(first, "receiver 11", SkipReason::receiverOutOfView));
  EXPECT_FALSE(hasSkip(first, "light 0", SkipReason::unchanged));
  for (const double x : {-19.0, 0.0, 20.0, 500.0}) {
    world.lookAt(x);
    const FramePlan next = world.plan(planner);
    EXPECT_EQ(next.lights[0].contentKey, first.lights[0].contentKey);
    EXPECT_TRUE(hasSkip(next, "light 0", SkipReason::unchanged));
  }
}

TEST(FramePlanner, KeyChangesWithWhatTheViewHolds) {
  World world;
  world.lookAtAll();
  std::set<std::uint64_t> keys;
  const auto key = [&] {
    FramePlanner planner;  // fresh: keys depend on the input alone
    const std::uint64_t value = world.plan(planner).lights[0].contentKey;
    EXPECT_NE(value, 0u);
    return value;
  };
  const std::uint64_t original = key();
  EXPECT_EQ(key(), original);
  keys.insert(original);
  world.lightRevisions[0] = 2;
  EXPECT_TRUE(keys.insert(key()).second);
  world.objects[2].revision = 2;
  EXPECT_TRUE(keys.insert(key()).second);
  std::swap(world.objects[2].revision, world.objects[3].revision);
  EXPECT_TRUE(keys.insert(key()).second);
  world.objects.pop_back();
  EXPECT_TRUE(keys.insert(key()).second);
}

TEST(FramePlanner, ReceiverChangesDoNotRemakeTheView) {
  World world;
  world.lookAtAll();
  FramePlanner planner;
  const std::uint64_t before = world.plan(planner).lights[0].contentKey;
  world.objects[0].revision = 5;
  world.objects[0].boundsWorld.low.x -= 1.0;
  EXPECT_EQ(world.plan(planner).lights[0].contentKey, before);
}

TEST(FramePlanner, CullsWithReasons) {
  World world;
  world.lookAtAll();
  world.objects.push_back({.id = 20, .boundsWorld = box({0, 40, 0}, 1), .revision = 1, .receives = false});
  world.objects.push_back({.id = 21, .boundsWorld = box({0, 5, 0}, 1), .revision = 1, .receives = false});
  world.objects.push_back({.id = 22, .revision = 1});  // no extent: neither caster nor receiver
  FramePlanner planner;
  const FramePlan plan = world.plan(planner);
  EXPECT_EQ(plan.lights[0].casters, (Indices{2, 3}));
  EXPECT_TRUE(hasSkip(plan, "caster 20", SkipReason::behindLight));
  EXPECT_TRUE(hasSkip(plan, "caster 21", SkipReason::noReceiverBehind));
  EXPECT_EQ(plan.receivers, (Indices{0, 1}));
}

TEST(FramePlanner, SelfShadowingObjectsStay) {
  World world;
  world.lookAtAll();
  world.objects.push_back({.id = 21, .boundsWorld = box({0, 5, 0}, 1), .revision = 1});
  FramePlanner planner;
  EXPECT_EQ(world.plan(planner).lights[0].casters, (Indices{2, 3, 4}));
}

TEST(FramePlanner, LightWithoutCastersOrIntensityIsInactive) {
  World world;
  world.lookAtAll();
  world.lights[0].intensity = 0.0;
  FramePlanner planner;
  const FramePlan off = world.plan(planner);
  EXPECT_FALSE(off.lights[0].active);
  EXPECT_NE(off.lights[0].contentKey, 0u);
  EXPECT_TRUE(hasSkip(off, "light 0", SkipReason::lightOff));
  world.lights[0].intensity = 1.0;
  world.objects.resize(2);
  const FramePlan bare = world.plan(planner);
  EXPECT_FALSE(bare.lights[0].active);
  EXPECT_TRUE(hasSkip(bare, "light 0", SkipReason::noCasters));
}

TEST(FramePlanner, MovingCastersOutOfViewAreDroppedUntilTheMovementEnds) {
  World world;
  world.lookAt(-20);
  FramePlanner planner;
  const auto move = [&] { world.objects[2].revision++; };
  EXPECT_EQ(world.plan(planner).lights[0].casters, (Indices{2, 3}));
  move();
  EXPECT_EQ(world.plan(planner).lights[0].casters, (Indices{2, 3}));  // first change: still complete
  move();
  const FramePlan dynamic = world.plan(planner);
  EXPECT_EQ(dynamic.lights[0].casters, (Indices{2}));
  EXPECT_TRUE(hasSkip(dynamic, "caster 13", SkipReason::shadowOutOfView));
  move();
  const FramePlan last = world.plan(planner);
  EXPECT_EQ(last.lights[0].casters, (Indices{2}));

  // At rest the reduced view serves as long as the camera needs nothing more.
  const FramePlan rest = world.plan(planner);
  EXPECT_EQ(rest.lights[0].contentKey, last.lights[0].contentKey);
  EXPECT_TRUE(hasSkip(rest, "light 0", SkipReason::unchanged));
  EXPECT_TRUE(hasSkip(rest, "caster 13", SkipReason::shadowOutOfView));

  // The camera turns to the dropped caster's shadow: one remake, with everything, then no more.
  world.lookAt(20);
  const FramePlan turned = world.plan(planner);
  EXPECT_EQ(turned.lights[0].casters, (Indices{2, 3}));
  EXPECT_NE(turned.lights[0].contentKey, rest.lights[0].contentKey);
  world.lookAt(-20);
  EXPECT_EQ(world.plan(planner).lights[0].contentKey, turned.lights[0].contentKey);
  world.lookAtAll();
  EXPECT_EQ(world.plan(planner).lights[0].contentKey, turned.lights[0].contentKey);
}

TEST(FramePlanner, MovingLightDropsToo) {
  World world;
  world.lookAt(20);
  FramePlanner planner;
  (void)world.plan(planner);
  for (int frame = 0; frame < 2; ++frame) {
    world.lightRevisions[0]++;
    world.lights[0].centerWorld.x += 0.1;
    const FramePlan plan = world.plan(planner);
    EXPECT_EQ(plan.lights[0].casters, frame == 0 ? (Indices{2, 3}) : (Indices{3}));
  }
}

TEST(FramePlanner, SeveralLightsAreNamed) {
  World world;
  world.lookAtAll();
  world.lights.push_back(world.lights[0]);
  world.lights[1].centerWorld.y = -5.0;
  world.lightRevisions.push_back(1);
  FramePlanner planner;
  const FramePlan plan = world.plan(planner);
  ASSERT_EQ(plan.lights.size(), 2u);
  EXPECT_TRUE(plan.lights[0].active);
  EXPECT_FALSE(plan.lights[1].active);
  EXPECT_TRUE(hasSkip(plan, "caster 12 for light 1", SkipReason::behindLight));
}

/// A square of boxes over a ground, all receivers and casters.
struct Field {
  std::vector<PlannedObject> objects;
  scene::AreaLight light{
      .centerWorld = {0, 60, 0}, .halfU = {1, 0, 0}, .halfV = {0, 0, 1}, .emission = {0, -1, 0}};
  std::uint64_t lightRevision = 1, lastRevision = 1;
  scene::Camera camera{.eyeWorld = {5, 30, 40}, .targetWorld = {0, 0, 0}};

  explicit Field(int side) {
    const double far = 2.0 * side;
    add({{-far, -2, -far}, {far, -1, far}});
    for (int x = 0; x < side; ++x) {
      for (int z = 0; z < side; ++z) add(box({x * 1.5, 0, z * 1.5}, 0.4));
    }
  }
  void add(const scene::Bounds& bounds) {
    const auto id = static_cast<std::uint32_t>(objects.size() + 1);
    objects.push_back({.id = id, .boundsWorld = bounds, .revision = ++lastRevision});
  }
  void move(std::size_t object, const glm::dvec3& by) {
    objects[object].boundsWorld.low += by, objects[object].boundsWorld.high += by;
    objects[object].revision = ++lastRevision;
  }
  FramePlan plan(FramePlanner& planner,
                 std::optional<std::span<const std::uint32_t>> changed = std::nullopt) const {
    return planner.plan({.objects = objects,
                         .changed = changed,
                         .camera = &camera,
                         .lights = {&light, 1},
                         .lightRevisions = {&lightRevision, 1}});
  }
};

TEST(FramePlanner, AMoverIsAskedAboutAlone) {
  Field field(20);
  FramePlanner planner;
  const auto asked = [&] {
    const std::uint64_t before = planner.pairsAsked();
    field.move(150, {0.05, 0, 0.02});
    field.plan(planner);
    return planner.pairsAsked() - before;
  };
  EXPECT_GE(asked(), field.objects.size());
  EXPECT_LE(asked(), 10u);
  // In the third frame in which something moved, all are asked about the receivers in view.
  EXPECT_GE(asked(), field.objects.size());
  for (int frame = 0; frame < 5; ++frame) EXPECT_LE(asked(), 10u);
  const std::uint64_t before = planner.pairsAsked();
  field.camera.eyeWorld.x += 0.1;
  field.plan(planner);
  EXPECT_EQ(planner.pairsAsked(), before);
}

// What is kept between frames never changes an answer.
TEST(FramePlanner, KeptAnswersAreThoseOfAFreshPlanner) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  Field field(5);
  FramePlanner kept;
  for (int frame = 0; frame < 300; ++frame) {
    const auto object = static_cast<std::size_t>(random() % field.objects.size());
    const double far = frame % 7 == 0 ? 30.0 : 1.0;
    if (frame % 3 != 0) field.move(object, far * glm::dvec3(unit(random), unit(random), unit(random)));
    if (frame % 11 == 0) field.camera.eyeWorld += 4.0 * glm::dvec3(unit(random), 0.0, unit(random));
    if (frame % 29 == 0) {
      field.light.centerWorld.x += unit(random);
      ++field.lightRevision;
    }
    if (frame % 37 == 0) field.objects.erase(field.objects.begin() + static_cast<std::ptrdiff_t>(object));
    FramePlanner fresh;
    const FramePlan expected = field.plan(fresh), plan = field.plan(kept);
    EXPECT_EQ(plan.receivers, expected.receivers) << frame;
    EXPECT_EQ(plan.sceneRevision, expected.sceneRevision) << frame;
    if (plan.lights[0].casters == expected.lights[0].casters) {
      EXPECT_EQ(plan.lights[0].contentKey, expected.lights[0].contentKey) << frame;
    }
    // A moving scene may drop casters whose shadows no one sees, and never draws one that shadows nothing
    // unless it did before.
    for (const Skip& skip : expected.skips) {
      if (skip.subject != Skip::Subject::caster) continue;
      EXPECT_TRUE(hasSkip(plan, skipName(skip), skip.reason) ||
                  hasSkip(plan, skipName(skip), SkipReason::nothingBeyond))
          << frame << " " << skipName(skip);
    }
    for (const std::uint32_t caster : expected.lights[0].casters) {
      const bool drawn = std::ranges::binary_search(plan.lights[0].casters, caster);
      const Skip dropped{.subject = Skip::Subject::caster, .id = field.objects[caster].id};
      EXPECT_TRUE(drawn || hasSkip(plan, skipName(dropped), SkipReason::shadowOutOfView)) << frame;
    }
  }
}

// Who is told what changed plans as who looks at everything, whether or not more is named than did.
TEST(FramePlanner, WhatItIsToldChangesNoPlan) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  Field field(6);
  FramePlanner told, looking;
  for (int frame = 0; frame < 200; ++frame) {
    Indices changed;
    const bool listed = frame == 0 || frame % 41 == 0;
    if (frame > 0 && listed) field.objects.erase(field.objects.begin() + frame % 7);
    for (int i = 0; i < frame % 4; ++i) {
      const auto object = static_cast<std::uint32_t>(random() % field.objects.size());
      if (i < 2) field.move(object, glm::dvec3(unit(random), unit(random), unit(random)));
      changed.push_back(object);
    }
    if (frame % 13 == 0) field.camera.eyeWorld += 4.0 * glm::dvec3(unit(random), 0.0, unit(random));
    const FramePlan a =
        listed ? field.plan(told) : field.plan(told, std::optional<std::span<const std::uint32_t>>(changed));
    const FramePlan b = field.plan(looking);
    EXPECT_EQ(a.receivers, b.receivers) << frame;
    EXPECT_EQ(a.sceneRevision, b.sceneRevision) << frame;
    EXPECT_EQ(a.lights[0].casters, b.lights[0].casters) << frame;
    EXPECT_EQ(a.lights[0].contentKey, b.lights[0].contentKey) << frame;
    EXPECT_EQ(a.skips.size(), b.skips.size()) << frame;
  }
  EXPECT_EQ(told.pairsAsked(), looking.pairsAsked());
}

TEST(FramePlanner, ALightKeepsItsViewWhenOthersGo) {
  World world;
  world.lookAtAll();
  world.lights.push_back(world.lights[0]);
  world.lights[1].centerWorld.x = 4.0;
  world.lightRevisions = {1, 2};
  FramePlanner planner;
  const FramePlan both = world.plan(planner);
  world.lights.erase(world.lights.begin());
  world.lightRevisions.erase(world.lightRevisions.begin());
  const std::uint32_t number = 1;
  const FramePlan one = planner.plan({.objects = world.objects,
                                      .camera = &world.camera,
                                      .lights = world.lights,
                                      .lightRevisions = world.lightRevisions,
                                      .lightNumbers = {&number, 1}});
  EXPECT_EQ(one.lights[0].contentKey, both.lights[1].contentKey);
  EXPECT_TRUE(hasSkip(one, "light 1", SkipReason::unchanged));
}

TEST(FramePlanner, SkipCodesAreDistinct) {
  std::set<std::string_view> codes;
  int count = 0;
#define HALFSHADOW_SKIP_CHECK(name, code, text) \
  EXPECT_EQ(skipCode(SkipReason::name), code);  \
  EXPECT_EQ(skipText(SkipReason::name), text);  \
  codes.insert(code);                           \
  ++count;
  HALFSHADOW_SKIP_LIST(HALFSHADOW_SKIP_CHECK)
#undef HALFSHADOW_SKIP_CHECK
  EXPECT_EQ(codes.size(), static_cast<std::size_t>(count));
}

TEST(FramePlanner, CombinedKeysDependOnOrder) {
  EXPECT_NE(combineKeys(combineKeys(1, 2), 3), combineKeys(combineKeys(1, 3), 2));
  EXPECT_NE(combineKeys(1, 2), combineKeys(2, 1));
}

}  // namespace
}  // namespace halfshadow::planner
