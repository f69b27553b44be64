// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every refusal has its code and a sentence, and leaves the last good state: nothing is drawn.
#include <cmath>
#include <limits>

#include "analytic_scenes.hpp"

namespace halfshadow::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class BadInput : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (HasFatalFailure()) return;
    renderer_ = std::make_unique<SceneRenderer>(makeEngine());
    renderer_->load(plate_.scene());
    good_ = renderer_->render();
  }
  void TearDown() override {
    renderer_.reset();
    EngineTest::TearDown();
  }
  Engine& engine() { return renderer_->engine(); }

  static void expectRefused(const Outcome& outcome, ErrorCode code, const std::string& named = "") {
    EXPECT_EQ(outcome.code, code) << outcome.message;
    EXPECT_GE(std::string(outcome.message).size(), 15u) << "a sentence";
    EXPECT_NE(std::string(outcome.message).find(named), std::string::npos)
        << outcome.message << " does not name " << named;
  }
  /// The frame is refused and draws nothing: the output is still the last good one.
  void expectRenderRefused(const RenderDesc& desc, ErrorCode code, const std::string& named = "") {
    FrameReport report;
    const Outcome outcome = engine().render(desc, report);
    expectRefused(outcome, code, named);
    EXPECT_EQ(report.passCount, 0u);
    EXPECT_EQ(report.draws, 0u);
    expectOutputIsTheLastGood();
  }
  void expectOutputIsTheLastGood() {
    std::vector<std::uint8_t> pixels(good_.rgba.size());
    const Outcome outcome = engine().readOutput(pixels.data(), pixels.size());
    ASSERT_TRUE(outcome.ok()) << outcome.message;
    EXPECT_EQ(pixels, good_.rgba);
  }

  PlateOverGround plate_;
  std::unique_ptr<SceneRenderer> renderer_;
  Image good_;
};

TEST_F(BadInput, Cameras) {
  const RenderDesc good = renderer_->desc();
  RenderDesc desc = good;
  desc.camera.eye[1] = kNan;
  expectRenderRefused(desc, ErrorCode::invalidCamera);
  desc = good;
  desc.camera.target[2] = kInfinity;
  expectRenderRefused(desc, ErrorCode::invalidCamera);
  desc = good;
  std::copy_n(desc.camera.eye, 3, desc.camera.target);
  expectRenderRefused(desc, ErrorCode::invalidCamera);
  for (const double fov : {0.0, -1.0, 3.2, kNan}) {
    desc = good;
    desc.camera.verticalFovRadians = fov;
    expectRenderRefused(desc, ErrorCode::invalidCamera);
  }
  desc = good;
  desc.camera.nearDistance = 0.0;
  expectRenderRefused(desc, ErrorCode::invalidCamera);
  desc = good;
  std::swap(desc.camera.nearDistance, desc.camera.farDistance);
  expectRenderRefused(desc, ErrorCode::invalidCamera);
}

TEST_F(BadInput, Targets) {
  RenderDesc desc = renderer_->desc();
  desc.target.width = 0;
  expectRenderRefused(desc, ErrorCode::invalidArgument, "0x144");
  desc.target.width = -5;
  expectRenderRefused(desc, ErrorCode::invalidArgument, "-5");
  desc.target.width = 1 << 20;
  expectRenderRefused(desc, ErrorCode::invalidArgument, "1048576");
}

TEST_F(BadInput, Lights) {
  const LightDesc good = lightDesc(plate_.light());
  const auto refuse = [&](const LightDesc& light, ErrorCode code) {
    expectRefused(engine().setLights(&light, 1), code);
    EXPECT_EQ(renderer_->render().rgba, good_.rgba) << "the lights set before must stay";
  };
  LightDesc light = good;
  light.center[0] = kNan;
  refuse(light, ErrorCode::invalidLight);
  light = good;
  light.halfU[2] = kInfinity;
  refuse(light, ErrorCode::invalidLight);
  light = good;
  std::copy_n(light.halfU, 3, light.halfV);
  refuse(light, ErrorCode::invalidLight);
  light = good;
  light.intensity = kNan;
  refuse(light, ErrorCode::invalidLight);
  for (const double distance : {-1.0, kNan, kInfinity}) {
    light = good;
    light.referenceDistance = distance;
    refuse(light, ErrorCode::invalidLight);
  }
  // A line has no side to shine to; a point has the one of `emission`.
  for (const bool u : {false, true}) {
    light = good;
    std::fill_n(u ? light.halfU : light.halfV, 3, 0.0);
    refuse(light, ErrorCode::invalidLight);
  }
  light = {};
  light.emission[1] = 0.0;
  refuse(light, ErrorCode::invalidLight);
  const std::vector<LightDesc> five(5, good);
  expectRefused(engine().setLights(five.data(), five.size()), ErrorCode::invalidArgument, "4");
}

TEST_F(BadInput, ObjectsAndTransforms) {
  const scene::SceneDescription scene = plate_.scene();
  const ObjectDesc good = objectDesc(scene.objects.front());
  const int live = engine().liveObjectCount();
  const auto refuse = [&](const ObjectDesc& desc, ErrorCode code) {
    ObjectId id = 77;
    expectRefused(engine().addObject(desc, id), code);
    EXPECT_EQ(id, 0u);
    EXPECT_EQ(engine().liveObjectCount(), live) << "a refused object leaves nothing behind";
  };
  ObjectDesc desc = good;
  desc.worldFromObject[13] = kNan;
  refuse(desc, ErrorCode::invalidArgument);
  desc = good;
  desc.worldFromObject[3] = 1.0;
  refuse(desc, ErrorCode::invalidArgument);
  desc = good;
  desc.worldFromObject[0] = 0.0;
  refuse(desc, ErrorCode::invalidArgument);
  desc = good;
  desc.mesh.vertexCount = 0;
  desc.mesh.indexCount = 0;
  refuse(desc, ErrorCode::emptyScene);
  desc = good;
  const std::uint32_t outOfRange[] = {0, 1, 4000000000u};
  desc.mesh.indices = outOfRange;
  desc.mesh.indexCount = 3;
  refuse(desc, ErrorCode::invalidMesh);
  desc.mesh.indexCount = 2;
  refuse(desc, ErrorCode::invalidMesh);
  desc = good;
  const float notFinite[] = {0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0};
  desc.mesh = {.positions = notFinite, .vertexCount = 3};
  refuse(desc, ErrorCode::invalidMesh);
  desc.mesh = {.positions = nullptr, .vertexCount = 3};
  refuse(desc, ErrorCode::invalidMesh);

  const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  expectRefused(engine().setTransform(12345, identity), ErrorCode::invalidArgument);
  double broken[16];
  std::copy_n(identity, 16, broken);
  broken[5] = kNan;
  expectRefused(engine().setTransform(renderer_->id(0), broken), ErrorCode::invalidArgument);
  expectRefused(engine().removeObject(12345), ErrorCode::invalidArgument);
  expectRefused(engine().setVertices(12345, good.mesh), ErrorCode::invalidArgument);
  MeshDesc fewer = good.mesh;
  fewer.vertexCount = 3;
  expectRefused(engine().setVertices(renderer_->id(0), fewer), ErrorCode::invalidArgument);
  MeshDesc none = good.mesh;
  none.positions = nullptr;
  expectRefused(engine().setVertices(renderer_->id(0), none), ErrorCode::invalidMesh);
  std::vector<float> half(good.mesh.positions, good.mesh.positions + 3 * good.mesh.vertexCount);
  half[0] += 0.5f;
  half.back() = std::numeric_limits<float>::infinity();
  MeshDesc halfBroken = good.mesh;
  halfBroken.positions = half.data();
  expectRefused(engine().setVertices(renderer_->id(0), halfBroken), ErrorCode::invalidMesh);
  // A mesh refused at its last vertex must not have moved its first: bounds and light fits are made from it.
  EXPECT_EQ(renderer_->render().rgba, good_.rgba) << "the scene is as it was";
  renderer_->setLights({lightAbove({0.0, 12.5, 0.0}, 1.0, 1.0)});
  const Image after = renderer_->render();
  SceneRenderer fresh(makeEngine());
  fresh.load(scene);
  fresh.setLights({lightAbove({0.0, 12.5, 0.0}, 1.0, 1.0)});
  EXPECT_EQ(after.rgba, fresh.render().rgba) << "refit with the refused vertices";
}

TEST_F(BadInput, TechniquesAndSettings) {
  expectRefused(engine().setTechnique("radiosity"), ErrorCode::unknownTechnique, "pcss-mip");
  expectRefused(engine().setTechnique(nullptr), ErrorCode::unknownTechnique);
  expectRefused(engine().set("pcf.colour", "7"), ErrorCode::unknownSetting, "pcf.size");
  expectRefused(engine().set("pcf.size", "99"), ErrorCode::invalidArgument, "17");
  expectRefused(engine().set("pcf.size", "seven"), ErrorCode::invalidArgument);
  expectRefused(engine().set("pcf.pattern", "hexagon"), ErrorCode::invalidArgument, "poisson");
  expectRefused(engine().set("bias", "nan"), ErrorCode::invalidArgument);
  expectRefused(engine().set(nullptr, "1"), ErrorCode::invalidArgument);
  EXPECT_EQ(renderer_->render().rgba, good_.rgba) << "technique and settings are as they were";
}

TEST_F(BadInput, UnsupportedTechniqueNamesTheCapability) {
  SceneRenderer without(makeEngine({"highp"}));
  expectRefused(without.engine().setTechnique("vsm"), ErrorCode::capabilityMissing, "highp");
  without.load(plate_.scene());
  EXPECT_EQ(without.render().width, kWidth) << "the technique before still renders";
}

TEST_F(BadInput, FramesBeforeTheirTime) {
  SceneRenderer empty(makeEngine());
  FrameReport report;
  std::vector<std::uint8_t> pixels(4 * kWidth * kHeight);
  expectRefused(empty.engine().readOutput(pixels.data(), pixels.size()), ErrorCode::invalidArgument);
  EXPECT_EQ(empty.engine().outputTexture(), 0u);
  const scene::SceneDescription scene = plate_.scene();
  ObjectId id = 0;
  ASSERT_TRUE(empty.engine().addObject(objectDesc(scene.objects.front()), id).ok());
  EXPECT_TRUE(empty.engine().render(renderer_->desc(), report).ok()) << "without a light nothing is shadowed";
  expectRefused(engine().readOutput(pixels.data(), 3), ErrorCode::invalidArgument);
  expectRefused(engine().readOutput(nullptr, pixels.size()), ErrorCode::invalidArgument);
}

TEST_F(BadInput, EnginesThatCannotBeMade) {
  Outcome outcome;
  EXPECT_EQ(Engine::create({}, outcome), nullptr);
  expectRefused(outcome, ErrorCode::invalidArgument, "getProcAddress");
  EXPECT_EQ(Engine::create({.getProcAddress = [](const char*, void*) -> void* { return nullptr; }}, outcome),
            nullptr);
  expectRefused(outcome, ErrorCode::driverMissing);
  const char* unknown[] = {"ray-tracing"};
  const EngineDesc desc{
      .getProcAddress = [](const char* name, void*) { return headless()->getProcAddress(name); },
      .forcedOff = unknown,
      .forcedOffCount = 1};
  EXPECT_EQ(Engine::create(desc, outcome), nullptr);
  expectRefused(outcome, ErrorCode::invalidArgument, "ray-tracing");
}

}  // namespace
}  // namespace halfshadow::test
