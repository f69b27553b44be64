// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/overlay.hpp"

#include <GLES2/gl2.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace halfshadow::viewer {
namespace {
// The rows of ImDrawVert, bound by place.
constexpr GLuint kPosition = 0, kTexcoord = 1, kColor = 2;

const char* const kVertex = R"(#version 100
attribute vec2 a_position;
attribute vec2 a_texcoord;
attribute vec4 a_color;
uniform vec4 u_clipFromWindow;
varying highp vec2 v_texcoord;
varying vec4 v_color;
void main() {
  v_texcoord = a_texcoord;
  v_color = a_color;
  gl_Position = vec4(a_position * u_clipFromWindow.xy + u_clipFromWindow.zw, 0.0, 1.0);
}
)";

const char* const kFragment = R"(#version 100
#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif
uniform highp sampler2D u_image;
varying highp vec2 v_texcoord;
varying lowp vec4 v_color;
void main() {
  vec4 texel = texture2D(u_image, v_texcoord);
  gl_FragColor = v_color * SHOWN;
}
)";

/// What a texel becomes, in the order of Shown.
const char* const kShown[] = {
    "texel",
    "vec4(texel.rgb, 1.0)",
    "vec4(texel.rrr, 1.0)",
    "vec4(texel.aaa, 1.0)",
    "vec4(vec3(dot(texel.rg, vec2(256.0, 1.0) * (255.0 / 65280.0))), 1.0)",
    "vec4(vec3(dot(texel.rgb, vec3(65536.0, 256.0, 1.0) * (255.0 / 16777215.0))), 1.0)"};

/// Fragments without highp cannot name it in a varying either.
std::string fragmentFor(std::size_t shown, bool highp) {
  std::string source = kFragment;
  source.replace(source.find("SHOWN"), 5, kShown[shown]);
  if (highp) return source;
  for (std::size_t at; (at = source.find("highp ")) != std::string::npos;) source.replace(at, 6, "mediump ");
  return source;
}

Result<GLuint> shader(GLenum kind, const std::string& source) {
  const GLuint name = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(name, 1, &text, nullptr);
  glCompileShader(name);
  GLint compiled = 0;
  glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (compiled) return name;
  std::array<char, 512> log{};
  glGetShaderInfoLog(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteShader(name);
  return Error{ErrorCode::shaderFailed,
               std::string("a shader of the viewer's panels does not compile here: ") + log.data() +
                   "; try --driver llvmpipe"};
}

bool hasHighp() {
  GLint range[2] = {0, 0}, precision = 0;
  glGetShaderPrecisionFormat(GL_FRAGMENT_SHADER, GL_HIGH_FLOAT, range, &precision);
  return precision > 0;
}

Result<GLuint> link(std::size_t shown) {
  const auto vertex = shader(GL_VERTEX_SHADER, kVertex);
  if (!vertex) return vertex.error();
  const auto fragment = shader(GL_FRAGMENT_SHADER, fragmentFor(shown, hasHighp()));
  if (!fragment) {
    glDeleteShader(*vertex);
    return fragment.error();
  }
  const GLuint program = glCreateProgram();
  glAttachShader(program, *vertex);
  glAttachShader(program, *fragment);
  glBindAttribLocation(program, kPosition, "a_position");
  glBindAttribLocation(program, kTexcoord, "a_texcoord");
  glBindAttribLocation(program, kColor, "a_color");
  glLinkProgram(program);
  glDeleteShader(*vertex);
  glDeleteShader(*fragment);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  glDeleteProgram(program);
  return Error{ErrorCode::shaderFailed,
               "the shaders of the viewer's panels do not link here; try --driver llvmpipe"};
}
}  // namespace

ImTextureID imageId(std::uint32_t texture, Shown how) {
  static_assert(sizeof(ImTextureID) >= sizeof(std::uint64_t), "32 bits name the texture, the others the way");
  const std::uint64_t bits = texture | (static_cast<std::uint64_t>(how) << 32);
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(bits));
}

OwnTexture::~OwnTexture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

void OwnTexture::upload(int width, int height, const std::uint8_t* rgba) {
  if (name_ == 0) glGenTextures(1, &name_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Result<std::unique_ptr<Overlay>> Overlay::create() {
  std::unique_ptr<Overlay> overlay(new Overlay);
  static_assert(std::size(kShown) == kShownCount);
  for (std::size_t i = 0; i < kShownCount; ++i) {
    const auto name = link(i);
    if (!name) return name.error();
    overlay->programs_[i] = {*name, glGetUniformLocation(*name, "u_clipFromWindow"),
                             glGetUniformLocation(*name, "u_image")};
  }
  glGenBuffers(1, &overlay->vertices_);
  glGenBuffers(1, &overlay->indices_);
  overlay->rebuildFont();
  return overlay;
}

Overlay::~Overlay() {
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
  for (const Program& program : programs_) glDeleteProgram(program.name);
}

void Overlay::rebuildFont() {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
  font_.upload(width, height, pixels);
  fonts.SetTexID(imageId(font_.name(), Shown::blended));
}

void Overlay::bindStates(int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  for (const GLenum off : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_POLYGON_OFFSET_FILL,
                           GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE, GL_SCISSOR_TEST})
    glDisable(off);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
  glClearColor(0.06f, 0.06f, 0.07f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glActiveTexture(GL_TEXTURE0);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  for (const GLuint place : {kPosition, kTexcoord, kColor}) glEnableVertexAttribArray(place);
  const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  constexpr GLsizei kStride = sizeof(ImDrawVert);
  glVertexAttribPointer(kPosition, 2, GL_FLOAT, GL_FALSE, kStride, at(offsetof(ImDrawVert, pos)));
  glVertexAttribPointer(kTexcoord, 2, GL_FLOAT, GL_FALSE, kStride, at(offsetof(ImDrawVert, uv)));
  glVertexAttribPointer(kColor, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, at(offsetof(ImDrawVert, col)));
}

void Overlay::use(const ImDrawData& data, Shown how) {
  const Program& program = programs_[static_cast<std::size_t>(how)];
  glUseProgram(program.name);
  const float x = 2.0f / data.DisplaySize.x, y = -2.0f / data.DisplaySize.y;
  glUniform4f(program.clipFromWindow, x, y, -1.0f - data.DisplayPos.x * x, 1.0f - data.DisplayPos.y * y);
  glUniform1i(program.image, 0);
  // Whole pictures need none, and on a software driver it takes as long as they do.
  if (how == Shown::blended) {
    glEnable(GL_BLEND);
  } else {
    glDisable(GL_BLEND);
  }
}

void Overlay::drawList(const ImDrawData& data, const ImDrawList& list, int height) {
  static_assert(sizeof(ImDrawIdx) == 2, "ES 2.0 draws indices of 16 bits");
  glBufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data, GL_STREAM_DRAW);
  std::optional<Shown> used;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
    const int left = static_cast<int>((command.ClipRect.x - origin.x) * scale.x);
    const int top = static_cast<int>((command.ClipRect.y - origin.y) * scale.y);
    const int right = static_cast<int>((command.ClipRect.z - origin.x) * scale.x);
    const int bottom = static_cast<int>((command.ClipRect.w - origin.y) * scale.y);
    if (right <= left || bottom <= top) continue;
    glScissor(left, height - bottom, right - left, bottom - top);
    const auto bits = reinterpret_cast<std::uintptr_t>(command.GetTexID());
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bits & 0xffffffffu));
    const auto how = static_cast<Shown>(static_cast<std::uint64_t>(bits) >> 32);
    if (how != used) use(data, how);
    used = how;
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), GL_UNSIGNED_SHORT,
                   reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)));
  }
}

void Overlay::draw(const ImDrawData& data) {
  const int width = static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x);
  const int height = static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y);
  if (width <= 0 || height <= 0) return;
  bindStates(width, height);
  for (int i = 0; i < data.CmdListsCount; ++i) drawList(data, *data.CmdLists[i], height);
  for (const GLuint place : {kPosition, kTexcoord, kColor}) glDisableVertexAttribArray(place);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

std::vector<std::uint8_t> windowPixels(int width, int height) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  std::vector<std::uint8_t> rgba(w * h * 4), rgb;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  rgb.reserve(w * h * 3);
  for (std::size_t y = h; y-- > 0;) {
    for (std::size_t x = 0; x < w; ++x) {
      const std::uint8_t* pixel = rgba.data() + (y * w + x) * 4;
      rgb.insert(rgb.end(), pixel, pixel + 3);
    }
  }
  return rgb;
}

std::optional<std::vector<std::uint8_t>> texels(std::uint32_t texture, int width, int height) {
  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  std::optional<std::vector<std::uint8_t>> rgba;
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) {
    rgba.emplace(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba->data());
  }
  while (glGetError() == GL_INVALID_OPERATION) {
  }  // attaching a texture that cannot be drawn to
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  return rgba;
}

int takeGlErrors() {
  int errors = 0;
  // A lost context reports errors for ever.
  while (errors < 100 && glGetError() != GL_NO_ERROR) ++errors;
  return errors;
}

}  // namespace halfshadow::viewer
