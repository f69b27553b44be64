// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A host on a later version of OpenGL ES: each piece of its state is poisoned alone, and neither changes the
// picture nor is changed.
#include <gtest/gtest.h>

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

GLint integer(GLenum name) {
  GLint value = 0;
  hostGl().getIntegerv(name, &value);
  return value;
}

struct Poison {
  const char* name;
  std::function<void()> set, clear;
  std::function<GLint()> found;
};

std::vector<Poison> poisons() {
  const gl::Functions& gl = hostGl();
  static GLuint sampler = 0, vertexArray = 0, buffer = 0, framebuffer = 0;
  const auto genSamplers = entry<GenNames>("glGenSamplers"),
             genVertexArrays = entry<GenNames>("glGenVertexArrays"),
             deleteVertexArrays = entry<GenNames>("glDeleteVertexArrays"),
             deleteSamplers = entry<GenNames>("glDeleteSamplers");
  const auto bindVertexArray = entry<BindName>("glBindVertexArray");
  const auto bindSampler = entry<BindPair>("glBindSampler"),
             divisor = entry<BindPair>("glVertexAttribDivisor");
  const auto samplerParameter = entry<SamplerParameter>("glSamplerParameteri");
  const auto pixelStore = [&gl](const char* name, GLenum store) {
    return Poison{name, [&gl, store] { gl.pixelStorei(store, 3); },
                  [&gl, store] { gl.pixelStorei(store, 0); }, [store] { return integer(store); }};
  };
  const auto flag = [&gl](const char* name, GLenum which) {
    return Poison{name, [&gl, which] { gl.enable(which); }, [&gl, which] { gl.disable(which); },
                  [&gl, which] { return static_cast<GLint>(gl.isEnabled(which)); }};
  };
  const auto boundBuffer = [&gl](const char* name, GLenum target, GLenum binding) {
    return Poison{name,
                  [&gl, target] {
                    gl.genBuffers(1, &buffer);
                    gl.bindBuffer(target, buffer);
                    gl.bufferData(target, 64, nullptr, GL_STATIC_DRAW);
                  },
                  [&gl, target] {
                    gl.bindBuffer(target, 0);
                    gl.deleteBuffers(1, &buffer);
                  },
                  [binding] { return integer(binding); }};
  };
  std::vector<Poison> all;
  for (GLuint unit = 0; unit < 4; ++unit) {
    all.push_back({"sampler object",
                   [=] {
                     genSamplers(1, &sampler);
                     samplerParameter(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
                     samplerParameter(sampler, GL_TEXTURE_WRAP_S, GL_REPEAT);
                     bindSampler(unit, sampler);
                   },
                   [=] { deleteSamplers(1, &sampler); },
                   [&gl, unit] {
                     gl.activeTexture(GL_TEXTURE0 + unit);
                     const GLint bound = integer(0x8919);
                     gl.activeTexture(GL_TEXTURE0);
                     return bound;
                   }});
  }
  all.push_back({"vertex array object",
                 [=] {
                   genVertexArrays(1, &vertexArray);
                   bindVertexArray(vertexArray);
                 },
                 [=] {
                   bindVertexArray(0);
                   deleteVertexArrays(1, &vertexArray);
                 },
                 [] { return integer(0x85B5); }});
  all.push_back({"attribute divisor", [=] { divisor(0, 1); }, [=] { divisor(0, 0); },
                 [&gl] {
                   GLint value = 0;
                   gl.getVertexAttribiv(0, 0x88FE, &value);
                   return value;
                 }});
  all.push_back({"read framebuffer",
                 [&gl] {
                   gl.genFramebuffers(1, &framebuffer);
                   gl.bindFramebuffer(0x8CA8, framebuffer);
                 },
                 [&gl] { gl.deleteFramebuffers(1, &framebuffer); }, [] { return integer(0x8CAA); }});
  all.push_back(boundBuffer("pixel unpack buffer", 0x88EC, 0x88EF));
  all.push_back(boundBuffer("pixel pack buffer", 0x88EB, 0x88ED));
  all.push_back(pixelStore("unpack row length", 0x0CF2));
  all.push_back(pixelStore("unpack skip rows", 0x0CF3));
  all.push_back(pixelStore("unpack skip pixels", 0x0CF4));
  all.push_back(pixelStore("pack row length", 0x0D02));
  all.push_back(pixelStore("pack skip rows", 0x0D03));
  all.push_back(pixelStore("pack skip pixels", 0x0D04));
  all.push_back(flag("rasterizer discard", 0x8C89));
  all.push_back(flag("primitive restart", 0x8D69));
  return all;
}

class LaterState : public EngineTest, public testing::WithParamInterface<HostState> {};

TEST_P(LaterState, IsKnownAtEntryAndRestoredAtExit) {
  const std::string version(reinterpret_cast<const char*>(hostGl().getString(GL_VERSION)));
  if (version.find("OpenGL ES 3") == std::string::npos) GTEST_SKIP() << "the context is " << version;
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
  for (const Poison& poison : poisons()) {
    poison.set();
    const GLint before = poison.found();
    EXPECT_NE(before, 0) << poison.name << " is not poisoned";
    EXPECT_EQ(draw(), wanted) << poison.name;
    if (GetParam() == HostState::restore) {
      EXPECT_EQ(poison.found(), before) << poison.name;
    }
    if (GetParam() == HostState::leaveDefaults) {
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
