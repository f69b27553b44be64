// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every OpenGL ES call of a frame fails once.
#include <gtest/gtest.h>

#include "engine_fixture.hpp"
#include "faulty_gl.hpp"

namespace halfshadow::test {
namespace {

class Driver : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (HasFatalFailure()) return;
    renderer_ = std::make_unique<SceneRenderer>(makeFaultyEngine());
    renderer_->load(builtinScene("box@light=0.3"));
  }
  void TearDown() override {
    faultyDriver().disarm();
    renderer_.reset();
    for (const auto& [kind, alive] : faultyDriver().alive) EXPECT_EQ(alive.size(), 0u) << kind;
    EXPECT_EQ(faultyDriver().strangers, 0) << "names were deleted that are not the engine's";
    faultyDriver().endContext();
    while (hostGl().getError() != GL_NO_ERROR) {
    }
  }
  SceneRenderer& renderer() { return *renderer_; }
  Engine& engine() { return renderer_->engine(); }
  /// Another technique's frame lies between, so that this one makes what it needs; programs stay.
  void forget() { ASSERT_TRUE(engine().trim(Trim::everything).ok()); }
  void chooseSmall(const std::string& technique) {
    renderer().choose(
        {technique, {{"map_size", "64"}, {"sampled.samples", "2"}, {"occlusion-textures.slices", "4"}}});
    renderer().desc().target.width = 48;
    renderer().desc().target.height = 36;
  }
  Image picture() {
    Image image{.width = renderer().desc().target.width, .height = renderer().desc().target.height};
    image.rgba.resize(image.pixels() * 4);
    const Outcome read = engine().readOutput(image.rgba.data(), image.rgba.size());
    EXPECT_TRUE(read.ok()) << read.message;
    return image;
  }
  std::uint64_t callsOfAFrame() {
    forget();
    faultyDriver().arm(Fault::dropped, ~std::uint64_t{0});
    EXPECT_TRUE(engine().render(renderer().desc()).ok());
    const std::uint64_t calls = faultyDriver().calls;
    faultyDriver().disarm();
    return calls;
  }

 private:
  std::unique_ptr<SceneRenderer> renderer_;
};

TEST_F(Driver, EveryCallOfEveryTechniqueMayFail) {
  std::uint64_t failed = 0, refusedFrames = 0, silent = 0, step = 0;
  for (const std::string& technique : faultedTechniques(engine())) {
    SCOPED_TRACE(technique);
    chooseSmall(technique);
    const Image wanted = renderer().render();
    const std::uint64_t calls = callsOfAFrame();
    ASSERT_GT(calls, 20u);
    std::fprintf(stderr, "%s: %llu calls a frame\n", technique.c_str(),
                 static_cast<unsigned long long>(calls));
    for (const Fault fault : {Fault::outOfMemory, Fault::invalid, Fault::refused, Fault::dropped}) {
      // All of them where a frame is short and is tried again: what the first try left must not stay.
      const bool all = technique == "hard" && fault == Fault::outOfMemory;
      const std::uint64_t each = all ? 1 : faultStride(211);
      // Other calls in each round, so that strides meet all in the end.
      for (std::uint64_t call = step++ % each; call < calls; call += each) {
        forget();
        faultyDriver().arm(fault, call);
        const Outcome outcome = engine().render(renderer().desc());
        const std::string what = std::string(faultName(fault)) + " at call " + std::to_string(call) + ", " +
                                 faultyDriver().failedAt;
        faultyDriver().disarm();
        ++failed;
        refusedFrames += !outcome.ok();
        EXPECT_TRUE(outcome.ok() || outcome.message[0] != '\0') << what;
        EXPECT_NE(outcome.code, ErrorCode::internal) << what << ": " << outcome.message;
        const Outcome next = engine().render(renderer().desc());
        ASSERT_TRUE(next.ok()) << "after " << what << ": " << next.message;
        if (picture().rgba == wanted.rgba) continue;
        // What nobody said failed cannot be known; a host that sees it makes everything again.
        EXPECT_TRUE(fault == Fault::dropped || fault == Fault::refused)
            << "after " << what << " (" << outcome.message << ")";
        ++silent;
        faultyDriver().endContext();
        ASSERT_TRUE(engine().contextRestored().ok()) << "after " << what;
        ASSERT_TRUE(engine().render(renderer().desc()).ok());
        ASSERT_EQ(picture().rgba, wanted.rgba) << "after " << what << ", everything made again";
      }
    }
  }
  std::printf("%llu calls failed, %llu frames were refused, %llu were wrong without a word of the driver\n",
              static_cast<unsigned long long>(failed), static_cast<unsigned long long>(refusedFrames),
              static_cast<unsigned long long>(silent));
  EXPECT_GT(refusedFrames, failed / 8);
}

TEST_F(Driver, EveryCallOfAddingAndMovingAMeshMayFail) {
  chooseSmall("hard");
  const Image wanted = renderer().render();
  const scene::SceneObject& object = builtinScene("box@light=0.3").objects.back();
  const MemoryRecord before = engine().memory();
  for (const Fault fault : {Fault::outOfMemory, Fault::invalid, Fault::dropped}) {
    for (std::uint64_t call = 0; call < 40; ++call) {
      faultyDriver().arm(fault, call);
      ObjectId id = 0;
      const Outcome added = engine().addObject(objectDesc(object), id);
      const bool reached = *faultyDriver().failedAt != '\0';
      faultyDriver().disarm();
      EXPECT_EQ(added.ok(), id != 0);
      if (id != 0) {
        EXPECT_TRUE(engine().removeObject(id).ok());
      }
      EXPECT_EQ(engine().memory().bytes, before.bytes) << faultName(fault) << " at call " << call;
      if (!reached) break;
    }
  }
  std::vector<float> moved(objectDesc(object).mesh.positions,
                           objectDesc(object).mesh.positions + 3 * object.mesh->positions.size());
  for (float& value : moved) value += 0.25f;
  MeshDesc desc = objectDesc(object).mesh;
  desc.positions = moved.data();
  const ObjectId last = renderer().id(builtinScene("box@light=0.3").objects.size() - 1);
  for (std::uint64_t call = 0; call < 40; ++call) {
    faultyDriver().arm(Fault::outOfMemory, call);
    const Outcome replaced = engine().setVertices(last, desc);
    const bool reached = *faultyDriver().failedAt != '\0';
    faultyDriver().disarm();
    if (!reached) break;
    if (replaced.ok()) {
      // It was a call whose failing changes nothing.
      ASSERT_TRUE(engine().setVertices(last, objectDesc(object).mesh).ok());
    } else {
      EXPECT_EQ(replaced.code, ErrorCode::outOfMemory) << replaced.message;
    }
    forget();
    ASSERT_TRUE(engine().render(renderer().desc()).ok());
    EXPECT_EQ(picture().rgba, wanted.rgba) << "at call " << call;
  }
}

}  // namespace
}  // namespace halfshadow::test
