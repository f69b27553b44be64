// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "graph_builder.hpp"

namespace halfshadow::framegraph {
namespace {
using namespace testing;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(PlanOrder, StagesRunInTheirOrderWhateverTheDeclarationOrder) {
  Graph graph;
  const ResourceId map = colorTexture(graph, "map"), mask = colorTexture(graph, "mask");
  const ResourceId position = colorTexture(graph, "position"), visibility = colorTexture(graph, "visibility");
  const ResourceId image = colorTexture(graph, "image");
  addPass(graph, "resolve", PassStage::resolve, {visibility}, {colorOf(image)});
  addPass(graph, "scene", PassStage::scene, {mask, position}, {colorOf(visibility)});
  addPass(graph, "prepass", PassStage::receiverPrepass, {}, {colorOf(position)});
  addPass(graph, "mask", PassStage::mask, {map}, {colorOf(mask)});
  addPass(graph, "light", PassStage::light, {}, {colorOf(map)});
  graph.markOutput(image);
  // All declared after their readers: stage order decides, so no reader sees a later stage's result.
  EXPECT_EQ(running(graph, compiled(graph)), "light mask prepass scene resolve");
}

TEST(PlanOrder, DataDependencyComesBeforeDeclarationWithinAStage) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b"), c = colorTexture(graph, "c");
  addPass(graph, "third", PassStage::light, {b}, {colorOf(c)});
  addPass(graph, "second", PassStage::light, {a}, {colorOf(b)});
  addPass(graph, "first", PassStage::light, {}, {colorOf(a)});
  graph.markOutput(c);
  EXPECT_EQ(running(graph, compiled(graph)), "first second third");
}

TEST(PlanOrder, IndependentPassesKeepDeclarationOrder) {
  Graph graph;
  for (const char* name : {"z", "m", "a"}) {
    const ResourceId target = colorTexture(graph, std::string("target-") + name);
    addPass(graph, name, PassStage::light, {}, {colorOf(target)});
    graph.markOutput(target);
  }
  EXPECT_EQ(running(graph, compiled(graph)), "z m a");
}

TEST(PlanOrder, ReaderSeesTheVersionBeforeItAndTheNextWriterWaits) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b"), c = colorTexture(graph, "c");
  addPass(graph, "make-a", PassStage::light, {}, {colorOf(a)});
  addPass(graph, "a-to-b", PassStage::light, {a}, {colorOf(b)});
  addPass(graph, "b-to-a", PassStage::light, {b}, {colorOf(a)}, 0, "ping-pong");
  addPass(graph, "a-to-c", PassStage::light, {a}, {colorOf(c)});
  graph.markOutput(c);
  const Plan plan = compiled(graph);
  EXPECT_EQ(running(graph, plan), "make-a a-to-b b-to-a a-to-c");
  EXPECT_EQ(plan.passes[2].rebindReason, "ping-pong");
}

TEST(PlanOrder, DeadPassesAreDroppedWithTheirFeeders) {
  Graph graph;
  const ResourceId unused = colorTexture(graph, "unused"), feeder = colorTexture(graph, "feeder");
  const ResourceId image = colorTexture(graph, "image");
  addPass(graph, "feed", PassStage::light, {}, {colorOf(feeder)});
  addPass(graph, "dead", PassStage::mask, {feeder}, {colorOf(unused)});
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(image)});
  graph.markOutput(image);
  graph.noteSkipped("caster 3", "behind-light");
  const Plan plan = compiled(graph);
  EXPECT_EQ(running(graph, plan), "draw");
  ASSERT_EQ(plan.skipped.size(), 3u);
  EXPECT_EQ(plan.skipped[0].what, "caster 3");  // the graph's own notes come first
  EXPECT_EQ(skipReason(plan, "feed"), "not-read");
  EXPECT_EQ(skipReason(plan, "dead"), "not-read");
}

TEST(PlanOrder, WithoutOutputNothingRuns) {
  Graph graph;
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(colorTexture(graph, "image"))});
  EXPECT_TRUE(compiled(graph).passes.empty());
}

TEST(PlanOrder, ImportedTargetIsAnOutput) {
  Graph graph;
  const ResourceId host = graph.importTarget("host", {.framebufferName = 7, .width = 64, .height = 32});
  addPass(graph, "draw", PassStage::scene, {}, {colorOf(host, InitialContent::keep)});
  EXPECT_EQ(graph.importedIndex(host), 0u);
  EXPECT_EQ(graph.importedTargets()[0].framebufferName, 7u);
  EXPECT_EQ(running(graph, compiled(graph)), "draw");
}

TEST(PlanMisuse, CycleNamesThePasses) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b");
  addPass(graph, "one", PassStage::light, {b}, {colorOf(a)});
  addPass(graph, "two", PassStage::light, {a}, {colorOf(b)});
  graph.markOutput(b);
  const std::string message = failure(graph);
  EXPECT_TRUE(contains(message, "'one'") && contains(message, "'two'") && contains(message, "cycle"))
      << message;
}

TEST(PlanMisuse, ReadOfSomethingThatNobodyWrites) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b");
  addPass(graph, "draw", PassStage::light, {a}, {colorOf(b)});
  graph.markOutput(b);
  EXPECT_TRUE(contains(failure(graph), "'a'"));
}

TEST(PlanMisuse, KeepOfATransientThatNobodyWrote) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  addPass(graph, "draw", PassStage::light, {}, {colorOf(a, InitialContent::keep)});
  graph.markOutput(a);
  EXPECT_TRUE(contains(failure(graph), "'a'"));
}

TEST(PlanMisuse, CarriedContentMustBeValid) {
  Graph graph;
  const ResourceId history = colorTexture(graph, "history", Lifetime::persistent);
  const ResourceId image = colorTexture(graph, "image");
  addPass(graph, "blend", PassStage::scene, {history}, {colorOf(image)});
  graph.markOutput(image);
  EXPECT_TRUE(contains(failure(graph), "'history'"));
  EXPECT_EQ(running(graph, compiled(graph, {{"history", kUnidentifiedContent}})), "blend");
}

TEST(PlanMisuse, ReadAndWriteOfOneResourceInOnePass) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  addPass(graph, "feedback", PassStage::light, {a}, {colorOf(a)});
  EXPECT_TRUE(contains(failure(graph), "also writes"));
}

TEST(PlanMisuse, EarlierStageReadsWhatALaterStageWrites) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b");
  addPass(graph, "mask", PassStage::mask, {a}, {colorOf(b)});
  addPass(graph, "scene", PassStage::scene, {}, {colorOf(a)});
  graph.markOutput(b);
  EXPECT_TRUE(contains(failure(graph), "later stage"));
}

TEST(PlanMisuse, FramebufferBoundTwiceNeedsAReason) {
  for (const char* reason : {"", "the stencil counts must be complete before they are read"}) {
    Graph graph;
    const ResourceId color = colorTexture(graph, "color"), depth = depthBuffer(graph, "depth");
    addPass(graph, "one", PassStage::scene, {}, {colorOf(color), depthOf(depth)});
    addPass(graph, "two", PassStage::scene, {},
            {depthOf(depth, InitialContent::keep), colorOf(color, InitialContent::keep)}, 0, reason);
    graph.markOutput(color);
    if (*reason) {
      const Plan plan = compiled(graph);
      ASSERT_EQ(plan.passes.size(), 2u);
      EXPECT_EQ(plan.passes[1].rebindReason, reason);
      EXPECT_EQ(plan.passes[0].rebindReason, "");
    } else {
      EXPECT_TRUE(contains(failure(graph), "rebindReason"));
    }
  }
}

TEST(PlanMisuse, TwoBindsAreFineWhenOnlyOneOfThePassesRuns) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  addPass(graph, "overwritten", PassStage::light, {}, {colorOf(a)});
  addPass(graph, "final", PassStage::light, {}, {colorOf(a)});
  graph.markOutput(a);
  EXPECT_EQ(running(graph, compiled(graph)), "final");
}

TEST(PlanMisuse, OtherAttachmentsOverTheSameDepthAreAnotherFramebuffer) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b"),
                   depth = depthBuffer(graph, "depth");
  addPass(graph, "one", PassStage::scene, {}, {colorOf(a), depthOf(depth)});
  addPass(graph, "two", PassStage::scene, {}, {colorOf(b), depthOf(depth, InitialContent::keep)});
  graph.markOutput(a);
  graph.markOutput(b);
  EXPECT_EQ(running(graph, compiled(graph)), "one two");
}

TEST(PlanMisuse, DeclarationsThatCannotBeRight) {
  struct Case {
    const char* expected;
    void (*declare)(Graph&);
  };
  const Case cases[] = {
      {"size of zero", [](Graph& g) { g.addResource({.name = "a"}); }},
      {"two resources are named", [](Graph& g) { colorTexture(g, "a"), colorTexture(g, "a"); }},
      {"writes nothing", [](Graph& g) { addPass(g, "p", PassStage::light, {}, {}); }},
      {"format does not fit",
       [](Graph& g) { addPass(g, "p", PassStage::light, {}, {depthOf(colorTexture(g, "a"))}); }},
      {"already taken",
       [](Graph& g) {
         const ResourceId a = colorTexture(g, "a"), b = colorTexture(g, "b");
         addPass(g, "p", PassStage::light, {}, {colorOf(a), colorOf(b)});
       }},
      {"another size",
       [](Graph& g) {
         const ResourceId a = colorTexture(g, "a");
         const ResourceId d = g.addResource({.name = "d",
                                             .width = 8,
                                             .height = 8,
                                             .format = Format::depth16,
                                             .storage = Storage::renderbuffer});
         addPass(g, "p", PassStage::light, {}, {colorOf(a), depthOf(d)});
       }},
      {"host's framebuffer does not contain",
       [](Graph& g) {
         const ResourceId host = g.importTarget("host", {.width = 64, .height = 32});
         addPass(g, "p", PassStage::scene, {}, {colorOf(host), depthOf(depthBuffer(g, "d"))});
       }},
      {"no texture",
       [](Graph& g) {
         const ResourceId d = depthBuffer(g, "d");
         addPass(g, "p", PassStage::light, {d}, {colorOf(colorTexture(g, "a"))});
       }},
      {"no resource of the graph", [](Graph& g) { addPass(g, "p", PassStage::light, {}, {colorOf({5})}); }},
      {"no resource of the graph",
       [](Graph& g) { addPass(g, "p", PassStage::light, {ResourceId{9}}, {colorOf(colorTexture(g, "a"))}); }},
      {"no resource of the graph", [](Graph& g) { g.markOutput({}); }},
  };
  for (const Case& misuse : cases) {
    Graph graph;
    misuse.declare(graph);
    const std::string message = failure(graph);
    EXPECT_TRUE(contains(message, misuse.expected))
        << "wanted '" << misuse.expected << "', got '" << message << "'";
  }
}

}  // namespace
}  // namespace halfshadow::framegraph
