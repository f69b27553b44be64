// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Contexts that go, at any call, and come back.
#include <gtest/gtest.h>

#include <thread>

#include "engine_fixture.hpp"
#include "faulty_gl.hpp"

namespace halfshadow::test {
namespace {

class LostContext : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (HasFatalFailure()) return;
    renderer_ = std::make_unique<SceneRenderer>(makeFaultyEngine());
    renderer_->load(builtinScene("box@light=0.3"));
    renderer_->desc().target.width = 48;
    renderer_->desc().target.height = 36;
    faultyDriver().onLost = [this] { engine().contextLost(); };
  }
  void TearDown() override {
    faultyDriver().disarm();
    renderer_.reset();
    faultyDriver().onLost = nullptr;
    EXPECT_EQ(faultyDriver().aliveCount(), 0u);
    EXPECT_EQ(faultyDriver().strangers, 0) << "names were deleted that are not the engine's";
    faultyDriver().endContext();
  }
  SceneRenderer& renderer() { return *renderer_; }
  Engine& engine() { return renderer_->engine(); }

 private:
  std::unique_ptr<SceneRenderer> renderer_;
};

TEST_F(LostContext, IsNotCalledFromTheMiddleOfAFrameAndComesBack) {
  std::uint64_t step = 0, lost = 0;
  for (const std::string& technique : faultedTechniques(engine())) {
    SCOPED_TRACE(technique);
    const Configuration small{technique, {{"map_size", "64"}, {"sampled.samples", "2"}}};
    const Image wanted = renderer().render(small);
    ASSERT_TRUE(engine().trim(Trim::everything).ok());
    // Its length is some hundred calls: four of them, others for each technique.
    const std::uint64_t each = faultStride(97);
    for (std::uint64_t call = step++ * 11 % each, tried = 0; each != 97 || tried < 4; call += each, ++tried) {
      faultyDriver().arm(Fault::lost, call);
      const Outcome outcome = engine().render(renderer().desc());
      const bool reached = faultyDriver().gone;
      if (!reached) faultyDriver().disarm();
      if (!reached) break;  // the frame has fewer calls
      ++lost;
      EXPECT_EQ(outcome.code, ErrorCode::contextLost) << outcome.message;
      EXPECT_EQ(engine().render(renderer().desc()).code, ErrorCode::contextLost);
      ObjectId id = 0;
      EXPECT_EQ(engine().addObject(objectDesc(builtinScene("box@light=0.3").objects[0]), id).code,
                ErrorCode::contextLost);
      EXPECT_EQ(engine().liveObjectCount() - engine().memory().buffers, 0);
      EXPECT_EQ(faultyDriver().callsAfterLoss, 0u)
          << "after call " << call << ", " << faultyDriver().failedAt;
      faultyDriver().disarm();
      faultyDriver().endContext();
      const Outcome restored = engine().contextRestored();
      ASSERT_TRUE(restored.ok()) << restored.message;
      EXPECT_EQ(renderer().render().rgba, wanted.rgba) << "after call " << call;
      ASSERT_TRUE(engine().trim(Trim::everything).ok());
    }
  }
  std::printf("the context was lost at %llu calls\n", static_cast<unsigned long long>(lost));
}

TEST_F(LostContext, OfAnyOtherCallToo) {
  const scene::SceneObject& object = builtinScene("box@light=0.3").objects.back();
  const Image wanted = renderer().render(Configuration{"hard"});
  for (std::uint64_t call = 0; call < 12; ++call) {
    for (int which = 0; which < 4; ++which) {
      faultyDriver().arm(Fault::lost, call);
      std::vector<std::uint8_t> pixels(wanted.rgba.size());
      ObjectId id = 0;
      Outcome outcome;
      if (which == 0) outcome = engine().addObject(objectDesc(object), id);
      if (which == 1)
        outcome =
            engine().setVertices(renderer().id(0), objectDesc(builtinScene("box@light=0.3").objects[0]).mesh);
      if (which == 2) outcome = engine().readOutput(pixels.data(), pixels.size());
      if (which == 3) outcome = engine().trim(Trim::everything);
      EXPECT_EQ(outcome.code == ErrorCode::contextLost, faultyDriver().gone) << which << " at call " << call;
      EXPECT_EQ(faultyDriver().callsAfterLoss, 0u) << which << " at call " << call;
      faultyDriver().disarm();
      if (id != 0) {
        EXPECT_TRUE(engine().removeObject(id).ok());
      }
      faultyDriver().endContext();
      ASSERT_TRUE(engine().contextRestored().ok());
      EXPECT_EQ(renderer().render().rgba, wanted.rgba) << which << " at call " << call;
    }
  }
}

/// On a driver's context of its own, current on this thread.
struct OwnContext {
  std::unique_ptr<HeadlessContext> context;
  static void* load(const char* name, void* user) {
    return static_cast<OwnContext*>(user)->context->getProcAddress(name);
  }
  void open() {
    context.reset();
    auto made = createHeadless({.driver = "llvmpipe"});
    ASSERT_TRUE(made.ok()) << made.error().message;
    context = std::move(made).value();
  }
  std::unique_ptr<Engine> makeEngine() {
    Outcome outcome;
    std::unique_ptr<Engine> engine(
        Engine::create({.getProcAddress = load, .getProcAddressUser = this}, outcome));
    EXPECT_TRUE(outcome.ok()) << outcome.message;
    return engine;
  }
};

/// The context is destroyed and another made: what the host changed meanwhile is there too.
void loseAndRestore() {
  OwnContext own;
  own.open();
  const scene::SceneDescription& scene = builtinScene("box@light=0.3");
  SceneRenderer other(own.makeEngine());
  other.load(scene);
  std::vector<std::uint8_t> pixels(8 * 8 * 3, 200);
  ObjectDesc colored = objectDesc(scene.objects.back());
  colored.baseColorPixels = pixels.data();
  colored.baseColorWidth = colored.baseColorHeight = 8;
  colored.baseColorChannels = 3;
  ObjectId id = 0;
  ASSERT_TRUE(other.engine().addObject(colored, id).ok());
  other.choose({"pcss-mip"});
  const Image before = other.render(Output::shaded);
  other.engine().contextLost();
  EXPECT_EQ(other.engine().outputTexture(), 0u);
  glm::dmat4 moved = scene.objects.back().worldFromObject;
  moved[3].y += 0.5;
  other.setTransform(scene.objects.size() - 1, moved);
  other.choose({"wedges"});
  own.open();
  const Outcome restored = other.engine().contextRestored();
  ASSERT_TRUE(restored.ok()) << restored.message;
  const Image after = other.render(Output::shaded);
  EXPECT_NE(after.rgba, before.rgba);
  SceneRenderer fresh(own.makeEngine());
  fresh.load(scene);
  ASSERT_TRUE(fresh.engine().addObject(colored, id).ok());
  fresh.setTransform(scene.objects.size() - 1, moved);
  EXPECT_EQ(after.rgba, fresh.render(Configuration{"wedges"}, Output::shaded).rgba);
}

TEST_F(LostContext, ComesBackOnAnotherContextWithWhatChangedMeanwhile) {
  (void)builtinScene("box@light=0.3");
  std::thread(loseAndRestore).join();
}

}  // namespace
}  // namespace halfshadow::test
