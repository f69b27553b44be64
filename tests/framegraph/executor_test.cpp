// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "framegraph/executor.hpp"

#include "gl_fixture.hpp"
#include "graph_builder.hpp"

namespace halfshadow::framegraph {
namespace {
using namespace testing;
using test::readPixel;
using test::Rgba;

constexpr const char* kVertex =
    "attribute vec2 a_position; void main() { gl_Position = vec4(a_position, 0.5, 1.0); }";
constexpr const char* kFill =
    "precision mediump float; uniform vec4 u_color; void main() { gl_FragColor = u_color; }";
// Copies the texture with red and blue exchanged, so that a copy differs from its source.
constexpr const char* kSwap =
    "precision mediump float; uniform sampler2D u_source; uniform vec4 u_texel;"
    "void main() { gl_FragColor = texture2D(u_source, gl_FragCoord.xy * u_texel.xy).bgra; }";

class ExecutorTest : public test::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (HasFatalFailure()) return;
    open(context());
  }
  void TearDown() override {
    close();
    GlTest::TearDown();
  }

  void open(gl::Context& used) {
    encoder = std::make_unique<gl::Encoder>(used);
    executor = std::make_unique<Executor>(used);
    Result<gl::Program> fillResult = gl::Program::link(used, kVertex, kFill, {}, "fill");
    Result<gl::Program> swapResult = gl::Program::link(used, kVertex, kSwap, {"u_source"}, "swap");
    ASSERT_TRUE(fillResult.ok()) << fillResult.error().message;
    ASSERT_TRUE(swapResult.ok()) << swapResult.error().message;
    fill = std::move(*fillResult);
    swap = std::move(*swapResult);
  }
  void close() {
    executor.reset();
    encoder.reset();
    fill = {};
    swap = {};
  }

  std::function<void(PassContext&)> filling(const glm::vec4& color) {
    return [this, color](PassContext& pass) {
      pass.encoder.useProgram(fill);
      fill.set(pass.encoder.context(), "u_color", color);
      pass.encoder.drawFullscreen({});
    };
  }
  std::function<void(PassContext&)> swapping(ResourceId source,
                                             const glm::vec2& texel = {1.0f / 64, 1.0f / 32}) {
    return [this, source, texel](PassContext& pass) {
      pass.encoder.useProgram(swap);
      swap.set(pass.encoder.context(), "u_texel", glm::vec4(texel, 0, 0));
      const gl::TextureBinding binding{.unit = 0, .texture = &pass.texture(source)};
      pass.encoder.bindTextures({&binding, 1});
      pass.encoder.drawFullscreen({});
    };
  }

  std::vector<PassReport> runs(const Graph& graph, PassTiming timing = PassTiming::off) {
    const Result<Plan> plan =
        compile(graph, [&](const ResourceDesc& desc) { return executor->contentKeyOf(desc); });
    EXPECT_TRUE(plan.ok()) << plan.error().message;
    if (!plan.ok()) return {};
    Result<std::vector<PassReport>> reports = executor->run(graph, *plan, *encoder, timing);
    EXPECT_TRUE(reports.ok()) << reports.error().message;
    lastPlan = *plan;
    return reports.ok() ? *reports : std::vector<PassReport>{};
  }
  Error fails(const Graph& graph) {
    const Result<Plan> plan =
        compile(graph, [&](const ResourceDesc& desc) { return executor->contentKeyOf(desc); });
    EXPECT_TRUE(plan.ok());
    const Result<std::vector<PassReport>> reports = executor->run(graph, *plan, *encoder, PassTiming::off);
    EXPECT_FALSE(reports.ok());
    return reports.ok() ? Error{ErrorCode::ok, ""} : reports.error();
  }
  Rgba pixelOf(const Graph& graph, ResourceId resource, int x = 10, int y = 10) {
    const gl::Framebuffer* framebuffer = executor->framebufferFor(graph, resource);
    EXPECT_NE(framebuffer, nullptr);
    return framebuffer ? readPixel(*encoder, *framebuffer, x, y) : Rgba{};
  }

  std::unique_ptr<gl::Encoder> encoder;
  std::unique_ptr<Executor> executor;
  gl::Program fill, swap;
  Plan lastPlan;
};

void addDrawingPass(Graph& graph, const std::string& name, PassStage stage, std::vector<ResourceId> reads,
                    std::vector<Attachment> writes, std::function<void(PassContext&)> execute,
                    std::uint64_t contentKey = 0, const std::string& rebindReason = "") {
  graph.addPass({.name = name,
                 .stage = stage,
                 .reads = std::move(reads),
                 .writes = std::move(writes),
                 .contentKey = contentKey,
                 .rebindReason = rebindReason,
                 .execute = std::move(execute)});
}

const glm::vec4 kRed(1, 0, 0, 1), kGreen(0, 1, 0, 1);
const Rgba kRedBytes{255, 0, 0, 255}, kBlueBytes{0, 0, 255, 255}, kGreenBytes{0, 255, 0, 255};

TEST_F(ExecutorTest, UpdatesClearTheirPartsAlone) {
  const auto graphOf = [&](std::uint64_t key, std::uint64_t fromKey, std::vector<Rect> parts,
                           std::function<void(PassContext&)> execute) {
    Graph graph;
    const ResourceId map = colorTexture(graph, "map", Lifetime::persistent);
    Attachment write = colorOf(map);
    write.clear.color[1] = write.clear.color[3] = 1.0f;
    graph.addPass({.name = "casters",
                   .stage = PassStage::light,
                   .writes = {write},
                   .contentKey = key,
                   .update = {.fromKey = fromKey, .parts = std::move(parts)},
                   .execute = std::move(execute)});
    graph.markOutput(map);
    return graph;
  };
  bool updates = true;
  runs(graphOf(1, 0, {}, [&](PassContext& pass) {
    updates = pass.updates;
    filling(kRed)(pass);
  }));
  EXPECT_FALSE(updates);
  const Graph update =
      graphOf(2, 1, {{2, 2, 4, 4}, {10, 10, 1, 1}}, [&](PassContext& pass) { updates = pass.updates; });
  const std::vector<PassReport> reports = runs(update);
  EXPECT_TRUE(updates);
  EXPECT_EQ(reports[0].counters.clears, 2u);
  const ResourceId map{0};
  EXPECT_EQ(pixelOf(update, map, 2, 2), kGreenBytes);
  EXPECT_EQ(pixelOf(update, map, 5, 5), kGreenBytes);
  EXPECT_EQ(pixelOf(update, map, 10, 10), kGreenBytes);
  EXPECT_EQ(pixelOf(update, map, 6, 5), kRedBytes);
  EXPECT_EQ(pixelOf(update, map, 11, 10), kRedBytes);
  // Where nothing lies in the map that is different, nothing of it is.
  const Graph same = graphOf(3, 2, {}, [&](PassContext& pass) { updates = pass.updates; });
  EXPECT_EQ(runs(same)[0].counters.clears, 0u);
  EXPECT_EQ(pixelOf(same, map, 6, 5), kRedBytes);
  // Of what has gone there is no update.
  executor->trim(0);
  runs(graphOf(4, 3, {{2, 2, 4, 4}}, [&](PassContext& pass) { updates = pass.updates; }));
  EXPECT_FALSE(updates);
  EXPECT_EQ(pixelOf(same, map, 30, 30), kGreenBytes);
}

TEST_F(ExecutorTest, DrawsReadsAndReports) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b"),
                   depth = depthBuffer(graph, "depth");
  addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(a), depthOf(depth)}, filling(kRed));
  addDrawingPass(graph, "swap", PassStage::scene, {a}, {colorOf(b, InitialContent::dontCare)}, swapping(a));
  graph.markOutput(b);
  const std::vector<PassReport> reports = runs(graph);
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(pixelOf(graph, b), kBlueBytes);
  EXPECT_EQ(graph.passes()[lastPlan.passes[reports[0].planned].pass].name, "fill");
  EXPECT_EQ(targetText(graph, lastPlan.passes[0]), "a+depth 64x32");
  EXPECT_EQ(reports[0].counters.draws, 1u);
  EXPECT_EQ(reports[0].counters.triangles, 1u);
  EXPECT_EQ(reports[0].counters.clears, 1u);
  EXPECT_EQ(reports[0].counters.framebufferSwitches, 1u);
  EXPECT_EQ(reports[1].counters.clears, 0u);
  EXPECT_EQ(reports[1].milliseconds, 0.0);  // not timed
}

TEST_F(ExecutorTest, SecondRunIssuesNoDraws) {
  for (int frame = 0; frame < 3; ++frame) {
    const std::uint64_t key = frame < 2 ? 77 : 78;  // the third frame's content is another
    Graph graph;
    const ResourceId map = colorTexture(graph, "map", Lifetime::persistent);
    addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(map)}, filling(frame < 2 ? kRed : kGreen),
                   key);
    graph.markOutput(map);
    const std::uint64_t drawsBefore = encoder->counters().draws;
    runs(graph);
    EXPECT_EQ(encoder->counters().draws - drawsBefore, frame == 1 ? 0u : 1u);
    EXPECT_EQ(pixelOf(graph, map), frame < 2 ? kRedBytes : kGreenBytes);
    EXPECT_EQ(executor->contentKeyOf(graph.resources()[map.index]), key);
    ASSERT_NE(executor->texture(graph, map), nullptr);
  }
  executor->forgetContent();
  EXPECT_EQ(executor->contentKeyOf({.name = "map", .width = 64, .height = 32}), 0u);
}

TEST_F(ExecutorTest, PersistentImageOfAnotherSizeIsReplaced) {
  std::uint64_t bytes = 0;
  for (const int width : {64, 128, 64}) {
    Graph graph;
    const ResourceId map =
        graph.addResource({.name = "map", .width = width, .height = 32, .lifetime = Lifetime::persistent});
    addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(map)}, filling(kRed), 5);
    graph.markOutput(map);
    EXPECT_EQ(runs(graph).size(), 1u) << width;  // never taken from the cache
    bytes = executor->memoryBytes();
    EXPECT_EQ(bytes, static_cast<std::uint64_t>(width) * 32 * 4);
  }
}

TEST_F(ExecutorTest, KeptAttachmentSurvivesTheDiscardOfAnother) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a"), depth = depthBuffer(graph, "depth");
  const ResourceId other = colorTexture(graph, "other");
  addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(a), depthOf(depth)}, filling(kRed));
  addDrawingPass(graph, "other", PassStage::light, {}, {colorOf(other)}, filling(kGreen));
  graph.markOutput(a);
  graph.markOutput(other);
  const std::vector<PassReport> reports = runs(graph);
  ASSERT_EQ(reports.size(), 2u);
  // A driver that discards the wrong attachment, or that of the wrong framebuffer, shows here.
  EXPECT_EQ(pixelOf(graph, a), kRedBytes);
  EXPECT_EQ(pixelOf(graph, other), kGreenBytes);
}

TEST_F(ExecutorTest, LoadKeepsWhatTheEarlierPassDrew) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(a)}, filling(kRed));
  addDrawingPass(
      graph, "half", PassStage::scene, {}, {colorOf(a, InitialContent::keep)},
      [this](PassContext& pass) {
        pass.encoder.useProgram(fill);
        fill.set(pass.encoder.context(), "u_color", kGreen);
        pass.encoder.drawFullscreen({.scissor = gl::Rect{32, 0, 32, 32}});
      },
      0, "a later stage adds to it");
  graph.markOutput(a);
  const std::vector<PassReport> reports = runs(graph);
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(lastPlan.passes[1].attachments[0].load, LoadAction::load);
  EXPECT_EQ(pixelOf(graph, a, 10, 10), kRedBytes);
  EXPECT_EQ(pixelOf(graph, a, 50, 10), kGreenBytes);
}

TEST_F(ExecutorTest, TransientImagesAreReusedWithinAndBetweenFrames) {
  for (int frame = 0; frame < 2; ++frame) {
    Graph graph;
    std::vector<ResourceId> chain;
    for (int i = 0; i < 5; ++i) chain.push_back(colorTexture(graph, "link-" + std::to_string(i)));
    addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(chain[0])}, filling(kRed));
    for (int i = 1; i < 5; ++i) {
      addDrawingPass(graph, "swap-" + std::to_string(i), PassStage::light, {chain[i - 1]},
                     {colorOf(chain[i])}, swapping(chain[i - 1]));
    }
    graph.markOutput(chain[4]);
    ASSERT_EQ(runs(graph).size(), 5u);
    EXPECT_EQ(pixelOf(graph, chain[4]), kRedBytes);  // swapped four times
    // Two links live at a time, so two images serve all five.
    EXPECT_EQ(executor->memoryBytes(), 2u * 64 * 32 * 4);
    EXPECT_EQ(executor->texture(graph, chain[0]), nullptr);  // its image has been given away
  }
}

TEST_F(ExecutorTest, HostTargetIsTouchedInsideItsViewportOnly) {
  Result<gl::Texture> texture = gl::Texture::create(context(), {.width = 64, .height = 32});
  ASSERT_TRUE(texture.ok());
  Result<gl::Framebuffer> host = gl::Framebuffer::create(context(), {.color = &*texture});
  ASSERT_TRUE(host.ok());
  for (const bool whole : {true, false}) {
    Graph graph;
    const ImportedTarget target{.framebufferName = host->name(),
                                .x = whole ? 0 : 16,
                                .y = whole ? 0 : 8,
                                .width = whole ? 64 : 32,
                                .height = whole ? 32 : 16};
    const ResourceId imported = graph.importTarget("host", target);
    Attachment attachment = colorOf(imported);
    attachment.clear.color[whole ? 0 : 1] = attachment.clear.color[3] = 1.0f;
    addDrawingPass(graph, "clear", PassStage::scene, {}, {attachment}, nullptr);
    ASSERT_EQ(runs(graph).size(), 1u);
    EXPECT_EQ(executor->texture(graph, imported), nullptr);
  }
  EXPECT_EQ(readPixel(*encoder, *host, 17, 9), kGreenBytes);
  EXPECT_EQ(readPixel(*encoder, *host, 15, 9), kRedBytes);
  EXPECT_EQ(readPixel(*encoder, *host, 48, 9), kRedBytes);
  EXPECT_EQ(readPixel(*encoder, *host, 17, 24), kRedBytes);
}

TEST_F(ExecutorTest, MipmapsAreMadeAfterTheWriter) {
  Graph graph;
  const ResourceId a = graph.addResource(
      {.name = "a", .width = 64, .height = 32, .filter = Filter::nearestMipNearest, .mipmapped = true});
  const ResourceId b = colorTexture(graph, "b");
  addDrawingPass(graph, "halves", PassStage::light, {}, {colorOf(a)}, [this](PassContext& pass) {
    filling(kRed)(pass);
    fill.set(pass.encoder.context(), "u_color", glm::vec4(0, 1, 0, 1));
    pass.encoder.drawFullscreen({.scissor = gl::Rect{32, 0, 32, 32}});
  });
  // Neighbouring pixels lie a whole texture apart, so that the smallest level is read.
  addDrawingPass(graph, "swap", PassStage::scene, {a}, {colorOf(b)}, swapping(a, {1.0f, 1.0f}));
  graph.markOutput(b);
  ASSERT_EQ(runs(graph).size(), 2u);
  const Rgba average = pixelOf(graph, b);
  EXPECT_EQ(average[0], 0);
  EXPECT_NEAR(average[1], 127.5, 2.0);  // six halvings of 8-bit levels may each round by half a step
  EXPECT_NEAR(average[2], 127.5, 2.0);
}

TEST_F(ExecutorTest, TimesEachPass) {
  Graph graph;
  const ResourceId a = colorTexture(graph, "a");
  addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(a)}, filling(kRed));
  graph.markOutput(a);
  const std::vector<PassReport> reports = runs(graph, PassTiming::perPass);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_GT(reports[0].milliseconds, 0.0);
  EXPECT_LT(reports[0].milliseconds, 1000.0);  // a 64x32 fill; a wrong unit would be a thousand times off
}

TEST_F(ExecutorTest, FaultyPassNamesItselfAndLeavesNoKey) {
  Graph graph;
  const ResourceId map = colorTexture(graph, "map", Lifetime::persistent);
  addDrawingPass(
      graph, "broken", PassStage::light, {}, {colorOf(map)},
      [this](PassContext&) { context().functions().enable(0xdead); }, 9);
  graph.markOutput(map);
  const Error error = fails(graph);
  EXPECT_EQ(error.code, ErrorCode::driverFault);
  EXPECT_NE(error.message.find("broken"), std::string::npos) << error.message;
  EXPECT_EQ(executor->contentKeyOf(graph.resources()[map.index]), 0u);
}

TEST_F(ExecutorTest, TrimFreesWhatRecentRunsDidNotUse) {
  const auto frame = [&](const std::string& name) {
    Graph graph;
    const ResourceId map = colorTexture(graph, name, Lifetime::persistent);
    addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(map)}, filling(kRed), 5);
    graph.markOutput(map);
    return runs(graph).size();
  };
  constexpr std::uint64_t kOne = 64 * 32 * 4;
  EXPECT_EQ(frame("old"), 1u);
  EXPECT_EQ(frame("new"), 1u);
  EXPECT_EQ(executor->memoryBytes(), 2 * kOne);
  executor->trim(2);
  EXPECT_EQ(executor->memoryBytes(), 2 * kOne);
  executor->trim(1);
  EXPECT_EQ(executor->memoryBytes(), kOne);
  EXPECT_EQ(frame("new"), 0u);  // kept
  EXPECT_EQ(frame("old"), 1u);  // made again
  executor->trim(0);
  EXPECT_EQ(executor->memoryBytes(), 0u);
}

TEST_F(ExecutorTest, TrimFreesFramebuffersThatRecentRunsDidNotUse) {
  // Two colours and a depth, of which now the first, now the second has the depth beside it.
  const auto frame = [&](bool depthFirst) {
    Graph graph;
    const ResourceId a = colorTexture(graph, "a"), b = colorTexture(graph, "b");
    const ResourceId depth = depthBuffer(graph, "depth");
    const auto writes = [&](ResourceId color, bool withDepth) {
      std::vector<Attachment> attachments{colorOf(color)};
      if (withDepth) attachments.push_back(depthOf(depth));
      return attachments;
    };
    addDrawingPass(graph, "a", PassStage::light, {}, writes(a, depthFirst), filling(kRed));
    addDrawingPass(graph, "b", PassStage::light, {a}, writes(b, !depthFirst), swapping(a));
    graph.markOutput(b);
    EXPECT_EQ(runs(graph).size(), 2u);
    EXPECT_EQ(pixelOf(graph, b), kBlueBytes);
  };
  const auto framebuffers = [&] { return context().liveObjects().framebuffers; };
  frame(false);
  const int ofOne = framebuffers();
  frame(true);
  EXPECT_GT(framebuffers(), ofOne);
  frame(false);
  executor->trim(1);
  EXPECT_EQ(framebuffers(), ofOne);
  frame(true);  // made again
}

TEST_F(ExecutorTest, MissingCapabilitiesAreNamed) {
  close();
  Result<std::unique_ptr<gl::Context>> bare =
      test::makeContext({.forcedOff = {device::Capability::depthTexture, device::Capability::depth24,
                                       device::Capability::packedDepthStencil}});
  ASSERT_TRUE(bare.ok()) << bare.error().message;
  open(**bare);
  const auto graphWith = [&](Format format, Storage storage, AttachmentPoint point) {
    Graph graph;
    const ResourceId a = colorTexture(graph, "a");
    const ResourceId d =
        graph.addResource({.name = "d", .width = 64, .height = 32, .format = format, .storage = storage});
    addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(a), {.resource = d, .point = point}},
                   filling(kRed));
    graph.markOutput(a);
    return graph;
  };
  const Error packed =
      fails(graphWith(Format::depth24Stencil8, Storage::renderbuffer, AttachmentPoint::depthStencil));
  EXPECT_EQ(packed.code, ErrorCode::capabilityMissing);
  EXPECT_NE(packed.message.find("packed-depth-stencil"), std::string::npos) << packed.message;
  const Error texture = fails(graphWith(Format::depth16, Storage::texture, AttachmentPoint::depth));
  EXPECT_EQ(texture.code, ErrorCode::internal);
  EXPECT_NE(texture.message.find("depth-texture"), std::string::npos) << texture.message;
  // 24 bits fall back to 16: half the memory of the padded 24.
  executor->trim(0);
  EXPECT_EQ(runs(graphWith(Format::depth24, Storage::renderbuffer, AttachmentPoint::depth)).size(), 1u);
  EXPECT_EQ(executor->memoryBytes(), 64u * 32 * (4 + 2));
  close();
}

TEST_F(ExecutorTest, LostContextIsAnErrorAndFreesNothing) {
  close();
  Result<std::unique_ptr<gl::Context>> doomed = test::makeContext();
  ASSERT_TRUE(doomed.ok());
  open(**doomed);
  Graph graph;
  const ResourceId map = colorTexture(graph, "map", Lifetime::persistent);
  addDrawingPass(graph, "fill", PassStage::light, {}, {colorOf(map)}, filling(kRed), 5);
  graph.markOutput(map);
  ASSERT_EQ(runs(graph).size(), 1u);
  (*doomed)->markLost();
  EXPECT_EQ(executor->contentKeyOf(graph.resources()[map.index]), 0u);
  EXPECT_EQ(fails(graph).code, ErrorCode::contextLost);
  EXPECT_EQ(executor->memoryBytes(), 0u);
  close();
  EXPECT_EQ((*doomed)->liveObjects().total(), 0);
}

}  // namespace
}  // namespace halfshadow::framegraph
