// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Frames in which nothing changed, or one object did.
#include <gtest/gtest.h>

#include "analytic_scenes.hpp"
#include "counted_gl.hpp"
#include "counted_memory.hpp"
#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

struct Spent {
  std::uint64_t calls = 0, allocations = 0;
};

class Unchanged : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    renderer_ = std::make_unique<SceneRenderer>(makeCountedEngine());
    renderer_->load(builtinScene("figure@light=0.3"));
  }
  void TearDown() override {
    renderer_.reset();
    EngineTest::TearDown();
  }
  SceneRenderer& renderer() { return *renderer_; }
  Engine& engine() { return renderer_->engine(); }
  Spent render() {
    const Spent before{glCallCount(), allocationCount()};
    const Outcome outcome = engine().render(renderer().desc());
    const Spent spent{glCallCount() - before.calls, allocationCount() - before.allocations};
    EXPECT_TRUE(outcome.ok()) << outcome.message;
    return spent;
  }
  std::vector<std::string> techniques() { return techniquesBut(engine(), {}); }

 private:
  std::unique_ptr<SceneRenderer> renderer_;
};

TEST_F(Unchanged, IsFreeForEveryTechnique) {
  for (const std::string& technique : techniques()) {
    SCOPED_TRACE(technique);
    const Image first = renderer().render(Configuration{technique});
    EXPECT_GT(renderer().report().passes.size(), 0u);
    const Spent spent = render();
    EXPECT_EQ(spent.calls, 0u);
    EXPECT_EQ(spent.allocations, 0u);
    const FrameReport report = engine().report();
    EXPECT_EQ(report.passCount, 0u);
    EXPECT_EQ(report.draws + report.textureBytesUploaded + report.bufferBytesUploaded, 0u);
    EXPECT_TRUE(reportOf(report).hasSkip("light 0", "unchanged"));
    EXPECT_EQ(renderer().render().rgba, first.rgba);
  }
}

TEST_F(Unchanged, LightsAloneAreFree) {
  for (const std::string& technique : techniques()) {
    SCOPED_TRACE(technique);
    renderer().choose({technique});
    renderer().desc().output = Output::lightsOnly;
    render();
    const Spent spent = render();
    EXPECT_EQ(spent.calls, 0u);
    EXPECT_EQ(spent.allocations, 0u);
  }
}

// Whatever the host changes is seen in the next frame.
TEST_F(Unchanged, EveryChangeIsDrawn) {
  renderer().choose({"hard"});
  renderer().desc().output = Output::visibility;
  render();
  EXPECT_EQ(render().calls, 0u);
  const auto drawn = [&](const char* what) {
    EXPECT_GT(render().calls, 0u) << what;
    EXPECT_EQ(render().calls, 0u) << what;
  };
  renderer().desc().camera.eye[0] += 0.01;
  drawn("camera");
  renderer().desc().target.width += 2;
  drawn("size");
  renderer().desc().output = Output::shaded;
  drawn("output");
  renderer().desc().clearColor[1] += 0.1f;
  drawn("clear colour");
  auto lights = builtinScene("figure@light=0.3").lights;
  lights[0].color.r *= 0.5f;
  renderer().setLights(lights);
  drawn("light's colour");
  renderer().setLights(lights);
  EXPECT_EQ(render().calls, 0u) << "the same light again";
  lights[0].centerWorld.x += 0.1;
  renderer().setLights(lights);
  drawn("light");
  renderer().choose({"pcf"});
  drawn("technique");
  renderer().choose({"pcf", {{"pcf.size", "3"}}});
  drawn("setting");
  glm::dmat4 moved = builtinScene("figure@light=0.3").objects[9].worldFromObject;
  moved[3].y += 0.1;
  renderer().setTransform(9, moved);
  drawn("transform");
  renderer().setTransform(9, moved);
  EXPECT_EQ(render().calls, 0u) << "the same transform again";
  const scene::SceneObject& object = builtinScene("figure@light=0.3").objects[9];
  EXPECT_TRUE(engine().setVertices(renderer().id(9), objectDesc(object).mesh).ok());
  drawn("vertices");
  ObjectId id = 0;
  EXPECT_TRUE(engine().addObject(objectDesc(object), id).ok());
  drawn("object");
  EXPECT_TRUE(engine().removeObject(id).ok());
  drawn("removal");
  renderer().desc().timing = Timing::perPass;
  EXPECT_GT(render().calls, 0u) << "times are of passes";
}

TEST_F(Unchanged, AFrameAfterAnErrorIsDrawn) {
  const Image first = renderer().render(Configuration{"hard"});
  const CameraDesc camera = renderer().desc().camera;
  renderer().desc().camera.target[0] = camera.eye[0];
  renderer().desc().camera.target[1] = camera.eye[1];
  renderer().desc().camera.target[2] = camera.eye[2];
  EXPECT_FALSE(engine().render(renderer().desc()).ok());
  EXPECT_EQ(engine().report().passCount, 0u);
  renderer().desc().camera = camera;
  EXPECT_GT(render().calls, 0u);
  EXPECT_EQ(renderer().render().rgba, first.rgba);
}

// The host may have drawn over its own framebuffer: receivers come again, and nothing else does.
TEST_F(Unchanged, AHostsFramebufferGetsItsReceiversAgain) {
  const gl::Functions& gl = hostGl();
  GLuint texture = 0, depth = 0, framebuffer = 0;
  gl.genTextures(1, &texture);
  gl.bindTexture(GL_TEXTURE_2D, texture);
  gl.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA, kWidth, kHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl.genRenderbuffers(1, &depth);
  gl.bindRenderbuffer(GL_RENDERBUFFER, depth);
  gl.renderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, kWidth, kHeight);
  gl.genFramebuffers(1, &framebuffer);
  const auto bind = [&] {
    gl.bindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    gl.framebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  };
  bind();
  const auto pixels = [&] {
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(kWidth * kHeight * 4));
    bind();
    gl.pixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.readPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return rgba;
  };
  renderer().desc().target.kind = TargetDesc::Kind::host;
  renderer().desc().target.framebuffer = framebuffer;
  for (const std::string& technique : techniques()) {
    SCOPED_TRACE(technique);
    renderer().choose({technique});
    render();
    const auto first = pixels();
    gl.clearColor(0.3f, 0.6f, 0.1f, 1);
    gl.clear(GL_COLOR_BUFFER_BIT);
    render();
    const FrameReport report = engine().report();
    EXPECT_EQ(report.passCount, 1u);
    EXPECT_EQ(report.textureBytesUploaded + report.bufferBytesUploaded, 0u);
    EXPECT_EQ(pixels(), first);
  }
  gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.deleteFramebuffers(1, &framebuffer);
  gl.deleteRenderbuffers(1, &depth);
  gl.deleteTextures(1, &texture);
}

}  // namespace
}  // namespace halfshadow::test
