// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What shadow volumes cost: draws, passes, framebuffer switches and uploads, exactly.
#include "analytic_scenes.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {

class VolumeCounters : public SharedEngineTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    SharedEngineTest::SetUp();
    if (blended()) return;
    if (isForcedOff("packed-depth-stencil")) GTEST_SKIP() << "packed-depth-stencil is forced off";
  }
  static bool blended() { return std::string(GetParam()) == "blend"; }
  static Configuration configuration() { return {"shadow-volume", {{"shadow-volume.count", GetParam()}}}; }
  /// Volumes of so many casters in one batch: two-sided stencil takes one draw each and one that resolves,
  /// blending adds and subtracts.
  static std::uint64_t volumeDraws(std::uint64_t casters) { return blended() ? 2 * casters : casters + 1; }
};

TEST_P(VolumeCounters, FigureFromOutside) {
  const scene::SceneDescription& scene = builtinScene("figure");
  const std::uint64_t casters = scene.objects.size() - 1;  // the ground casts nothing
  renderer().load(scene);
  const Image first = renderer().render(configuration());
  const Report report = renderer().report();
  ASSERT_EQ(report.passes.size(), 2u);
  EXPECT_EQ(report.passes[0].name, "shadow volumes");
  EXPECT_EQ(report.framebufferSwitches, 2u);
  // Receivers' depths, volumes, receivers.
  EXPECT_EQ(report.draws, 2 * scene.objects.size() + volumeDraws(casters));
  EXPECT_TRUE(report.hasSkip("light 0 caps of " + std::to_string(casters) + " shadow volumes", "near plane"));
  EXPECT_GT(report.bufferBytesUploaded, 0u);

  // The camera moves outside of the volumes: nothing is extracted or sent again.
  renderer().desc().camera.eye[0] += 0.5;
  const Image moved = renderer().render();
  EXPECT_EQ(renderer().report().bufferBytesUploaded + renderer().report().textureBytesUploaded, 0u);
  EXPECT_EQ(renderer().report().framebufferSwitches, 2u);
  EXPECT_NE(moved.rgba, first.rgba);

  // One caster moves: its volume alone is sent. 16 sides of a capsule are at most 64 vertices of 16 bytes.
  glm::dmat4 lifted = scene.objects[2].worldFromObject;
  lifted[3].y += 0.1;
  renderer().setTransform(2, lifted);
  renderer().render();
  EXPECT_GT(renderer().report().bufferBytesUploaded, 0u);
  EXPECT_LT(renderer().report().bufferBytesUploaded, report.bufferBytesUploaded / 5);
  renderer().render();
  EXPECT_EQ(renderer().report().bufferBytesUploaded, 0u);
}

TEST_P(VolumeCounters, CapsOnlyWhereTheEyeCanBeInside) {
  scene::SceneDescription scene;
  scene.objects = {scenes::casterOf("above", scenes::boxShape({0, 4, 0}, {1, 0.2, 1})),
                   scenes::casterOf("beside", scenes::boxShape({4, 1, 0}, {0.4, 1, 0.4})),
                   scenes::casterOf("far", scenes::boxShape({-40, 1, 0}, {0.4, 1, 0.4})), groundPlane(60.0)};
  scene.lights = {lightAbove({0, 12, 0}, 0.3, 0.3)};
  scene.camera = scene::Camera{.eyeWorld = {0.3, 1.5, 0.5}, .targetWorld = {4.0, 0.5, 0.0}};
  renderer().load(scene);
  renderer().render(configuration());
  const Report inside = renderer().report();
  EXPECT_TRUE(inside.hasSkip("light 0 caps of 2 shadow volumes", "near plane"));
  EXPECT_TRUE(inside.hasSkip("light 0, 1 shadow volumes", "outside of the camera's view"));
  // Leaving the volume costs no upload but the sides' own, once.
  renderer().desc().camera.eye[0] = 2.5;
  renderer().render();
  EXPECT_TRUE(renderer().report().hasSkip("light 0 caps of 3 shadow volumes", "near plane"));
  renderer().desc().camera.eye[0] = 0.3;
  renderer().render();
  EXPECT_EQ(renderer().report().bufferBytesUploaded, 0u);
  renderer().desc().camera.eye[0] = 2.5;
  renderer().render();
  EXPECT_EQ(renderer().report().bufferBytesUploaded, 0u);
}

TEST_P(VolumeCounters, ACasterThatIsNotDrawnKeepsItsCaps) {
  scene::SceneDescription scene;
  scene.objects = {boxObject({0, 4, 0}, {1, 0.2, 1}), groundPlane(60.0)};
  scene.lights = {lightAbove({3, 12, 0}, 0.3, 0.3)};
  scene.camera = scene::Camera{.eyeWorld = {1, 14, 3}, .targetWorld = {-1, 0, 0}};
  renderer().load(scene);
  renderer().render(configuration());
  EXPECT_FALSE(renderer().report().hasSkip("light 0 caps of 1 shadow volumes", ""));
}

TEST_P(VolumeCounters, FourLightsShareThePass) {
  scene::SceneDescription scene = builtinScene("figure");
  const std::uint64_t casters = scene.objects.size() - 1;
  for (int i = 1; i < 4; ++i) {
    scene.lights.push_back(scene.lights.front());
    scene.lights.back().centerWorld += glm::dvec3(2.0 * i, i, -3.0 * i);
  }
  renderer().load(scene);
  renderer().render(configuration());
  EXPECT_EQ(renderer().report().passes.size(), 2u);
  EXPECT_EQ(renderer().report().framebufferSwitches, 2u);
  EXPECT_EQ(renderer().report().draws, 5 * scene.objects.size() + 4 * volumeDraws(casters));
}

TEST_P(VolumeCounters, NestedCastersTakeBatches) {
  scene::SceneDescription scene;
  for (int i = 0; i < 300; ++i) {
    scene.objects.push_back(boxObject({0, 3.0 + 0.01 * i, 0}, {1.0, 0.002, 1.0}));
    scene.objects.back().receives = true;
  }
  scene.objects.push_back(groundPlane(60.0));
  scene.lights = {lightAbove({3, 14, 0}, 0.3, 0.3)};
  scene.camera = scene::Camera{.eyeWorld = {0, 8, 20}, .targetWorld = {0, 3, 0}};
  renderer().load(scene);
  renderer().render(configuration());
  // 255 + 45, each resolved; 160 + 140 with eight doublings and a subtraction between them.
  EXPECT_EQ(renderer().report().draws, 2 * 301u + (blended() ? 2 * 300u + 9u : 300u + 2u));
  EXPECT_EQ(renderer().report().framebufferSwitches, 2u);
}

TEST_F(SharedEngineTest, ForcedStencilSaysWhatIsMissing) {
  auto engine = makeEngine({"packed-depth-stencil"});
  SceneRenderer bare(std::move(engine));
  bare.load(builtinScene("box"));
  bare.choose({"shadow-volume", {{"shadow-volume.count", "stencil"}}});
  FrameReport report;
  const Outcome outcome = bare.engine().render(bare.desc(), report);
  EXPECT_FALSE(outcome.ok());
  EXPECT_NE(std::string(outcome.message).find("packed-depth-stencil"), std::string::npos) << outcome.message;
  const Image blended = bare.render(Configuration{"shadow-volume", {{"shadow-volume.count", "auto"}}});
  renderer().load(builtinScene("box"));
  EXPECT_EQ(renderer().render(Configuration{"shadow-volume"}).rgba, blended.rgba);
}

INSTANTIATE_TEST_SUITE_P(Counters, VolumeCounters, testing::Values("stencil", "blend"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace halfshadow::test
