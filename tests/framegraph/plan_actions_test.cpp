// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "graph_builder.hpp"

namespace halfshadow::framegraph {
namespace {
using namespace testing;

constexpr std::uint64_t kPixels = 64 * 32;  // of the builder's resources

TEST(PlanActions, BytesOfEveryFormat) {
  EXPECT_EQ(bytesPerPixel(Format::rgba8), 4u);
  EXPECT_EQ(bytesPerPixel(Format::depth16), 2u);
  EXPECT_EQ(bytesPerPixel(Format::depth24), 4u);
  EXPECT_EQ(bytesPerPixel(Format::stencil8), 1u);
  EXPECT_EQ(bytesPerPixel(Format::depth24Stencil8), 4u);
}

TEST(PlanActions, DepthThatNobodyReadsIsDiscarded) {
  Graph graph;
  const ResourceId color = colorTexture(graph, "color"), depth = depthBuffer(graph, "depth");
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(color), depthOf(depth)});
  graph.markOutput(color);
  const Plan plan = compiled(graph);
  ASSERT_EQ(plan.passes.size(), 1u);
  const auto& attachments = plan.passes[0].attachments;
  EXPECT_EQ(attachments[0].load, LoadAction::clear);
  EXPECT_EQ(attachments[0].store, StoreAction::store);
  EXPECT_EQ(attachments[0].bytesStored, kPixels * 4);
  EXPECT_EQ(attachments[1].store, StoreAction::discard);
  EXPECT_EQ(attachments[1].bytesStored, 0u);
  EXPECT_EQ(plan.bytesLoaded, 0u);
  EXPECT_EQ(plan.bytesStored, kPixels * 4);
}

TEST(PlanActions, KeepIsALoadAndMakesTheEarlierPassStore) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b"),
                   depth = depthBuffer(graph, "depth");
  addPass(graph, "one", PassStage::scene, {}, {colorOf(a), depthOf(depth)});
  addPass(graph, "two", PassStage::scene, {a},
          {colorOf(b, InitialContent::dontCare), depthOf(depth, InitialContent::keep)});
  graph.markOutput(b);
  const Plan plan = compiled(graph);
  ASSERT_EQ(plan.passes.size(), 2u);
  EXPECT_EQ(plan.passes[0].attachments[0].store, StoreAction::store);  // read as a texture
  EXPECT_EQ(plan.passes[0].attachments[1].store, StoreAction::store);  // loaded
  EXPECT_EQ(plan.passes[1].attachments[0].load, LoadAction::dontCare);
  EXPECT_EQ(plan.passes[1].attachments[0].bytesLoaded, 0u);
  EXPECT_EQ(plan.passes[1].attachments[1].load, LoadAction::load);
  EXPECT_EQ(plan.passes[1].attachments[1].bytesLoaded, kPixels * 2);
  EXPECT_EQ(plan.passes[1].attachments[1].store, StoreAction::discard);
  EXPECT_EQ(plan.bytesLoaded, kPixels * 2);
  EXPECT_EQ(plan.bytesStored, kPixels * (4 + 2 + 4));
}

TEST(PlanActions, DepthClearedByTheNextPassIsNotStored) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b"),
                   depth = depthBuffer(graph, "depth");
  addPass(graph, "one", PassStage::light, {}, {colorOf(a), depthOf(depth)});
  addPass(graph, "two", PassStage::light, {a}, {colorOf(b), depthOf(depth)});
  graph.markOutput(b);
  const Plan plan = compiled(graph);
  ASSERT_EQ(plan.passes.size(), 2u);
  EXPECT_EQ(plan.passes[0].attachments[1].store, StoreAction::discard);
}

TEST(PlanActions, PersistentAndOutputAreStored) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  const ResourceId depth = depthBuffer(graph, "depth", Lifetime::persistent);
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(a), depthOf(depth)});
  graph.markOutput(a);
  const Plan plan = compiled(graph);
  ASSERT_EQ(plan.passes.size(), 1u);
  EXPECT_EQ(plan.passes[0].attachments[0].store, StoreAction::store);
  EXPECT_EQ(plan.passes[0].attachments[1].store, StoreAction::store);
}

TEST(PlanActions, OnlyTheLastVersionOfAnOutputIsStored) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b");
  addPass(graph, "one", PassStage::light, {}, {colorOf(a)});
  addPass(graph, "copy", PassStage::light, {a}, {colorOf(b)});
  addPass(graph, "two", PassStage::light, {b}, {colorOf(a)}, 0, "reuse");
  graph.markOutput(a);
  const Plan plan = compiled(graph);
  ASSERT_EQ(plan.passes.size(), 3u);
  EXPECT_EQ(plan.passes[0].attachments[0].store, StoreAction::store);  // "copy" reads it
  EXPECT_EQ(plan.passes[2].attachments[0].store, StoreAction::store);
  EXPECT_EQ(plan.bytesStored, kPixels * 4 * 3);
}

TEST(PlanActions, HostTargetLoadsAndStoresByPoint) {
  Graph graph;
  const ResourceId host = graph.importTarget("host", {.width = 64, .height = 32});
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(host, InitialContent::keep), depthOf(host)});
  const Plan plan = compiled(graph);
  ASSERT_EQ(plan.passes.size(), 1u);
  EXPECT_EQ(plan.bytesLoaded, kPixels * 4);
  EXPECT_EQ(plan.bytesStored, kPixels * 8);
}

TEST(PlanActions, PackedDepthStencilCountsOnce) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  const ResourceId packed = graph.addResource({.name = "packed",
                                               .width = 64,
                                               .height = 32,
                                               .format = Format::depth24Stencil8,
                                               .storage = Storage::renderbuffer});
  addPass(graph, "one", PassStage::scene, {},
          {colorOf(a), {.resource = packed, .point = AttachmentPoint::depthStencil}});
  const ResourceId b = colorTexture(graph, "b");
  addPass(graph, "two", PassStage::scene, {a},
          {colorOf(b),
           {.resource = packed, .point = AttachmentPoint::depthStencil, .initial = InitialContent::keep}});
  graph.markOutput(b);
  EXPECT_EQ(compiled(graph).bytesLoaded, kPixels * 4);
}

TEST(PlanActions, MipmapsFollowTheWriter) {
  Graph graph;
  const ResourceId a = graph.addResource({.name = "a", .width = 64, .height = 64, .mipmapped = true});
  addPass(graph, "draw", PassStage::light, {}, {colorOf(a)});
  graph.markOutput(a);
  const Plan plan = compiled(graph);
  ASSERT_EQ(plan.passes.size(), 1u);
  EXPECT_TRUE(plan.passes[0].generatesMipmaps);
}

Graph smallFrame() {
  Graph graph;
  const ResourceId map = colorTexture(graph, "map", Lifetime::persistent),
                   depth = depthBuffer(graph, "depth");
  const ResourceId host = graph.importTarget("host", {.width = 64, .height = 32});
  addPass(graph, "shadow-map", PassStage::light, {}, {colorOf(map), depthOf(depth)}, 5);
  addPass(graph, "draw", PassStage::scene, {map}, {colorOf(host, InitialContent::keep)});
  graph.noteSkipped("caster 1", "behind-light");
  return graph;
}

TEST(PlanText, IsADeterministicTable) {
  const Graph graph = smallFrame();
  const std::string text = compiled(graph).text(graph);
  // The whole table: the format is what people read and diff.
  EXPECT_EQ(text,
            "pass        stage  target               load->store     bytes in/out  reads\n"
            "shadow-map  light  map 64x32 rgba8      clear->store    0/8192        -\n"
            "                   depth 64x32 depth16  clear->discard  0/0\n"
            "draw        scene  host 64x32 host      load->store     8192/8192     map\n"
            "total: 2 passes, 8192 bytes loaded, 16384 bytes stored\n"
            "skipped caster 1: behind-light\n");
  EXPECT_EQ(text, compiled(graph).text(graph));
}

TEST(PlanText, GraphvizDrawsBoxesAndEllipses) {
  const Graph graph = smallFrame();
  const std::string dot = compiled(graph).graphviz(graph);
  for (const char* part : {"digraph frame {", "p0 [shape=box, label=\"shadow-map (light)\"]",
                           "r0 [shape=ellipse, label=\"map 64x32 rgba8\"]", "r0 -> p1;",
                           "p0 -> r1 [label=\"discard\"]", "r2 -> p1 [style=dashed, label=\"load\"]"}) {
    EXPECT_NE(dot.find(part), std::string::npos) << part << "\n" << dot;
  }
  EXPECT_EQ(dot, compiled(graph).graphviz(graph));
}

}  // namespace
}  // namespace halfshadow::framegraph
