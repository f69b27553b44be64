// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/host_state.hpp"

#include "gl/state_list.hpp"
#include "gl/timers.hpp"
#include "gl_fixture.hpp"
#include "test_programs.hpp"

namespace halfshadow::test {
namespace {

using namespace gl::state;

template <typename State>
struct Tag {};

/// A host that has left every state in the list at an unusual value.
class HostileHost {
 public:
  explicit HostileHost(gl::Context& context) : gl_(context.functions()) {
    gl_.genTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    for (const GLuint name : textures_) {
      gl_.bindTexture(GL_TEXTURE_2D, name);
      gl_.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    }
    gl_.genBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
    for (const GLuint name : buffers_) {
      gl_.bindBuffer(GL_ARRAY_BUFFER, name);
      gl_.bufferData(GL_ARRAY_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
    }
    gl_.genRenderbuffers(1, &renderbuffer_);
    gl_.bindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
    gl_.renderbufferStorage(GL_RENDERBUFFER, GL_STENCIL_INDEX8, 4, 4);
    gl_.genFramebuffers(1, &framebuffer_);
    gl_.bindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.framebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures_[0], 0);
    // Without stencil bits a driver may read every stencil reference as 0.
    gl_.framebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, renderbuffer_);
    program_ = gl_.createProgram();
    for (const GLenum stage : {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER}) {
      const char* text = stage == GL_VERTEX_SHADER ? "void main() { gl_Position = vec4(0.0); }"
                                                   : "void main() { gl_FragColor = vec4(0.0); }";
      const GLuint shader = gl_.createShader(stage);
      gl_.shaderSource(shader, 1, &text, nullptr);
      gl_.compileShader(shader);
      gl_.attachShader(program_, shader);
      gl_.deleteShader(shader);
    }
    gl_.linkProgram(program_);
    apply();
  }

  ~HostileHost() {
    applyState(gl_, initialState(captureState(gl_)));
    gl_.deleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    gl_.deleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
    gl_.deleteRenderbuffers(1, &renderbuffer_);
    gl_.deleteFramebuffers(1, &framebuffer_);
    gl_.deleteProgram(program_);
  }

  void apply() {
    forEachState([&]<typename State, std::size_t i>() { std::get<i>(values_) = value(Tag<State>()); });
    applyState(gl_, values_);
  }
  const StateValues& values() const { return values_; }

 private:
  GLint value(Tag<ActiveTexture>) const { return GL_TEXTURE5; }
  template <int unit>
  GLint value(Tag<TextureBinding2D<unit>>) const {
    return static_cast<GLint>(textures_[static_cast<std::size_t>(unit)]);
  }
  GLint value(Tag<ArrayBuffer>) const { return static_cast<GLint>(buffers_[1]); }
  GLint value(Tag<ElementArrayBuffer>) const { return static_cast<GLint>(buffers_[2]); }
  template <GLuint index>
  typename AttributeArray<index>::Type value(Tag<AttributeArray<index>>) const {
    // Enabled everywhere: an engine that forgets to disable one reads a wrong buffer.
    return {1,
            1 + static_cast<GLint>(index % 4),
            GL_SHORT,
            1,
            12,
            static_cast<GLint>(buffers_[0]),
            reinterpret_cast<void*>(std::size_t{8} + 2 * index)};
  }
  GLint value(Tag<FramebufferBinding>) const { return static_cast<GLint>(framebuffer_); }
  GLint value(Tag<RenderbufferBinding>) const { return static_cast<GLint>(renderbuffer_); }
  GLint value(Tag<CurrentProgram>) const { return static_cast<GLint>(program_); }
  std::array<GLint, 4> value(Tag<Viewport>) const { return {1, 2, 3, 5}; }
  std::array<GLint, 4> value(Tag<ScissorBox>) const { return {3, 1, 2, 1}; }
  template <GLenum capability, bool on>
  GLint value(Tag<Enable<capability, on>>) const {
    return on ? 0 : 1;
  }
  std::array<GLint, 4> value(Tag<BlendFunc>) const {
    return {GL_DST_COLOR, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_SRC_COLOR};
  }
  std::array<GLint, 2> value(Tag<BlendEquation>) const {
    return {GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT};
  }
  std::array<GLfloat, 4> value(Tag<BlendColor>) const { return {0.25f, 0.5f, 0.75f, 1.0f}; }
  std::array<GLint, 4> value(Tag<ColorMask>) const { return {0, 1, 0, 0}; }
  GLint value(Tag<DepthFunc>) const { return GL_NEVER; }
  GLint value(Tag<DepthMask>) const { return 0; }
  std::array<GLfloat, 2> value(Tag<DepthRange>) const { return {0.75f, 0.25f}; }
  std::array<GLint, 3> value(Tag<StencilFunc<GL_FRONT>>) const { return {GL_NEVER, 3, 0x5a}; }
  std::array<GLint, 3> value(Tag<StencilFunc<GL_BACK>>) const { return {GL_GREATER, 7, 0x33}; }
  std::array<GLint, 3> value(Tag<StencilOps<GL_FRONT>>) const { return {GL_INVERT, GL_ZERO, GL_DECR}; }
  std::array<GLint, 3> value(Tag<StencilOps<GL_BACK>>) const { return {GL_INCR_WRAP, GL_REPLACE, GL_INCR}; }
  GLint value(Tag<StencilWriteMask<GL_FRONT>>) const { return 0x11; }
  GLint value(Tag<StencilWriteMask<GL_BACK>>) const { return 0x22; }
  GLint value(Tag<CullFaceMode>) const { return GL_FRONT_AND_BACK; }
  GLint value(Tag<FrontFace>) const { return GL_CW; }
  std::array<GLfloat, 2> value(Tag<PolygonOffset>) const { return {8.0f, 1000.0f}; }
  std::array<GLfloat, 2> value(Tag<SampleCoverage>) const { return {0.25f, 1.0f}; }
  std::array<GLfloat, 4> value(Tag<ClearColor>) const { return {1.0f, 0.5f, 0.25f, 0.125f}; }
  GLfloat value(Tag<ClearDepth>) const { return 0.25f; }
  GLint value(Tag<ClearStencil>) const { return 99; }
  GLint value(Tag<PixelStore<GL_PACK_ALIGNMENT>>) const { return 8; }
  GLint value(Tag<PixelStore<GL_UNPACK_ALIGNMENT>>) const { return 2; }

  const gl::Functions& gl_;
  std::array<GLuint, kTextureUnits> textures_{};
  std::array<GLuint, 3> buffers_{};
  GLuint renderbuffer_ = 0, framebuffer_ = 0, program_ = 0;
  StateValues values_;
};

void expectEqual(const StateValues& found, const StateValues& wanted, const char* when) {
  forEachState([&]<typename State, std::size_t i>() {
    EXPECT_TRUE(std::get<i>(found) == std::get<i>(wanted)) << State::kName << " (entry " << i << ") " << when;
  });
}

/// Uploads, two passes with every kind of state, a mipmap, a timer and a read-back; the last pixel is green
/// only if no hostile value got through.
Rgba renderFrame(gl::Context& context) {
  gl::Encoder encoder(context);
  gl::ProgramCache programs(context, provide(paintFiles()));
  encoder.beginFrame();
  const std::array<std::uint8_t, 3 * 2 * 4> unevenRows{};
  Result<gl::Texture> uneven = gl::Texture::create(
      context, {.width = 3, .height = 2, .format = gl::TextureFormat::rgb8}, unevenRows.data());
  Result<gl::Texture> mipmapped = gl::Texture::create(
      context, {.width = 4, .height = 4, .filter = gl::TextureFilter::linearMipLinear, .mipmapped = true});
  Result<gl::Texture> color = gl::Texture::create(context, {.width = 4, .height = 4});
  Result<gl::Renderbuffer> depth = gl::Renderbuffer::create(context, 4, 4, gl::RenderbufferFormat::depth16);
  Result<gl::Program*> paint = programs.get({"paint.vert", "paint.frag", {}});
  Result<gl::Program*> show = programs.get({"paint.vert", "show.frag", {}});
  if (!uneven || !mipmapped || !color || !depth || !paint || !show) return {};
  Result<gl::Framebuffer> source = gl::Framebuffer::create(context, {.color = &*mipmapped});
  Result<gl::Framebuffer> target = gl::Framebuffer::create(context, {.color = &*color, .depth = &*depth});
  if (!source || !target) return {};
  const std::array<std::uint16_t, 3> indices{0, 1, 2};
  const std::array<float, 6> corners{-1, -1, 3, -1, -1, 3};
  Result<gl::Buffer> indexBuffer = gl::Buffer::create(
      context, gl::BufferTarget::index, std::as_bytes(std::span(indices)), gl::BufferUsage::staticDraw);
  Result<gl::Buffer> vertexBuffer = gl::Buffer::create(
      context, gl::BufferTarget::vertex, std::as_bytes(std::span(corners)), gl::BufferUsage::dynamicDraw);
  if (!indexBuffer || !vertexBuffer) return {};

  gl::Timer timer(context);
  timer.begin();
  encoder.beginPass(
      {.framebuffer = &*source, .viewport = {0, 0, 4, 4}, .clear = {.color = glm::vec4(0, 1, 0, 1)}});
  encoder.endPass({});
  mipmapped->generateMipmaps(context);

  encoder.beginPass({.framebuffer = &*target,
                     .viewport = {0, 0, 4, 4},
                     .clear = {.color = glm::vec4(1, 0, 0, 1), .depth = 1.0f, .stencil = 0}});
  gl::DrawState everything;
  everything.depth = {gl::Compare::lequal, true};
  everything.cull = gl::Cull::back;
  everything.scissor = gl::Rect{0, 0, 4, 4};
  everything.polygonOffset = glm::vec2(1.0f, 1.0f);
  everything.blend = {true, gl::BlendEquation::add, gl::BlendFactor::one, gl::BlendFactor::zero};
  everything.stencil.enabled = true;
  everything.colorMask = {true, true, true, true};
  encoder.useProgram(**show);
  (*show)->set(context, "u_z", 0.0f);
  const gl::TextureBinding binding{(*show)->samplerUnit("u_texture"), &*mipmapped};
  encoder.bindTextures(std::span(&binding, 1));
  const gl::AttributeBinding position{
      gl::VertexAttribute::position, &*vertexBuffer, 2, gl::AttributeType::float32, 8, 0};
  encoder.draw(everything, {std::span(&position, 1), &*indexBuffer, gl::IndexType::uint16, 0, 3});
  // Behind the first draw, so invisible.
  encoder.useProgram(**paint);
  (*paint)->set(context, "u_z", 0.5f);
  (*paint)->set(context, "u_color", glm::vec4(0, 0, 1, 1));
  encoder.drawFullscreen({.depth = {gl::Compare::less, false}});
  encoder.endPass({.discardDepth = true});
  timer.end();
  const Rgba pixel = readPixel(encoder, *target, 2, 2);
  static_cast<void>(timer.milliseconds());
  return pixel;
}

class HostState : public GlTest {};

TEST_F(HostState, HostileValuesAreNotTheInitialOnes) {
  HostileHost host(context());
  expectEqual(captureState(context().functions()), host.values(), "was not taken by the driver");
  const StateValues initial = initialState(StateValues{});
  forEachState([&]<typename State, std::size_t i>() {
    EXPECT_FALSE(std::get<i>(initial) == std::get<i>(host.values())) << State::kName << " is not hostile";
  });
}

TEST_F(HostState, RestorePutsEveryValueBack) {
  HostileHost host(context());
  Rgba pixel{};
  {
    const gl::HostStateGuard guard(context(), gl::HostStatePolicy::restore);
    pixel = renderFrame(context());
  }
  EXPECT_EQ(pixel, (Rgba{0, 255, 0, 255})) << "hostile state reached the engine's frame";
  expectEqual(captureState(context().functions()), host.values(), "was not restored");
}

TEST_F(HostState, LeaveDefaultsLeavesInitialValues) {
  HostileHost host(context());
  {
    const gl::HostStateGuard guard(context(), gl::HostStatePolicy::leaveDefaults);
    EXPECT_EQ(renderFrame(context()), (Rgba{0, 255, 0, 255}));
  }
  expectEqual(captureState(context().functions()), initialState(host.values()),
              "is not at its initial value");
}

TEST_F(HostState, LeaveDirtyTouchesNothing) {
  HostileHost host(context());
  StateValues inside;
  {
    const gl::HostStateGuard guard(context(), gl::HostStatePolicy::leaveDirty);
    EXPECT_EQ(renderFrame(context()), (Rgba{0, 255, 0, 255}));
    inside = captureState(context().functions());
  }
  expectEqual(captureState(context().functions()), inside, "changed at the end of the guard");
}

TEST_F(HostState, CreatingAContextRestoresTheHostToo) {
  HostileHost host(context());
  ASSERT_TRUE(makeContext());
  expectEqual(captureState(context().functions()), host.values(), "was changed by the probes");
}

TEST_F(HostState, SurvivesAHostThatDeletedItsCurrentProgram) {
  const gl::Functions& gl = context().functions();
  {
    HostileHost host(context());
    gl.deleteProgram(static_cast<GLuint>(CurrentProgram::get(gl)));
    const gl::HostStateGuard guard(context(), gl::HostStatePolicy::restore);
    EXPECT_EQ(renderFrame(context()), (Rgba{0, 255, 0, 255}));
  }
  while (gl.getError() != GL_NO_ERROR) {  // the host itself deletes the program a second time
  }
}

}  // namespace
}  // namespace halfshadow::test
