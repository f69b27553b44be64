// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/encoder.hpp"

#include "gl/timers.hpp"
#include "gl_fixture.hpp"
#include "test_programs.hpp"

namespace halfshadow::test {
namespace {

constexpr int kSize = 4;
constexpr gl::Rect kAll{0, 0, kSize, kSize};

/// A 4x4 target with depth (and stencil where the driver packs them), and the paint program.
class Encoding : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (HasFatalFailure()) return;
    encoder_ = std::make_unique<gl::Encoder>(context());
    programs_ = std::make_unique<gl::ProgramCache>(context(), provide(paintFiles()));
    encoder_->beginFrame();
    const bool packed = capabilities().has(device::Capability::packedDepthStencil);
    Result<gl::Texture> color = gl::Texture::create(context(), {.width = kSize, .height = kSize});
    Result<gl::Renderbuffer> depth = gl::Renderbuffer::create(
        context(), kSize, kSize,
        packed ? gl::RenderbufferFormat::depth24Stencil8 : gl::RenderbufferFormat::depth16);
    ASSERT_TRUE(color && depth);
    color_ = std::move(*color);
    depth_ = std::move(*depth);
    Result<gl::Framebuffer> target = gl::Framebuffer::create(context(), {.color = &color_, .depth = &depth_});
    ASSERT_TRUE(target) << target.error().message;
    target_ = std::move(*target);
    Result<gl::Program*> paint = programs_->get({"paint.vert", "paint.frag", {}});
    ASSERT_TRUE(paint) << paint.error().message;
    paint_ = *paint;
  }
  void TearDown() override {
    target_ = {};
    color_ = {};
    depth_ = {};
    programs_.reset();
    encoder_.reset();
    GlTest::TearDown();
  }

  void begin(const gl::ClearValues& clear) {
    encoder_->beginPass({.framebuffer = &target_, .viewport = kAll, .clear = clear});
  }
  void paint(const glm::vec4& color, const gl::DrawState& state, float z = 0.0f) {
    encoder_->useProgram(*paint_);
    paint_->set(context(), "u_color", color);
    paint_->set(context(), "u_z", z);
    encoder_->drawFullscreen(state);
  }
  Rgba pixel(int x, int y) { return readPixel(*encoder_, target_, x, y); }

  std::unique_ptr<gl::Encoder> encoder_;
  std::unique_ptr<gl::ProgramCache> programs_;
  gl::Texture color_;
  gl::Renderbuffer depth_;
  gl::Framebuffer target_;
  gl::Program* paint_ = nullptr;
};

const glm::vec4 kRed(1, 0, 0, 1), kGreen(0, 1, 0, 1), kBlack(0, 0, 0, 1), kWhite(1, 1, 1, 1);

TEST_F(Encoding, CountsWhatItDoes) {
  const gl::Counters before = encoder_->counters();
  begin({.color = kBlack, .depth = 1.0f});
  paint(kRed, {});
  paint(kGreen, {});
  encoder_->endPass({});
  begin({});  // the same framebuffer: no switch
  paint(kRed, {});
  encoder_->endPass({});
  const gl::Counters done = encoder_->counters() - before;
  EXPECT_EQ(done.draws, 3u);
  EXPECT_EQ(done.triangles, 3u);
  EXPECT_EQ(done.clears, 1u);
  EXPECT_EQ(done.framebufferSwitches, 1u);
  EXPECT_EQ(done.programSwitches, 1u);
  EXPECT_EQ(done.uniformUploads, 4u);  // u_color three times, u_z once
  EXPECT_EQ(done.textureUploadBytes, 0u);
}

TEST_F(Encoding, FullClearsIgnoreMasksAndScissorOfEarlierDraws) {
  begin({.color = kBlack, .depth = 1.0f});
  gl::DrawState narrow;
  narrow.colorMask = {false, true, false, false};
  narrow.scissor = gl::Rect{0, 0, 1, 1};
  narrow.depth.write = false;
  paint(kWhite, narrow);
  encoder_->endPass({});
  EXPECT_EQ(pixel(0, 0), (Rgba{0, 255, 0, 255}));
  EXPECT_EQ(pixel(1, 1), (Rgba{0, 0, 0, 255}));
  begin({.color = kWhite, .depth = 0.25f});
  // Passes only where the depth clear reached.
  paint(kRed, {.depth = {gl::Compare::greater, false}}, 0.0f);
  encoder_->endPass({});
  EXPECT_EQ(pixel(0, 0), (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(pixel(3, 3), (Rgba{255, 0, 0, 255}));
}

TEST_F(Encoding, ScissoredClearsStayInside) {
  begin({.color = kBlack});
  encoder_->endPass({});
  const gl::Rect parts[] = {{1, 1, 2, 1}, {3, 3, 1, 1}};
  encoder_->beginPass(
      {.framebuffer = &target_, .viewport = kAll, .clear = {.color = kRed}, .clearParts = parts});
  encoder_->endPass({});
  EXPECT_EQ(pixel(3, 3), (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(pixel(2, 3), (Rgba{0, 0, 0, 255}));
  EXPECT_EQ(pixel(1, 1), (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(pixel(2, 1), (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(pixel(0, 1), (Rgba{0, 0, 0, 255}));
  EXPECT_EQ(pixel(1, 2), (Rgba{0, 0, 0, 255}));
}

TEST_F(Encoding, StencilClearReachesAllBitsAfterAMaskedDraw) {
  if (!capabilities().has(device::Capability::packedDepthStencil))
    GTEST_SKIP() << "needs packed-depth-stencil";
  begin({.color = kBlack, .depth = 1.0f, .stencil = 0xff});
  gl::DrawState masked;
  masked.stencil.enabled = true;
  masked.stencil.writeMask = 0x0f;
  masked.stencil.front.pass = masked.stencil.back.pass = gl::StencilOp::zero;
  paint(kBlack, masked);  // stencil is 0xf0
  encoder_->endPass({});
  const auto paintWhere = [&](int reference) {
    gl::DrawState equal;
    equal.stencil.enabled = true;
    equal.stencil.reference = reference;
    equal.stencil.front.test = equal.stencil.back.test = gl::Compare::equal;
    paint(kGreen, equal);
  };
  begin({});
  paintWhere(0xf0);
  encoder_->endPass({});
  EXPECT_EQ(pixel(2, 2), (Rgba{0, 255, 0, 255})) << "the write mask was not honoured";
  begin({.color = kBlack, .stencil = 0x55});
  paintWhere(0x55);
  encoder_->endPass({});
  EXPECT_EQ(pixel(2, 2), (Rgba{0, 255, 0, 255})) << "the clear was masked by the earlier draw";
}

TEST_F(Encoding, DepthWritesWithoutATest) {
  begin({.color = kBlack, .depth = 0.0f});
  paint(kRed, {.depth = {gl::Compare::always, true}}, 0.0f);  // window depth 0.5
  paint(kGreen, {.depth = {gl::Compare::equal, false}}, 0.0f);
  encoder_->endPass({});
  EXPECT_EQ(pixel(1, 1), (Rgba{0, 255, 0, 255}));
}

TEST_F(Encoding, BlendsAsAsked) {
  begin({.color = glm::vec4(0.2f, 0.4f, 0.6f, 1.0f)});
  gl::DrawState product;
  product.blend = {true, gl::BlendEquation::add, gl::BlendFactor::zero, gl::BlendFactor::oneMinusSrcColor};
  paint(glm::vec4(0.5f, 0.5f, 0.0f, 0.0f), product);
  encoder_->endPass({});
  const Rgba found = pixel(0, 0);
  // 51/2 and 102/2, either rounding.
  EXPECT_NEAR(found[0], 25, 1);
  EXPECT_NEAR(found[1], 51, 1);
  EXPECT_EQ(found[2], 153);
  EXPECT_EQ(found[3], 255);
}

TEST_F(Encoding, DiscardKeepsWhatWasNotDiscarded) {
  begin({.color = kBlack, .depth = 1.0f});
  paint(kGreen, {.depth = {gl::Compare::less, true}}, 0.5f);
  encoder_->endPass({.discardDepth = true, .discardStencil = true});
  EXPECT_EQ(pixel(2, 1), (Rgba{0, 255, 0, 255}));
  // And the other way round: color discarded, depth kept.
  begin({.color = kBlack, .depth = 1.0f});
  paint(kGreen, {.depth = {gl::Compare::less, true}}, 0.0f);
  encoder_->endPass({.discardColor = true});
  begin({.color = kBlack});
  paint(kRed, {.depth = {gl::Compare::less, false}}, 0.25f);    // behind the kept depth
  paint(kWhite, {.depth = {gl::Compare::less, false}}, -0.5f);  // before it
  encoder_->endPass({});
  EXPECT_EQ(pixel(2, 1), (Rgba{255, 255, 255, 255}));
  begin({.color = kBlack});
  paint(kRed, {.depth = {gl::Compare::less, false}}, 0.25f);
  encoder_->endPass({});
  EXPECT_EQ(pixel(2, 1), (Rgba{0, 0, 0, 255})) << "the depth that was kept is gone";
}

TEST_F(Encoding, DefaultFramebufferCanBeDiscarded) {
  if (headless().width() == 0) GTEST_SKIP() << "this context is surfaceless: it has no framebuffer 0";
  const gl::Framebuffer host = gl::Framebuffer::wrap(0, headless().width(), headless().height());
  encoder_->beginPass({.framebuffer = &host, .viewport = kAll, .clear = {.color = kGreen}});
  encoder_->endPass({.discardDepth = true, .discardStencil = true});
  EXPECT_EQ(readPixel(*encoder_, host, 1, 1), (Rgba{0, 255, 0, 255}));
}

TEST_F(Encoding, TexturesAreBoundToTheProgramsUnits) {
  const std::vector<std::uint8_t> texels(kSize * kSize * 4, 200);
  Result<gl::Texture> texture =
      gl::Texture::create(context(), {.width = kSize, .height = kSize}, texels.data());
  Result<gl::Program*> show = programs_->get({"paint.vert", "show.frag", {}});
  ASSERT_TRUE(texture && show);
  begin({.color = kBlack});
  encoder_->useProgram(**show);
  (*show)->set(context(), "u_z", 0.0f);
  const gl::TextureBinding binding{(*show)->samplerUnit("u_texture"), &*texture};
  encoder_->bindTextures(std::span(&binding, 1));
  // An upload between binding and drawing moves the GL binding; the encoder must notice.
  const std::vector<std::uint8_t> otherTexels(4, 10);
  Result<gl::Texture> other = gl::Texture::create(context(), {.width = 1, .height = 1}, otherTexels.data());
  ASSERT_TRUE(other);
  encoder_->drawFullscreen({});
  encoder_->endPass({});
  EXPECT_EQ(pixel(3, 0), (Rgba{200, 200, 200, 200}));
}

TEST_F(Encoding, DeletedTexturesAreNotRevived) {
  Result<gl::Program*> show = programs_->get({"paint.vert", "show.frag", {}});
  ASSERT_TRUE(show);
  std::uint32_t name = 0;
  {
    Result<gl::Texture> texture = gl::Texture::create(context(), {.width = 1, .height = 1});
    ASSERT_TRUE(texture);
    name = texture->name();
    begin({.color = kBlack});
    encoder_->useProgram(**show);
    const gl::TextureBinding binding{(*show)->samplerUnit("u_texture"), &*texture};
    encoder_->bindTextures(std::span(&binding, 1));
    encoder_->drawFullscreen({});
    encoder_->endPass({});
  }
  begin({});
  paint(kRed, {});
  encoder_->endPass({});
  EXPECT_FALSE(context().functions().isTexture(name)) << "a stale binding made a texture of a deleted name";
}

TEST_F(Encoding, IndexedDrawsUseTheirAttributes) {
  // A quad of two triangles from bytes; the second draw takes the second triangle only.
  const std::array<std::int8_t, 16> corners{-127, -127, 0, 0, 127,  -127, 0, 0,
                                            127,  127,  0, 0, -127, 127,  0, 0};
  const std::array<std::uint16_t, 6> indices{0, 1, 2, 0, 2, 3};
  Result<gl::Buffer> vertexBuffer = gl::Buffer::create(
      context(), gl::BufferTarget::vertex, std::as_bytes(std::span(corners)), gl::BufferUsage::staticDraw);
  Result<gl::Buffer> indexBuffer = gl::Buffer::create(
      context(), gl::BufferTarget::index, std::as_bytes(std::span(indices)), gl::BufferUsage::staticDraw);
  ASSERT_TRUE(vertexBuffer && indexBuffer);
  const gl::AttributeBinding position{
      gl::VertexAttribute::position, &*vertexBuffer, 2, gl::AttributeType::snorm8, 4, 0};
  begin({.color = kBlack});
  encoder_->useProgram(*paint_);
  paint_->set(context(), "u_z", 0.0f);
  paint_->set(context(), "u_color", kGreen);
  const gl::Counters before = encoder_->counters();
  encoder_->draw({.cull = gl::Cull::back},
                 {std::span(&position, 1), &*indexBuffer, gl::IndexType::uint16, 0, 6});
  paint_->set(context(), "u_color", kRed);
  encoder_->draw({}, {std::span(&position, 1), &*indexBuffer, gl::IndexType::uint16, 3, 3});
  encoder_->draw({.cull = gl::Cull::front},
                 {std::span(&position, 1), &*indexBuffer, gl::IndexType::uint16, 0, 6});
  encoder_->endPass({});
  EXPECT_EQ((encoder_->counters() - before).triangles, 5u);
  EXPECT_EQ(pixel(3, 0), (Rgba{0, 255, 0, 255}));
  EXPECT_EQ(pixel(0, 3), (Rgba{255, 0, 0, 255}));
}

TEST_F(Encoding, LostContextsDrawNothingAndRaiseNothing) {
  Result<std::unique_ptr<gl::Context>> made = makeContext();
  ASSERT_TRUE(made);
  gl::Encoder encoder(**made);
  (*made)->markLost();
  encoder.beginFrame();
  encoder.beginPass({.framebuffer = &target_, .viewport = kAll, .clear = {.color = kRed}});
  encoder.drawFullscreen({});
  encoder.endPass({});
  EXPECT_EQ(encoder.counters().draws, 0u);
  EXPECT_EQ(encoder.counters().clears, 0u);
}

TEST_F(Encoding, TimersMeasureBothWays) {
  Result<std::unique_ptr<gl::Context>> plain = makeContext({.forcedOff = {device::Capability::timerQuery}});
  ASSERT_TRUE(plain);
  for (gl::Context* timed : {&context(), plain->get()}) {
    gl::Timer timer(*timed);
    const bool query = timed->capabilities().has(device::Capability::timerQuery);
    EXPECT_EQ(timer.kind(), query ? gl::TimerKind::gpuQuery : gl::TimerKind::finishBounded);
    timer.begin();
    begin({.color = kBlack});
    for (int i = 0; i < 10; ++i) paint(glm::vec4(static_cast<float>(i) / 10.0f), {});
    encoder_->endPass({});
    timer.end();
    const std::optional<double> milliseconds = timer.milliseconds();
    if (!milliseconds) continue;  // disjoint: the clock changed during the test
    EXPECT_GT(*milliseconds, 0.0);
    EXPECT_LT(*milliseconds, 5000.0);  // ten draws of 16 pixels, even on a machine that swaps
  }
}

}  // namespace
}  // namespace halfshadow::test
