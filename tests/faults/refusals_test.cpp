// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What no host may send, from C++ and from C; and what may look odd but is valid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine_fixture.hpp"
#include "halfshadow/halfshadow.h"

namespace halfshadow::test {
namespace {
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Refusals : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (HasFatalFailure()) return;
    renderer_ = std::make_unique<SceneRenderer>(makeEngine());
    renderer_->load(builtinScene("box@light=0.3"));
    renderer_->choose({"hard"});
  }
  void TearDown() override {
    renderer_.reset();
    EngineTest::TearDown();
  }
  Engine& engine() { return renderer_->engine(); }
  SceneRenderer& renderer() { return *renderer_; }
  static void expectRefused(const Outcome& outcome, ErrorCode code = ErrorCode::invalidArgument) {
    EXPECT_EQ(outcome.code, code) << outcome.message;
    EXPECT_GE(std::string(outcome.message).size(), 15u);
  }

 private:
  std::unique_ptr<SceneRenderer> renderer_;
};

TEST_F(Refusals, NullsEnumsIndicesAndNans) {
  const Image good = renderer().render();
  expectRefused(engine().setTransform(renderer().id(0), nullptr));
  expectRefused(engine().setLights(nullptr, 1));
  expectRefused(engine().bindForward(0, 1, nullptr, 0));
  EXPECT_STREQ(engine().technique(9999).id, "");
  EXPECT_STREQ(engine().setting(9999).key, "");
  EXPECT_STREQ(engine().capability(9999).name, "");
  EXPECT_STREQ(engine().extension(99999), "");
  RenderDesc desc = renderer().desc();
  for (int which = 0; which < 6; ++which) {
    desc = renderer().desc();
    if (which == 0) desc.output = static_cast<Output>(77);
    if (which == 1) desc.timing = static_cast<Timing>(-1);
    if (which == 2) desc.target.kind = static_cast<TargetDesc::Kind>(5);
    if (which == 3) desc.receivers = static_cast<Receivers>(9);
    if (which == 4) desc.clearColor[2] = std::numeric_limits<float>::quiet_NaN();
    if (which == 5) desc.target.x = std::numeric_limits<int>::max();
    expectRefused(engine().render(desc));
  }
  expectRefused(engine().trim(static_cast<Trim>(4)));
  ObjectDesc object = objectDesc(builtinScene("box@light=0.3").objects[0]);
  object.baseColor[1] = std::numeric_limits<float>::infinity();
  ObjectId id = 0;
  expectRefused(engine().addObject(object, id));
  object = objectDesc(builtinScene("box@light=0.3").objects[0]);
  const std::uint8_t pixel[4] = {};
  object.baseColorPixels = pixel;
  object.baseColorWidth = object.baseColorHeight = 1 << 30;
  expectRefused(engine().addObject(object, id));
  Outcome outcome;
  const char* names[] = {nullptr};
  const auto load = [](const char* name, void*) { return headless()->getProcAddress(name); };
  EXPECT_EQ(Engine::create({.getProcAddress = load, .forcedOff = names, .forcedOffCount = 1}, outcome),
            nullptr);
  expectRefused(outcome);
  EXPECT_EQ(Engine::create({.getProcAddress = load, .forcedOffCount = 3}, outcome), nullptr);
  expectRefused(outcome);
  EXPECT_EQ(Engine::create({.getProcAddress = load, .hostState = static_cast<HostState>(8)}, outcome),
            nullptr);
  expectRefused(outcome);
  EXPECT_EQ(renderer().render().rgba, good.rgba);
}

// Beyond 1e30 products of places leave double precision: NaN, which compares as nothing does.
TEST_F(Refusals, WhatLiesBeyondAllArithmetic) {
  const Image good = renderer().render();
  glm::dmat4 far(1.0);
  far[3].x = 1e200;
  expectRefused(engine().setTransform(renderer().id(0), &far[0][0]));
  far = glm::dmat4(1e31);
  far[3][3] = 1.0;
  expectRefused(engine().setTransform(renderer().id(0), &far[0][0]));
  ObjectDesc object = objectDesc(builtinScene("box@light=0.3").objects[0]);
  object.worldFromObject[13] = -1e31;
  ObjectId id = 0;
  expectRefused(engine().addObject(object, id));
  std::vector<float> positions(std::size_t{3} * object.mesh.vertexCount, 3e38f);
  object.mesh.positions = positions.data();
  expectRefused(engine().setVertices(renderer().id(0), object.mesh));
  LightDesc light = lightDesc(builtinScene("box@light=0.3").lights[0]);
  light.center[2] = 1e150;
  expectRefused(engine().setLights(&light, 1), ErrorCode::invalidLight);
  light.center[2] = 0.0;
  light.halfU[0] = 1e155;
  expectRefused(engine().setLights(&light, 1), ErrorCode::invalidLight);
  RenderDesc desc = renderer().desc();
  desc.camera.eye[0] = 1e160;
  expectRefused(engine().render(desc), ErrorCode::invalidCamera);
  EXPECT_EQ(renderer().render().rgba, good.rgba) << "a refusal changes nothing";
}

TEST_F(Refusals, IntegersAreWrittenAsIntegers) {
  for (const char* text : {"7.0", "1e1", "010", "+7", " 7", "7 ", "0x7", "", "-", "7;"})
    expectRefused(engine().set("pcf.size", text));
  EXPECT_TRUE(engine().set("pcf.size", "7").ok());
  EXPECT_TRUE(engine().set("bias", "1e0").ok()) << "reals are written as anyone likes";
}

TEST_F(Refusals, NothingToDrawIsDrawn) {
  const Image shadowed = renderer().render();
  renderer().setLights({});
  const Image unlit = renderer().render();
  EXPECT_NE(unlit.rgba, shadowed.rgba);
  EXPECT_TRUE(std::ranges::all_of(unlit.rgba, [](std::uint8_t v) { return v == 255; }));
  renderer().render(Output::shaded);
  SceneRenderer empty(makeEngine());
  empty.desc() = renderer().desc();
  for (const Output output : {Output::shaded, Output::visibility, Output::visibility16, Output::taps}) {
    const Image image = empty.render(output);
    EXPECT_TRUE(std::ranges::equal(std::span(image.rgba).first(4), std::span(image.rgba).last(4)));
  }
  empty.setLights(builtinScene("box@light=0.3").lights);
  empty.render();
  empty.desc().output = Output::lightsOnly;
  EXPECT_TRUE(empty.engine().render(empty.desc()).ok());
  renderer().setLights(builtinScene("box@light=0.3").lights);
  EXPECT_EQ(renderer().render().rgba, shadowed.rgba);
}

TEST_F(Refusals, FramebuffersThatCannotHoldAFrame) {
  const gl::Functions& gl = hostGl();
  RenderDesc desc = renderer().desc();
  desc.target.kind = TargetDesc::Kind::host;
  desc.target.framebuffer = 4711;
  expectRefused(engine().render(desc));
  EXPECT_FALSE(gl.isFramebuffer(4711));
  GLuint texture = 0, framebuffer = 0;
  gl.genTextures(1, &texture);
  gl.bindTexture(GL_TEXTURE_2D, texture);
  gl.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA, kWidth, kHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl.genFramebuffers(1, &framebuffer);
  gl.bindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  desc.target.framebuffer = framebuffer;
  expectRefused(engine().render(desc));  // nothing is attached
  gl.framebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  const Outcome noDepth = engine().render(desc);
  expectRefused(noDepth);
  EXPECT_NE(std::string(noDepth.message).find("depth"), std::string::npos) << noDepth.message;
  gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.bindTexture(GL_TEXTURE_2D, 0);
  gl.deleteFramebuffers(1, &framebuffer);
  gl.deleteTextures(1, &texture);
}

TEST_F(Refusals, AHostsPendingErrorsStayTheHosts) {
  const gl::Functions& gl = hostGl();
  const ObjectDesc object = objectDesc(builtinScene("box@light=0.3").objects[0]);
  const auto raise = [&](GLenum error) {
    if (error == GL_INVALID_ENUM) gl.enable(0x7fffffff);
    if (error == GL_INVALID_VALUE) gl.viewport(0, 0, -1, -1);
    if (error == GL_INVALID_OPERATION) gl.uniform1i(0x7ffffff0, 0);
  };
  for (const GLenum error : {GL_INVALID_ENUM, GL_INVALID_VALUE, GL_INVALID_OPERATION}) {
    const auto pending = [&](const char* after) {
      EXPECT_EQ(gl.getError(), static_cast<GLenum>(error)) << after;
      EXPECT_EQ(gl.getError(), static_cast<GLenum>(GL_NO_ERROR)) << after;
    };
    raise(error);
    ObjectId id = 0;
    EXPECT_TRUE(engine().addObject(object, id).ok());
    pending("addObject");
    raise(error);
    EXPECT_TRUE(engine().render(renderer().desc()).ok());
    pending("render");
    raise(error);
    std::vector<std::uint8_t> pixels(4 * kWidth * kHeight);
    EXPECT_TRUE(engine().readOutput(pixels.data(), pixels.size()).ok());
    pending("readOutput");
    raise(error);
    { auto another = makeEngine(); }
    pending("create and destroy");
    EXPECT_TRUE(engine().removeObject(id).ok());
  }
}

TEST_F(Refusals, UnlikeLightsHaveAttenuationTexturesOfTheirOwn) {
  const Configuration paper{"shadow-width",
                            {{"shadow-width.preset", "paper"}, {"shadow-width.attenuation", "texture"}}};
  std::vector<scene::AreaLight> two = builtinScene("box@light=0.3").lights;
  two.push_back(two.front());
  two[1].centerWorld.x += 4.0;
  two[1].halfU *= 3.0;
  two[1].halfV *= 3.0;
  renderer().setLights(two);
  const Image both = renderer().render(paper);
  for (std::size_t i = 0; i < 2; ++i) {
    renderer().setLights({two[i]});
    const Image alone = renderer().render();
    std::size_t differing = 0, dark = 0;
    for (std::size_t p = 0; p < both.pixels(); ++p) {
      differing += both.byte(p, static_cast<int>(i)) != alone.byte(p);
      dark += alone.byte(p) < 128;
    }
    EXPECT_EQ(differing, 0u) << "light " << i;
    EXPECT_GT(dark, 100u);
  }
}

TEST_F(Refusals, FromC) {
  HalfshadowEngineDesc desc = {};
  desc.struct_size = sizeof desc;
  desc.get_proc_address = [](const char* name, void*) { return headless()->getProcAddress(name); };
  HalfshadowError error = HALFSHADOW_OK;
  desc.host_state = static_cast<HalfshadowHostState>(9);
  EXPECT_EQ(halfshadow_create(&desc, &error, nullptr), nullptr);
  EXPECT_EQ(error, HALFSHADOW_INVALID_ARGUMENT);
  desc.host_state = HALFSHADOW_RESTORE_STATE;
  HalfshadowEngine* made = halfshadow_create(&desc, nullptr, nullptr);
  ASSERT_NE(made, nullptr);
  const double nan[16] = {kNan};
  HalfshadowObjectDesc object = {};
  HalfshadowLightDesc light = {};
  HalfshadowRenderDesc frame = {};
  std::uint32_t id = 0;
  for (HalfshadowEngine* engine : {made, static_cast<HalfshadowEngine*>(nullptr)}) {
    EXPECT_NE(halfshadow_add_object(engine, nullptr, &id), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_add_object(engine, &object, &id), HALFSHADOW_OK);
    object.struct_size = sizeof object;
    EXPECT_NE(halfshadow_add_object(engine, &object, nullptr), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_add_object(engine, &object, &id), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_set_transform(engine, 3, nullptr), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_set_transform(engine, 3, nan), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_remove_object(engine, 77), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_set_lights(engine, nullptr, 1), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_set_lights(engine, &light, ~std::size_t{0}), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_set_technique(engine, nullptr), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_set(engine, nullptr, nullptr), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_render(engine, nullptr, nullptr), HALFSHADOW_OK);
    frame.struct_size = sizeof frame;
    EXPECT_NE(halfshadow_render(engine, &frame, nullptr), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_read_output(engine, nullptr, 0), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_trim(engine, static_cast<HalfshadowTrim>(7)), HALFSHADOW_OK);
    EXPECT_EQ(halfshadow_output_texture(engine), 0u);
    EXPECT_NE(halfshadow_program_proofs(engine), nullptr);
    EXPECT_NE(halfshadow_context_restored(nullptr), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_set_memory_limit(nullptr, 1), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_read_output(engine, nullptr, 0), HALFSHADOW_OK);
    EXPECT_NE(halfshadow_message(engine), nullptr);
    if (engine) {
      EXPECT_NE(std::string(halfshadow_message(engine)), "");
    }
  }
  EXPECT_EQ(halfshadow_set_memory_limit(made, 1 << 20), HALFSHADOW_OK);
  EXPECT_EQ(halfshadow_trim(made, HALFSHADOW_TRIM_EVERYTHING), HALFSHADOW_OK);
  EXPECT_EQ(halfshadow_set_lights(made, nullptr, 0), HALFSHADOW_OK);
  halfshadow_context_lost(made);
  EXPECT_EQ(halfshadow_context_restored(made), HALFSHADOW_OK);
  halfshadow_context_lost(nullptr);
  halfshadow_destroy(made);
  halfshadow_destroy(nullptr);
}

}  // namespace
}  // namespace halfshadow::test
