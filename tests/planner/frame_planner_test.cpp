// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/frame_planner.hpp"
#include "base/keys.hpp"

#include <gtest/gtest.h>

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
    if (skip.what == what && skip.reason == reason) return true;
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
