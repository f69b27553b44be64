// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/probe_bench.hpp"

namespace halfshadow::gl {

ProbeBench::ProbeBench(Context& context) : encoder_(context) {
  encoder_.beginFrame();
  Result<Texture> color = Texture::create(context, {kWidth, kHeight});
  if (!color) return;
  color_ = std::move(*color);
  Result<Framebuffer> target = Framebuffer::create(context, {.color = &color_});
  if (target) target_ = std::move(*target);
}

Result<Program> ProbeBench::program(std::string_view fragment, std::string_view extensionLine) {
  constexpr std::string_view kVertex =
      "attribute vec2 a_position;\n"
      "uniform float u_z;\n"
      "void main() { gl_Position = vec4(a_position, u_z, 1.0); }\n";
  return programOf(kVertex, std::string(extensionLine) + std::string(fragment));
}

Result<Program> ProbeBench::programOf(std::string_view vertex, std::string_view fragment) {
  const std::string version = "#version 100\n";
  const std::string fragmentSource = version + std::string(fragment);
  return Program::link(context(), version + std::string(vertex), fragmentSource,
                       samplerNamesOf(fragmentSource), "probe");
}

void ProbeBench::clear(const Framebuffer& framebuffer, const glm::vec4& color) {
  PassBegin pass{.framebuffer = &framebuffer, .viewport = {0, 0, framebuffer.width(), framebuffer.height()}};
  pass.clear = {.color = color, .depth = 1.0f, .stencil = 0};
  encoder_.beginPass(pass);
  encoder_.endPass({});
}

void ProbeBench::draw(const Framebuffer& framebuffer, Program& program, const Rect& rect,
                      const DrawState& state) {
  encoder_.beginPass({.framebuffer = &framebuffer, .viewport = rect});
  encoder_.useProgram(program);
  // The triangle reaches past the viewport; guard bands may draw there without a scissor.
  DrawState scissored = state;
  scissored.scissor = rect;
  encoder_.drawFullscreen(scissored);
  encoder_.endPass({});
}

ProbeBench::Pixel ProbeBench::read(const Framebuffer& framebuffer, int x, int y) {
  Pixel pixel{};
  encoder_.readPixels(framebuffer, {x, y, 1, 1}, pixel.data());
  return pixel;
}

std::string pixelText(const ProbeBench::Pixel& pixel) {
  return std::to_string(pixel[0]) + "," + std::to_string(pixel[1]) + "," + std::to_string(pixel[2]) + "," +
         std::to_string(pixel[3]);
}

}  // namespace halfshadow::gl
