// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <chrono>
#include <cmath>
#include <vector>

#include "gl/probe_bench.hpp"

namespace halfshadow::gl {
namespace {

constexpr std::string_view kPaint =
    "precision mediump float;\nuniform vec4 u_color;\nvoid main() { gl_FragColor = u_color; }\n";

void setColorAndDepth(ProbeBench& bench, Program& program, const glm::vec4& color, float z) {
  bench.encoder().useProgram(program);
  program.set(bench.context(), "u_color", color);
  program.set(bench.context(), "u_z", z);
}

/// Clip z whose window depth is `depth`.
float clipOf(float depth) {
  return depth * 2.0f - 1.0f;
}

constexpr DrawState kWriteDepth{.depth = {Compare::always, true}};

/// Tags a stencil where depth passes and where it fails, then paints by the tag.
ProbeFailure testStencil(ProbeBench& bench, const Framebuffer& framebuffer) {
  Result<Program> paint = bench.program(kPaint);
  if (!paint) return paint.error().message;
  const Rect all{0, 0, 4, 4};
  bench.clear(framebuffer);
  setColorAndDepth(bench, *paint, glm::vec4(0.0f), clipOf(0.5f));
  bench.draw(framebuffer, *paint, {0, 0, 2, 4}, kWriteDepth);  // left half: depth 0.5; right: 1
  DrawState count{.depth = {Compare::less, false}};
  count.stencil.enabled = true;
  count.stencil.front =
      count.stencil.back = {Compare::always, StencilOp::keep, StencilOp::decrWrap, StencilOp::incrWrap};
  setColorAndDepth(bench, *paint, glm::vec4(0.0f), clipOf(0.75f));
  bench.draw(framebuffer, *paint, all, count);
  const auto paintWhere = [&](int reference, const glm::vec4& color) {
    DrawState where;
    where.stencil.enabled = true;
    where.stencil.reference = reference;
    where.stencil.front.test = where.stencil.back.test = Compare::equal;
    setColorAndDepth(bench, *paint, color, 0.0f);
    bench.draw(framebuffer, *paint, all, where);
  };
  paintWhere(255, glm::vec4(1, 0, 0, 1));
  paintWhere(1, glm::vec4(0, 1, 0, 1));
  const ProbeBench::Pixel left = bench.read(framebuffer, 0, 1), right = bench.read(framebuffer, 3, 1);
  if (left != ProbeBench::Pixel{255, 0, 0, 255} || right != ProbeBench::Pixel{0, 255, 0, 255}) {
    return "stencil tags read back as " + pixelText(left) + " and " + pixelText(right);
  }
  return {};
}

}  // namespace

ProbeFailure probeDepthTexture(ProbeBench& bench) {
  constexpr int kSteps = 8;
  Context& context = bench.context();
  Result<Texture> depth =
      Texture::create(context, {.width = kSteps, .height = 4, .format = TextureFormat::depth16});
  if (!depth) return depth.error().message;
  Result<Texture> color = Texture::create(context, {.width = kSteps, .height = 4});
  if (!color) return color.error().message;
  Result<Framebuffer> framebuffer = Framebuffer::create(context, {.color = &*color, .depthTexture = &*depth});
  if (!framebuffer) return framebuffer.error().message;
  Result<Program> paint = bench.program(kPaint);
  Result<Program> show = bench.program(
      "precision mediump float;\nuniform sampler2D u_depth;\n"
      "void main() {\n"
      "  float d = texture2D(u_depth, vec2(gl_FragCoord.x / 8.0, 0.5)).r;\n"
      "  gl_FragColor = vec4(d, d, d, 1.0);\n"
      "}\n");
  if (!paint || !show) return "the probe's shaders do not compile";
  bench.clear(*framebuffer);
  DrawState less{.depth = {Compare::less, true}};
  for (int i = 0; i < kSteps; ++i) {
    const float wanted = static_cast<float>(i) / kSteps;
    setColorAndDepth(bench, *paint, glm::vec4(1.0f), clipOf(wanted));
    bench.draw(*framebuffer, *paint, {i, 0, 1, 4}, less);
    setColorAndDepth(bench, *paint, glm::vec4(1.0f), clipOf(wanted + 0.05f));  // behind: must not get through
    bench.draw(*framebuffer, *paint, {i, 0, 1, 4}, less);
  }
  bench.encoder().useProgram(*show);
  const TextureBinding binding{show->samplerUnit("u_depth"), &*depth};
  bench.encoder().bindTextures(std::span(&binding, 1));
  bench.draw(bench.target(), *show, {0, 0, kSteps, 4});
  for (int i = 0; i < kSteps; ++i) {
    const int wanted = static_cast<int>(std::lround(255.0 * i / kSteps));
    const int found = bench.read(bench.target(), i, 1)[0];
    if (!near(found, wanted, 2)) {
      return "a depth of " + std::to_string(wanted) + "/255 was sampled as " + std::to_string(found) + "/255";
    }
  }
  return {};
}

/// Window depths 2^-20 apart: 16 bits cannot hold both, 24 can. They lie at a quarter of a 16-bit step, where
/// neither truncation nor rounding puts a border between them.
ProbeFailure probeDepth24(ProbeBench& bench, bool depthTextures, bool highp) {
  constexpr float kStep = 1.0f / 1048576.0f;
  constexpr float kBase = 0.5f - 0.25f / 65535.0f;
  Context& context = bench.context();
  Result<Program> paint = bench.program(kPaint);
  if (!paint) return paint.error().message;
  {
    Result<Renderbuffer> depth =
        Renderbuffer::create(context, ProbeBench::kWidth, ProbeBench::kHeight, RenderbufferFormat::depth24);
    if (!depth) return depth.error().message;
    Result<Framebuffer> framebuffer =
        Framebuffer::create(context, {.color = &bench.targetTexture(), .depth = &*depth});
    if (!framebuffer) return framebuffer.error().message;
    bench.clear(*framebuffer);
    const Rect all{0, 0, 2, 1};
    setColorAndDepth(bench, *paint, glm::vec4(0.0f), clipOf(kBase));
    bench.draw(*framebuffer, *paint, all, kWriteDepth);
    const DrawState less{.depth = {Compare::less, false}};
    setColorAndDepth(bench, *paint, glm::vec4(1, 0, 0, 1), clipOf(kBase) + 2.0f * kStep);
    bench.draw(*framebuffer, *paint, {0, 0, 1, 1}, less);
    setColorAndDepth(bench, *paint, glm::vec4(0, 1, 0, 1), clipOf(kBase) - 2.0f * kStep);
    bench.draw(*framebuffer, *paint, {1, 0, 1, 1}, less);
    const ProbeBench::Pixel behind = bench.read(*framebuffer, 0, 0), before = bench.read(*framebuffer, 1, 0);
    if (behind[0] != 0 || before[1] != 255) return "depths 2^-20 apart are not told apart by the depth test";
  }
  if (!depthTextures) return {};
  if (!highp) return "without fragment highp a sampled depth cannot be checked to 24 bits";
  Result<Texture> depth =
      Texture::create(context, {.width = 4, .height = 4, .format = TextureFormat::depth24});
  if (!depth) return depth.error().message;
  Result<Texture> color = Texture::create(context, {.width = 4, .height = 4});
  if (!color) return color.error().message;
  Result<Framebuffer> framebuffer = Framebuffer::create(context, {.color = &*color, .depthTexture = &*depth});
  if (!framebuffer) return framebuffer.error().message;
  Result<Program> show = bench.program(
      "precision highp float;\nuniform highp sampler2D u_depth;\nuniform float u_base; uniform float "
      "u_scale;\n"
      "void main() {\n"
      "  float d = texture2D(u_depth, gl_FragCoord.xy / 4.0).r;\n"
      "  gl_FragColor = vec4((d - u_base) * u_scale);\n"
      "}\n");
  if (!show) return show.error().message;
  bench.clear(*framebuffer);
  for (int i = 0; i < 4; ++i) {
    setColorAndDepth(bench, *paint, glm::vec4(1.0f), clipOf(kBase) + 2.0f * kStep * static_cast<float>(i));
    bench.draw(*framebuffer, *paint, {i, 0, 1, 4}, kWriteDepth);
  }
  bench.encoder().useProgram(*show);
  show->set(context, "u_base", kBase);
  show->set(context, "u_scale", 0.25f / kStep);
  const TextureBinding binding{show->samplerUnit("u_depth"), &*depth};
  bench.encoder().bindTextures(std::span(&binding, 1));
  bench.draw(bench.target(), *show, {0, 0, 4, 4});
  for (int i = 0; i < 4; ++i) {
    // A 24-bit step is 1/16 of ours, that is 4/255; two of them for rounding here and there.
    const int found = bench.read(bench.target(), i, 1)[0];
    if (!near(found, 64 * i, 8)) return "sampled depths 2^-20 apart are not told apart";
  }
  return {};
}

ProbeFailure probePackedDepthStencil(ProbeBench& bench, bool depthTextures) {
  Context& context = bench.context();
  Result<Renderbuffer> packed = Renderbuffer::create(context, ProbeBench::kWidth, ProbeBench::kHeight,
                                                     RenderbufferFormat::depth24Stencil8);
  if (!packed) return packed.error().message;
  Result<Framebuffer> framebuffer =
      Framebuffer::create(context, {.color = &bench.targetTexture(), .depth = &*packed});
  if (!framebuffer) return framebuffer.error().message;
  if (ProbeFailure failure = testStencil(bench, *framebuffer); !failure.empty()) return failure;
  if (!depthTextures) return {};
  Result<Texture> texture = Texture::create(
      context,
      {.width = ProbeBench::kWidth, .height = ProbeBench::kHeight, .format = TextureFormat::depth24Stencil8});
  if (!texture) return texture.error().message;
  Result<Framebuffer> sampled =
      Framebuffer::create(context, {.color = &bench.targetTexture(), .depthTexture = &*texture});
  if (!sampled) return sampled.error().message;
  return testStencil(bench, *sampled);
}

ProbeFailure probeSeparateDepthStencil(ProbeBench& bench) {
  Context& context = bench.context();
  Result<Renderbuffer> depth =
      Renderbuffer::create(context, ProbeBench::kWidth, ProbeBench::kHeight, RenderbufferFormat::depth16);
  if (!depth) return depth.error().message;
  Result<Renderbuffer> stencil =
      Renderbuffer::create(context, ProbeBench::kWidth, ProbeBench::kHeight, RenderbufferFormat::stencil8);
  if (!stencil) return stencil.error().message;
  Result<Framebuffer> framebuffer =
      Framebuffer::create(context, {.color = &bench.targetTexture(), .depth = &*depth, .stencil = &*stencil});
  if (!framebuffer) return framebuffer.error().message;
  return testStencil(bench, *framebuffer);
}

ProbeFailure probeBlendMinmax(ProbeBench& bench) {
  Result<Program> paint = bench.program(kPaint);
  if (!paint) return paint.error().message;
  const auto blended = [&](BlendEquation equation) {
    bench.clear(bench.target(), glm::vec4(0.2f, 0.8f, 0.4f, 0.6f));
    setColorAndDepth(bench, *paint, glm::vec4(0.8f, 0.2f, 0.6f, 0.4f), 0.0f);
    DrawState state;
    state.blend = {true, equation, BlendFactor::one, BlendFactor::one};
    bench.draw(bench.target(), *paint, {0, 0, 1, 1}, state);
    return bench.read(bench.target(), 0, 0);
  };
  const ProbeBench::Pixel low = blended(BlendEquation::min), high = blended(BlendEquation::max);
  constexpr std::array<int, 4> kLow{51, 51, 102, 102}, kHigh{204, 204, 153, 153};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!near(low[i], kLow[i], 1) || !near(high[i], kHigh[i], 1)) {
      return "MIN and MAX gave " + pixelText(low) + " and " + pixelText(high);
    }
  }
  return {};
}

ProbeFailure probeFramebufferFetch(ProbeBench& bench, std::string_view extension) {
  const std::string last = extension == "GL_EXT_shader_framebuffer_fetch"   ? "gl_LastFragData[0]"
                           : extension == "GL_ARM_shader_framebuffer_fetch" ? "gl_LastFragColorARM"
                                                                            : "gl_LastFragColor";
  Result<Program> add = bench.program(
      "precision mediump float;\nvoid main() { gl_FragColor = " + last + " + vec4(0.2, 0.4, 0.0, 0.0); }\n",
      "#extension " + std::string(extension) + " : require\n");
  if (!add) return add.error().message;
  bench.clear(bench.target(), glm::vec4(0.2f, 0.2f, 0.2f, 1.0f));
  bench.draw(bench.target(), *add, {0, 0, 2, 2});
  bench.draw(bench.target(), *add, {0, 0, 2, 2});
  const ProbeBench::Pixel pixel = bench.read(bench.target(), 1, 1);
  if (!near(pixel[0], 153, 1) || !near(pixel[1], 255, 1) || !near(pixel[2], 51, 1)) {
    return "two additions to the pixel read back as " + pixelText(pixel);
  }
  return {};
}

ProbeFailure probeDerivatives(ProbeBench& bench) {
  Result<Program> slope = bench.program(
      "precision mediump float;\nuniform vec4 u_color;\n"
      "void main() {\n"
      "  vec2 ramp = gl_FragCoord.xy * u_color.xy;\n"
      "  gl_FragColor = vec4(dFdx(ramp.x), abs(dFdy(ramp.y)), abs(dFdx(ramp.y)), fwidth(ramp.x));\n"
      "}\n",
      "#extension GL_OES_standard_derivatives : require\n");
  if (!slope) return slope.error().message;
  setColorAndDepth(bench, *slope, glm::vec4(0.25f, 0.5f, 0.0f, 0.0f), 0.0f);
  bench.draw(bench.target(), *slope, {0, 0, 8, 4});
  const ProbeBench::Pixel pixel = bench.read(bench.target(), 3, 2);
  if (!near(pixel[0], 64, 2) || !near(pixel[1], 128, 2) || pixel[2] > 2 || !near(pixel[3], 64, 2)) {
    return "slopes 1/4, 1/2, 0, 1/4 read back as " + pixelText(pixel);
  }
  return {};
}

/// Some drivers invalidate more than they were asked to.
ProbeFailure probeDiscard(ProbeBench& bench) {
  const Functions& gl = bench.gl();
  if (!gl.discardFramebuffer) return "the extension is listed but glDiscardFramebufferEXT is absent";
  Context& context = bench.context();
  Result<Renderbuffer> depth =
      Renderbuffer::create(context, ProbeBench::kWidth, ProbeBench::kHeight, RenderbufferFormat::depth16);
  if (!depth) return depth.error().message;
  Result<Framebuffer> framebuffer =
      Framebuffer::create(context, {.color = &bench.targetTexture(), .depth = &*depth});
  if (!framebuffer) return framebuffer.error().message;
  Result<Program> paint = bench.program(kPaint);
  if (!paint) return paint.error().message;
  bench.clear(*framebuffer);
  setColorAndDepth(bench, *paint, glm::vec4(0.2f, 0.4f, 0.6f, 0.8f), 0.0f);
  bench.draw(*framebuffer, *paint, {0, 0, 4, 4}, kWriteDepth);
  const GLenum attachment = GL_DEPTH_ATTACHMENT;
  gl.discardFramebuffer(GL_FRAMEBUFFER, 1, &attachment);
  if (const GLenum error = gl.getError(); error != GL_NO_ERROR)
    return "it raises GL error " + std::to_string(error);
  const ProbeBench::Pixel pixel = bench.read(bench.target(), 1, 1);
  constexpr std::array<int, 4> kWanted{51, 102, 153, 204};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!near(pixel[i], kWanted[i], 1)) return "discarding depth changed the color to " + pixelText(pixel);
  }
  return {};
}

/// A triangle behind vertex 65535; indices cut to 16 bits find degenerate ones instead.
ProbeFailure probeUintIndex(ProbeBench& bench) {
  constexpr std::uint32_t kFirst = 65536;
  Context& context = bench.context();
  std::vector<std::int8_t> corners((kFirst + 3) * 4, 0);
  constexpr std::array<std::int8_t, 12> kTriangle{-127, -127, 0, 0, 127, -127, 0, 0, 0, 127, 0, 0};
  std::copy(kTriangle.begin(), kTriangle.end(), corners.begin() + kFirst * 4);
  constexpr std::array<std::uint32_t, 3> kIndices{kFirst, kFirst + 1, kFirst + 2};
  Result<Buffer> vertices = Buffer::create(context, BufferTarget::vertex, std::as_bytes(std::span(corners)),
                                           BufferUsage::staticDraw);
  Result<Buffer> indices = Buffer::create(context, BufferTarget::index, std::as_bytes(std::span(kIndices)),
                                          BufferUsage::staticDraw);
  if (!vertices || !indices) return "the probe's buffers cannot be made";
  Result<Program> paint = bench.program(kPaint);
  if (!paint) return paint.error().message;
  bench.clear(bench.target());
  bench.encoder().beginPass({.framebuffer = &bench.target(), .viewport = {0, 0, 4, 4}});
  setColorAndDepth(bench, *paint, glm::vec4(1.0f), 0.0f);
  const AttributeBinding position{VertexAttribute::position, &*vertices, 2, AttributeType::snorm8, 4, 0};
  bench.encoder().draw({}, {std::span(&position, 1), &*indices, IndexType::uint32, 0, 3});
  bench.encoder().endPass({});
  if (bench.read(bench.target(), 1, 1)[0] != 255) return "a triangle of vertices beyond 65535 was not drawn";
  return {};
}

ProbeFailure probeTextureLod(ProbeBench& bench) {
  Context& context = bench.context();
  constexpr std::array<std::uint8_t, 16> kTexels{0,   0,   0,   255, 255, 255, 255, 255,
                                                 255, 255, 255, 255, 0,   0,   0,   255};
  Result<Texture> texture = Texture::create(
      context, {.width = 2, .height = 2, .filter = TextureFilter::nearestMipNearest, .mipmapped = true},
      kTexels.data());
  if (!texture) return texture.error().message;
  texture->generateMipmaps(context);
  Result<Program> show = bench.program(
      "precision mediump float;\nuniform sampler2D u_texture;\n"
      "void main() {\n"
      "  vec2 corner = vec2(0.25);\n"
      "  gl_FragColor = vec4(texture2DLodEXT(u_texture, corner, 0.0).r, texture2DLodEXT(u_texture, corner, "
      "1.0).r,\n"
      "                      0.0, 1.0);\n"
      "}\n",
      "#extension GL_EXT_shader_texture_lod : require\n");
  if (!show) return show.error().message;
  bench.encoder().useProgram(*show);
  const TextureBinding binding{show->samplerUnit("u_texture"), &*texture};
  bench.encoder().bindTextures(std::span(&binding, 1));
  bench.draw(bench.target(), *show, {0, 0, 2, 2});
  const ProbeBench::Pixel pixel = bench.read(bench.target(), 0, 0);
  if (pixel[0] != 0 || !near(pixel[1], 128, 2)) return "levels 0 and 1 read back as " + pixelText(pixel);
  return {};
}

ProbeFailure probeTimerQuery(ProbeBench& bench) {
  const Functions& gl = bench.gl();
  if (!gl.genQueries || !gl.deleteQueries || !gl.beginQuery || !gl.endQuery || !gl.getQueryiv ||
      !gl.getQueryObjectuiv || !gl.getQueryObjectui64v) {
    return "the extension is listed but its entry points are absent";
  }
  GLint bits = 0;
  gl.getQueryiv(GL_TIME_ELAPSED_EXT, GL_QUERY_COUNTER_BITS_EXT, &bits);
  if (bits <= 0) return "its counter has 0 bits";
  Result<Program> paint = bench.program(kPaint);
  if (!paint) return paint.error().message;
  Object<ObjectKind::query> query = Object<ObjectKind::query>::create(bench.context());
  if (!query) return "no query can be made";
  const auto start = std::chrono::steady_clock::now();
  gl.beginQuery(GL_TIME_ELAPSED_EXT, query.name());
  for (int i = 0; i < 16; ++i) {
    setColorAndDepth(bench, *paint, glm::vec4(static_cast<float>(i) / 16.0f), 0.0f);
    bench.draw(bench.target(), *paint, {0, 0, ProbeBench::kWidth, ProbeBench::kHeight});
  }
  gl.endQuery(GL_TIME_ELAPSED_EXT);
  gl.finish();
  const auto elapsed = [&] { return std::chrono::steady_clock::now() - start; };
  GLuint available = 0;
  while (!available && elapsed() < std::chrono::milliseconds(500)) {
    gl.getQueryObjectuiv(query.name(), GL_QUERY_RESULT_AVAILABLE_EXT, &available);
  }
  if (!available) return "its result did not come within half a second";
  GLuint64 nanoseconds = 0;
  gl.getQueryObjectui64v(query.name(), GL_QUERY_RESULT_EXT, &nanoseconds);
  const double wall = std::chrono::duration<double, std::nano>(elapsed()).count();
  // A GPU clock of another rate would show as more time than has passed; 2 leaves room for coarse clocks.
  if (nanoseconds == 0 || static_cast<double>(nanoseconds) > 2.0 * wall + 1e6) {
    return "it says " + std::to_string(nanoseconds) + " ns for work done within " +
           std::to_string(static_cast<long long>(wall)) + " ns";
  }
  return {};
}

}  // namespace halfshadow::gl
