// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A host on a later version of OpenGL ES: each piece of its state is poisoned alone, and neither changes the
// picture nor is changed.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

// Of OpenGL ES 3.0, whose header the engine does without.
template <typename Function>
Function entry(const char* name) {
  return reinterpret_cast<Function>(headless()->getProcAddress(name));
}
using GenNames = void(GL_APIENTRYP)(GLsizei, GLuint*);
using BindName = void(GL_APIENTRYP)(GLuint);
using BindPair = void(GL_APIENTRYP)(GLuint, GLuint);
using SamplerParameter = void(GL_APIENTRYP)(GLuint, GLenum, GLint);
using BindBase = void(GL_APIENTRYP)(GLenum, GLuint, GLuint);
using FeedbackVaryings = void(GL_APIENTRYP)(GLuint, GLsizei, const char* const*, GLenum);
using BeginFeedback = void(GL_APIENTRYP)(GLenum);
using EndFeedback = void(GL_APIENTRYP)();
using MapRange = void*(GL_APIENTRYP)(GLenum, GLintptr, GLsizeiptr, GLbitfield);
using Unmap = GLboolean(GL_APIENTRYP)(GLenum);

bool isVersion3() {
  const std::string version(reinterpret_cast<const char*>(hostGl().getString(GL_VERSION)));
  return version.find("OpenGL ES 3") != std::string::npos;
}

bool advertises(const std::string& extension) {
  const std::string all(reinterpret_cast<const char*>(hostGl().getString(GL_EXTENSIONS)));
  return (" " + all + " ").find(" " + extension + " ") != std::string::npos;
}

GLint integer(GLenum name) {
  GLint value = 0;
  hostGl().getIntegerv(name, &value);
  return value;
}

struct Poison {
  const char* name;
  std::function<void()> set, clear;
  std::function<GLint()> found;
  /// It cannot change what the engine draws: the engine leaves it as it is, whatever the policy.
  bool harmless = false;
};

Poison pixelStore(const char* name, GLenum store) {
  return {name, [store] { hostGl().pixelStorei(store, 3); }, [store] { hostGl().pixelStorei(store, 0); },
          [store] { return integer(store); }};
}

Poison flag(const char* name, GLenum which) {
  return {name, [which] { hostGl().enable(which); }, [which] { hostGl().disable(which); },
          [which] { return static_cast<GLint>(hostGl().isEnabled(which)); }};
}

Poison boundBuffer(const char* name, GLenum target, GLenum binding, bool harmless = false) {
  static GLuint buffer = 0;
  return {name,
          [target] {
            hostGl().genBuffers(1, &buffer);
            hostGl().bindBuffer(target, buffer);
            hostGl().bufferData(target, 64, nullptr, GL_STATIC_DRAW);
          },
          [target] {
            hostGl().bindBuffer(target, 0);
            hostGl().deleteBuffers(1, &buffer);
          },
          [binding] { return integer(binding); }, harmless};
}

Poison samplerObject(GLuint unit) {
  static GLuint sampler = 0;
  return {"sampler object",
          [unit] {
            entry<GenNames>("glGenSamplers")(1, &sampler);
            const auto parameter = entry<SamplerParameter>("glSamplerParameteri");
            parameter(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
            parameter(sampler, GL_TEXTURE_WRAP_S, GL_REPEAT);
            entry<BindPair>("glBindSampler")(unit, sampler);
          },
          [] { entry<GenNames>("glDeleteSamplers")(1, &sampler); },
          [unit] {
            hostGl().activeTexture(GL_TEXTURE0 + unit);
            const GLint bound = integer(0x8919);
            hostGl().activeTexture(GL_TEXTURE0);
            return bound;
          }};
}

Poison vertexArray(const std::string& suffix) {
  static GLuint name = 0;
  return {"vertex array object",
          [suffix] {
            entry<GenNames>(("glGenVertexArrays" + suffix).c_str())(1, &name);
            entry<BindName>(("glBindVertexArray" + suffix).c_str())(name);
          },
          [suffix] {
            entry<BindName>(("glBindVertexArray" + suffix).c_str())(0);
            entry<GenNames>(("glDeleteVertexArrays" + suffix).c_str())(1, &name);
          },
          [] { return integer(0x85B5); }};
}

Poison attributeDivisor(const std::string& suffix) {
  const auto divisor = entry<BindPair>(("glVertexAttribDivisor" + suffix).c_str());
  return {"attribute divisor", [=] { divisor(0, 1); }, [=] { divisor(0, 0); },
          [] {
            GLint value = 0;
            hostGl().getVertexAttribiv(0, 0x88FE, &value);
            return value;
          }};
}

Poison readFramebuffer() {
  static GLuint framebuffer = 0;
  return {"read framebuffer",
          [] {
            hostGl().genFramebuffers(1, &framebuffer);
            hostGl().bindFramebuffer(0x8CA8, framebuffer);
          },
          [] { hostGl().deleteFramebuffers(1, &framebuffer); }, [] { return integer(0x8CAA); }};
}

GLuint feedbackProgram() {
  const gl::Functions& gl = hostGl();
  const GLuint program = gl.createProgram();
  for (const auto& [stage, text] :
       {std::pair<GLenum, const char*>{GL_VERTEX_SHADER,
                                       "#version 300 es\nout vec4 caught;\nvoid main() { caught = "
                                       "vec4(1.0); gl_Position = vec4(0.0); }\n"},
        {GL_FRAGMENT_SHADER,
         "#version 300 es\nprecision mediump float;\nout vec4 color;\nvoid main() { color = vec4(1.0); "
         "}\n"}}) {
    const GLuint shader = gl.createShader(stage);
    gl.shaderSource(shader, 1, &text, nullptr);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader);
  }
  const char* caught = "caught";
  entry<FeedbackVaryings>("glTransformFeedbackVaryings")(program, 1, &caught, 0x8C8C);
  gl.linkProgram(program);
  return program;
}

/// Runs while the engine works, which shall leave no vertex of its own in the host's buffer.
Poison transformFeedback() {
  static GLuint program = 0, buffer = 0;
  static const std::vector<std::uint8_t> kept(4096, 77);
  constexpr GLenum kTarget = 0x8C8E;
  return {"transform feedback",
          [] {
            hostGl().genBuffers(1, &buffer);
            hostGl().bindBuffer(kTarget, buffer);
            hostGl().bufferData(kTarget, static_cast<GLsizeiptr>(kept.size()), kept.data(), GL_STATIC_DRAW);
            entry<BindBase>("glBindBufferBase")(kTarget, 0, buffer);
            program = feedbackProgram();
            hostGl().useProgram(program);
            entry<BeginFeedback>("glBeginTransformFeedback")(GL_TRIANGLES);
          },
          [] {
            entry<EndFeedback>("glEndTransformFeedback")();
            hostGl().bindBuffer(kTarget, buffer);
            const void* found = entry<MapRange>("glMapBufferRange")(
                kTarget, 0, static_cast<GLsizeiptr>(kept.size()), 1 /* to read */);
            ASSERT_NE(found, nullptr);
            EXPECT_EQ(std::memcmp(found, kept.data(), kept.size()), 0) << "the engine's vertices were caught";
            entry<Unmap>("glUnmapBuffer")(kTarget);
            entry<BindBase>("glBindBufferBase")(kTarget, 0, 0);
            hostGl().bindBuffer(kTarget, 0);
            hostGl().deleteBuffers(1, &buffer);
            hostGl().useProgram(0);
            hostGl().deleteProgram(program);
          },
          [] { return static_cast<GLint>(integer(0x8E24) != 0 && integer(0x8E23) == 0); }};
}

std::vector<Poison> poisonsOfVersion3() {
  std::vector<Poison> all;
  for (GLuint unit = 0; unit < 4; ++unit) all.push_back(samplerObject(unit));
  all.push_back(vertexArray(""));
  all.push_back(attributeDivisor(""));
  all.push_back(readFramebuffer());
  all.push_back(boundBuffer("pixel unpack buffer", 0x88EC, 0x88EF));
  all.push_back(boundBuffer("pixel pack buffer", 0x88EB, 0x88ED));
  all.push_back(boundBuffer("uniform buffer", 0x8A11, 0x8A28, true));
  all.push_back(pixelStore("unpack row length", 0x0CF2));
  all.push_back(pixelStore("unpack skip rows", 0x0CF3));
  all.push_back(pixelStore("unpack skip pixels", 0x0CF4));
  all.push_back(pixelStore("pack row length", 0x0D02));
  all.push_back(pixelStore("pack skip rows", 0x0D03));
  all.push_back(pixelStore("pack skip pixels", 0x0D04));
  all.push_back(flag("rasterizer discard", 0x8C89));
  all.push_back(flag("primitive restart", 0x8D69));
  all.push_back(transformFeedback());
  return all;
}

/// What extensions of 2.0 have of it.
std::vector<Poison> poisonsOfExtensions() {
  std::vector<Poison> all;
  if (advertises("GL_OES_vertex_array_object")) all.push_back(vertexArray("OES"));
  if (advertises("GL_EXT_instanced_arrays"))
    all.push_back(attributeDivisor("EXT"));
  else if (advertises("GL_ANGLE_instanced_arrays"))
    all.push_back(attributeDivisor("ANGLE"));
  if (advertises("GL_EXT_unpack_subimage")) {
    all.push_back(pixelStore("unpack row length", 0x0CF2));
    all.push_back(pixelStore("unpack skip rows", 0x0CF3));
    all.push_back(pixelStore("unpack skip pixels", 0x0CF4));
  }
  if (advertises("GL_NV_pack_subimage")) {
    all.push_back(pixelStore("pack row length", 0x0D02));
    all.push_back(pixelStore("pack skip rows", 0x0D03));
    all.push_back(pixelStore("pack skip pixels", 0x0D04));
  }
  return all;
}

class LaterState : public EngineTest, public testing::WithParamInterface<HostState> {};

TEST_P(LaterState, IsKnownAtEntryAndRestoredAtExit) {
  const std::vector<Poison> poisons = isVersion3() ? poisonsOfVersion3() : poisonsOfExtensions();
  if (poisons.empty()) GTEST_SKIP() << "the context has none of it";
  // Uploads textures and buffers, filters, draws with indices, reads back.
  const Configuration chosen{"wedges-cells", {}};
  std::vector<std::uint8_t> pixels(8 * 8 * 4, 90);
  const auto draw = [&] {
    SceneRenderer renderer(makeEngine({}, GetParam()));
    renderer.load(builtinScene("box@light=0.3"));
    ObjectDesc colored = objectDesc(builtinScene("box@light=0.3").objects.back());
    colored.baseColorPixels = pixels.data();
    colored.baseColorWidth = colored.baseColorHeight = 8;
    ObjectId id = 0;
    EXPECT_TRUE(renderer.engine().addObject(colored, id).ok());
    auto image = renderer.render(chosen, Output::shaded);
    const Image maps = renderer.render(Configuration{"pcss-mip"});
    image.rgba.insert(image.rgba.end(), maps.rgba.begin(), maps.rgba.end());
    return image.rgba;
  };
  const auto wanted = draw();
  for (const Poison& poison : poisons) {
    poison.set();
    const GLint before = poison.found();
    EXPECT_NE(before, 0) << poison.name << " is not poisoned";
    EXPECT_EQ(draw(), wanted) << poison.name;
    if (GetParam() == HostState::restore || poison.harmless) {
      EXPECT_EQ(poison.found(), before) << poison.name;
    }
    if (GetParam() == HostState::leaveDefaults && !poison.harmless) {
      EXPECT_EQ(poison.found(), 0) << poison.name;
    }
    poison.clear();
    EXPECT_EQ(hostGl().getError(), static_cast<GLenum>(GL_NO_ERROR)) << poison.name;
  }
}
INSTANTIATE_TEST_SUITE_P(Policies, LaterState,
                         testing::Values(HostState::restore, HostState::leaveDefaults,
                                         HostState::leaveDirty));

}  // namespace
}  // namespace halfshadow::test
