// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "graph_builder.hpp"

namespace halfshadow::framegraph {
namespace {
using namespace testing;

// A (key 1) → persistent a → B (key 2) → persistent b → draw → output.
Graph chain() {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a", Lifetime::persistent);
  const ResourceId b = colorTexture(graph, "b", Lifetime::persistent), image = colorTexture(graph, "image");
  addPass(graph, "A", PassStage::light, {}, {colorOf(a), depthOf(depthBuffer(graph, "depth"))}, 1);
  addPass(graph, "B", PassStage::mask, {a}, {colorOf(b)}, 2);
  addPass(graph, "draw", PassStage::scene, {b}, {colorOf(image)});
  graph.markOutput(image);
  return graph;
}

TEST(PlanCache, ChainInAllCombinations) {
  struct Case {
    std::uint64_t heldA, heldB;
    const char *running, *reasonA, *reasonB;
  };
  const Case cases[] = {
      {0, 0, "A B draw", "", ""},
      {1, 0, "B draw", "unchanged", ""},
      {1, 2, "draw", "unchanged", "unchanged"},
      {0, 2, "draw", "not-read", "unchanged"},  // nobody needs A's content
      {9, 2, "draw", "not-read", "unchanged"},  // nor its new content
      {9, 9, "A B draw", "", ""},
      {1, 9, "B draw", "unchanged", ""},
      {9, 0, "A B draw", "", ""},
      {kUnidentifiedContent, kUnidentifiedContent, "A B draw", "", ""},
  };
  for (const Case& expected : cases) {
    const Graph graph = chain();
    const Plan plan = compiled(graph, {{"a", expected.heldA}, {"b", expected.heldB}});
    EXPECT_EQ(running(graph, plan), expected.running) << expected.heldA << " " << expected.heldB;
    EXPECT_EQ(skipReason(plan, "A"), expected.reasonA) << expected.heldA << " " << expected.heldB;
    EXPECT_EQ(skipReason(plan, "B"), expected.reasonB) << expected.heldA << " " << expected.heldB;
  }
}

TEST(PlanCache, KeyZeroIsNeverSkipped) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a", Lifetime::persistent);
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(a)}, 0);
  graph.markOutput(a);
  EXPECT_EQ(running(graph, compiled(graph, {{"a", 0}})), "draw");
  EXPECT_EQ(running(graph, compiled(graph, {{"a", 4}})), "draw");
}

TEST(PlanCache, AllPersistentTargetsMustHoldTheContent) {
  for (const std::uint64_t heldDepth : {0u, 3u}) {
    Graph graph;
    const ResourceId a = colorTexture(graph, "a", Lifetime::persistent);
    const ResourceId depth = depthBuffer(graph, "depth", Lifetime::persistent);
    addPass(graph, "draw", PassStage::light, {}, {colorOf(a), depthOf(depth)}, 3);
    graph.markOutput(a);
    const Plan plan = compiled(graph, {{"a", 3}, {"depth", heldDepth}});
    EXPECT_EQ(running(graph, plan), heldDepth == 3 ? "" : "draw");
  }
}

TEST(PlanCache, PassWhoseTransientTargetIsReadRuns) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a", Lifetime::persistent), image = colorTexture(graph, "image");
  const ResourceId depth = depthBuffer(graph, "depth");
  addPass(graph, "make", PassStage::light, {}, {colorOf(a), depthOf(depth)}, 3);
  addPass(graph, "draw", PassStage::light, {a}, {colorOf(image), depthOf(depth, InitialContent::keep)});
  graph.markOutput(image);
  // a holds the content, but the transient depth that "draw" loads exists only when "make" runs.
  EXPECT_EQ(running(graph, compiled(graph, {{"a", 3}})), "make draw");
}

TEST(PlanCache, TransientOnlyPassIsNeverSkipped) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  addPass(graph, "draw", PassStage::light, {}, {colorOf(a)}, 3);
  graph.markOutput(a);
  EXPECT_EQ(running(graph, compiled(graph, {{"a", 3}})), "draw");
}

// One persistent resource is written twice with different keys; it holds the second content after a frame.
// Remaking the first destroys the second, which must then be remade although its key was held.
TEST(PlanCache, OverwrittenContentIsMadeAgain) {
  Graph graph;
  const ResourceId shared = colorTexture(graph, "shared", Lifetime::persistent);
  const ResourceId first = colorTexture(graph, "first"), second = colorTexture(graph, "second");
  addPass(graph, "make-1", PassStage::light, {}, {colorOf(shared)}, 1);
  addPass(graph, "read-1", PassStage::light, {shared}, {colorOf(first)});
  addPass(graph, "make-2", PassStage::light, {}, {colorOf(shared)}, 2, "one map serves two lights");
  addPass(graph, "read-2", PassStage::light, {shared}, {colorOf(second)});
  graph.markOutput(first);
  graph.markOutput(second);
  EXPECT_EQ(running(graph, compiled(graph, {{"shared", 2}})), "make-1 read-1 make-2 read-2");
  EXPECT_EQ(running(graph, compiled(graph, {{"shared", 1}})), "read-1 make-2 read-2");
}

TEST(PlanCache, CachedOutputIsSkipped) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a", Lifetime::persistent);
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(a)}, 8);
  graph.markOutput(a);
  const Plan plan = compiled(graph, {{"a", 8}});
  EXPECT_TRUE(plan.passes.empty());
  EXPECT_EQ(skipReason(plan, "draw"), "unchanged");
  EXPECT_EQ(plan.bytesStored, 0u);
}

TEST(PlanCache, UnreadPassIsNotReadEvenWhenItsContentIsHeld) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a", Lifetime::persistent);
  addPass(graph, "draw", PassStage::light, {}, {colorOf(a)}, 8);
  EXPECT_EQ(skipReason(compiled(graph, {{"a", 8}}), "draw"), "not-read");
}

TEST(PlanCache, LookupSeesTheWholeDescription) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a", Lifetime::persistent);
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(a)}, 8);
  graph.markOutput(a);
  const auto heldAtOtherSize = [](const ResourceDesc& desc) {
    return std::uint64_t{desc.width == 128 ? 8u : 0u};
  };
  const Result<Plan> plan = compile(graph, heldAtOtherSize);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->passes.size(), 1u);
}

}  // namespace
}  // namespace halfshadow::framegraph
