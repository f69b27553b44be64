// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "program_layer.hpp"

#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "engine_fixture.hpp"
#include "gl/functions.hpp"

namespace halfshadow::test {
namespace {
struct State {
  gl::Functions driver;
  std::map<GLuint, std::string> shaders;
  struct Stages {
    std::string vertex, fragment;
  };
  std::map<GLuint, Stages> programs;
  GLuint current = 0;
  bool blend = false;
  GLenum source = GL_ONE, destination = GL_ZERO, equation = GL_FUNC_ADD;
  DropRule rule;
  std::set<DrawnProgram> drawn;
  std::uint64_t droppedDraws = 0, readBacks = 0;
};
State* layer = nullptr;

std::string blendText() {
  if (!layer->blend) return {};
  std::ostringstream text;
  text << std::hex << layer->source << " " << layer->destination << " " << layer->equation;
  return text.str();
}

/// Whether the driver shall draw.
bool draws() {
  const auto found = layer->programs.find(layer->current);
  if (found == layer->programs.end()) return true;
  const DrawnProgram program{found->second.vertex, found->second.fragment, blendText()};
  layer->drawn.insert(program);
  if (!layer->rule || !layer->rule(program)) return true;
  ++layer->droppedDraws;
  return false;
}

void GL_APIENTRY shaderSource(GLuint shader, GLsizei count, const GLchar* const* texts,
                              const GLint* lengths) {
  std::string& source = layer->shaders[shader];
  source.clear();
  for (GLsizei i = 0; i < count; ++i)
    source += lengths ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : std::string(texts[i]);
  layer->driver.shaderSource(shader, count, texts, lengths);
}
void GL_APIENTRY attachShader(GLuint program, GLuint shader) {
  const std::string& source = layer->shaders[shader];
  State::Stages& stages = layer->programs[program];
  (source.find("gl_FragColor") != std::string::npos ? stages.fragment : stages.vertex) = source;
  layer->driver.attachShader(program, shader);
}
void GL_APIENTRY useProgram(GLuint program) {
  layer->current = program;
  layer->driver.useProgram(program);
}
void GL_APIENTRY enable(GLenum what) {
  if (what == GL_BLEND) layer->blend = true;
  layer->driver.enable(what);
}
void GL_APIENTRY disable(GLenum what) {
  if (what == GL_BLEND) layer->blend = false;
  layer->driver.disable(what);
}
void GL_APIENTRY blendFuncSeparate(GLenum source, GLenum destination, GLenum sourceAlpha,
                                   GLenum destinationAlpha) {
  layer->source = source;
  layer->destination = destination;
  layer->driver.blendFuncSeparate(source, destination, sourceAlpha, destinationAlpha);
}
void GL_APIENTRY blendEquationSeparate(GLenum color, GLenum alpha) {
  layer->equation = color;
  layer->driver.blendEquationSeparate(color, alpha);
}
void GL_APIENTRY drawArrays(GLenum mode, GLint first, GLsizei count) {
  if (draws()) layer->driver.drawArrays(mode, first, count);
}
void GL_APIENTRY drawElements(GLenum mode, GLsizei count, GLenum type, const void* indices) {
  if (draws()) layer->driver.drawElements(mode, count, type, indices);
}
void GL_APIENTRY readPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
                            void* pixels) {
  ++layer->readBacks;
  layer->driver.readPixels(x, y, width, height, format, type, pixels);
}

void* load(const char* name, void* user) {
  void* driver = static_cast<HeadlessContext*>(user)->getProcAddress(name);
  const std::string_view wanted(name);
#define HALFSHADOW_LAYER(glName, function) \
  if (wanted == glName) return reinterpret_cast<void*>(&function);
  HALFSHADOW_LAYER("glShaderSource", shaderSource)
  HALFSHADOW_LAYER("glAttachShader", attachShader)
  HALFSHADOW_LAYER("glUseProgram", useProgram)
  HALFSHADOW_LAYER("glEnable", enable)
  HALFSHADOW_LAYER("glDisable", disable)
  HALFSHADOW_LAYER("glBlendFuncSeparate", blendFuncSeparate)
  HALFSHADOW_LAYER("glBlendEquationSeparate", blendEquationSeparate)
  HALFSHADOW_LAYER("glDrawArrays", drawArrays)
  HALFSHADOW_LAYER("glDrawElements", drawElements)
  HALFSHADOW_LAYER("glReadPixels", readPixels)
#undef HALFSHADOW_LAYER
  return driver;
}
}  // namespace

std::string DrawnProgram::file() const {
  constexpr std::string_view kMark = "// shaders_es2/";
  const std::size_t at = fragment.find(kMark);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + kMark.size();
  return fragment.substr(begin, fragment.find('\n', begin) - begin);
}

std::string DrawnProgram::defines() const {
  std::istringstream lines(fragment.substr(0, fragment.find("precision ")));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kDefine = "#define HS_";
    if (!line.starts_with(kDefine) || line.starts_with("#define HS_LAST_COLOR")) continue;
    line = line.substr(kDefine.size(), 40);
    if (line.ends_with(" 1") && line.find("SUB_LIGHTS") == std::string::npos) line.resize(line.size() - 2);
    text += (text.empty() ? "" : " ") + line;
  }
  return text;
}

ProgramLayer::ProgramLayer() {
  layer = new State;
  layer->driver = hostGl();
}
ProgramLayer::~ProgramLayer() {
  delete layer;
  layer = nullptr;
}

std::unique_ptr<Engine> ProgramLayer::makeEngine(EngineDesc desc) {
  Outcome outcome;
  desc.getProcAddress = load;
  desc.getProcAddressUser = headless();
  std::unique_ptr<Engine> engine(Engine::create(desc, outcome));
  EXPECT_TRUE(outcome.ok()) << outcome.message;
  return engine;
}
void ProgramLayer::drop(DropRule rule) {
  layer->rule = std::move(rule);
}
std::vector<DrawnProgram> ProgramLayer::takeDrawn() {
  std::vector<DrawnProgram> drawn(layer->drawn.begin(), layer->drawn.end());
  layer->drawn.clear();
  return drawn;
}
std::uint64_t ProgramLayer::droppedDraws() const {
  return layer->droppedDraws;
}
std::uint64_t ProgramLayer::readBacks() const {
  return layer->readBacks;
}

}  // namespace halfshadow::test
