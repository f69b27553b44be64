// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Passes that draw again only what differs from what their targets hold.
#include "graph_builder.hpp"

namespace halfshadow::framegraph {
namespace {
using namespace testing;

constexpr std::uint64_t kBefore = 4, kNow = 5;

/// A map with a depth buffer, read by the picture.
Graph mapGraph(std::uint64_t fromKey, std::vector<Rect> parts = {{3, 2, 10, 8}},
               Lifetime lifetime = Lifetime::persistent, InitialContent initial = InitialContent::clear,
               std::uint64_t contentKey = kNow) {
  Graph graph;
  const ResourceId map = colorTexture(graph, "map", lifetime), image = colorTexture(graph, "image");
  graph.addPass({.name = "casters",
                 .stage = PassStage::light,
                 .writes = {colorOf(map, initial), depthOf(depthBuffer(graph, "depth"))},
                 .contentKey = contentKey,
                 .update = {.fromKey = fromKey, .parts = std::move(parts)}});
  addPass(graph, "draw", PassStage::scene, {map}, {colorOf(image)});
  graph.markOutput(image);
  return graph;
}

TEST(PlanUpdates, LoadWhatIsKeptAndClearTheRest) {
  const Graph graph = mapGraph(kBefore);
  const Plan plan = compiled(graph, {{"map", kBefore}});
  ASSERT_EQ(running(graph, plan), "casters draw");
  EXPECT_TRUE(plan.passes[0].updates);
  EXPECT_EQ(plan.passes[0].attachments[0].load, LoadAction::load);
  EXPECT_EQ(plan.passes[0].attachments[0].bytesLoaded, 64u * 32u * 4u);
  EXPECT_EQ(plan.passes[0].attachments[1].load, LoadAction::clear);
  EXPECT_EQ(plan.passes[0].attachments[1].store, StoreAction::discard);
  EXPECT_FALSE(plan.passes[1].updates);
}

TEST(PlanUpdates, NeedExactlyTheContentThatTheyStartFrom) {
  for (const std::uint64_t held : {std::uint64_t{0}, std::uint64_t{3}, kUnidentifiedContent}) {
    const Plan plan = compiled(mapGraph(kBefore), {{"map", held}});
    EXPECT_FALSE(plan.passes[0].updates) << held;
    EXPECT_EQ(plan.passes[0].attachments[0].load, LoadAction::clear);
    EXPECT_EQ(plan.bytesLoaded, 0u);
  }
  EXPECT_FALSE(compiled(mapGraph(kUnidentifiedContent), {{"map", kUnidentifiedContent}}).passes[0].updates);
  EXPECT_FALSE(compiled(mapGraph(0), {{"map", 0}}).passes[0].updates);
}

TEST(PlanUpdates, AreNotDoneWhereTheContentIsThere) {
  const Graph graph = mapGraph(kBefore);
  EXPECT_EQ(running(graph, compiled(graph, {{"map", kNow}})), "draw");
}

TEST(PlanUpdates, AreNotDoneOverWhatAPassOfTheFrameDrew) {
  Graph graph;
  const ResourceId map = colorTexture(graph, "map", Lifetime::persistent),
                   image = colorTexture(graph, "image");
  addPass(graph, "other", PassStage::light, {}, {colorOf(map)});
  addPass(graph, "first", PassStage::light, {map}, {colorOf(image)});
  graph.addPass({.name = "casters",
                 .stage = PassStage::mask,
                 .writes = {colorOf(map)},
                 .contentKey = kNow,
                 .update = {.fromKey = kBefore, .parts = {{0, 0, 4, 4}}},
                 .rebindReason = "another image in the same texture"});
  graph.markOutput(image);
  graph.markOutput(map);
  const Plan plan = compiled(graph, {{"map", kBefore}});
  ASSERT_EQ(running(graph, plan), "other first casters");
  EXPECT_FALSE(plan.passes[2].updates);
}

TEST(PlanUpdates, AreRefusedWhereTheyMeanNothing) {
  EXPECT_NE(failure(mapGraph(kBefore, {{60, 0, 10, 4}})), "") << "outside of the target";
  EXPECT_NE(failure(mapGraph(kBefore, {{0, 0, 0, 4}})), "") << "empty";
  EXPECT_NE(failure(mapGraph(kBefore, {}, Lifetime::transient)), "") << "nothing is kept";
  EXPECT_NE(failure(mapGraph(kBefore, {}, Lifetime::persistent, InitialContent::dontCare)), "")
      << "the pass clears nothing";
  EXPECT_NE(failure(mapGraph(kBefore, {}, Lifetime::persistent, InitialContent::clear, 0)), "")
      << "its content has no name";
}

}  // namespace
}  // namespace halfshadow::framegraph
