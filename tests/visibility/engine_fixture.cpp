// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "engine_fixture.hpp"

#include <algorithm>
#include <cstdlib>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <sstream>

#include "scenes/scene_source.hpp"

namespace halfshadow::test {
namespace {

struct Process {
  std::unique_ptr<HeadlessContext> context;
  gl::Functions functions;
  std::string failure;
};

Process& process() {
  static Process opened = [] {
    Process made;
    const char* driver = std::getenv("HALFSHADOW_TEST_DRIVER");
    auto context = createHeadless({.driver = driver ? driver : "llvmpipe"});
    if (!context) {
      made.failure = context.error().message;
      return made;
    }
    made.context = std::move(context).value();
    const std::string absent = made.functions.load(
        [raw = made.context.get()](const char* name) { return raw->getProcAddress(name); });
    if (!absent.empty()) made.failure = "the driver lacks " + absent;
    return made;
  }();
  return opened;
}

void store(const glm::dvec3& vector, double target[3]) {
  std::copy_n(glm::value_ptr(vector), 3, target);
}

void expectOk(const Outcome& outcome, const std::string& what) {
  EXPECT_TRUE(outcome.ok()) << what << ": " << outcome.message;
}

/// Outlives the static renderer of SharedEngineTest, whose engine deletes its objects in this context.
std::unique_ptr<SceneRenderer>& sharedRenderer() {
  process();
  static std::unique_ptr<SceneRenderer> shared;
  return shared;
}

}  // namespace

HeadlessContext* headless() {
  return process().failure.empty() ? process().context.get() : nullptr;
}
const std::string& contextFailure() {
  return process().failure;
}
const gl::Functions& hostGl() {
  return process().functions;
}

std::vector<std::string> forcedOffByEnvironment() {
  std::vector<std::string> names;
  const char* text = std::getenv("HALFSHADOW_TEST_FORCE");
  std::istringstream stream(text ? text : "");
  for (std::string name; std::getline(stream, name, ',');) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

bool isForcedOff(const std::string& capability) {
  return std::ranges::count(forcedOffByEnvironment(), capability) > 0;
}

std::unique_ptr<Engine> makeEngine(const std::vector<std::string>& alsoForcedOff, HostState hostState) {
  std::vector<std::string> forced = forcedOffByEnvironment();
  forced.insert(forced.end(), alsoForcedOff.begin(), alsoForcedOff.end());
  std::vector<const char*> names;
  for (const std::string& name : forced) names.push_back(name.c_str());
  Outcome outcome;
  std::unique_ptr<Engine> engine(Engine::create(
      {.getProcAddress = [](const char* name,
                            void* user) { return static_cast<HeadlessContext*>(user)->getProcAddress(name); },
       .getProcAddressUser = headless(),
       .forcedOff = names.data(),
       .forcedOffCount = names.size(),
       .hostState = hostState},
      outcome));
  expectOk(outcome, "Engine::create");
  return engine;
}

const scene::SceneDescription& builtinScene(const std::string& name) {
  static std::map<std::string, scene::SceneDescription> opened;
  const auto found = opened.find(name);
  if (found != opened.end()) return found->second;
  auto scene = scenes::openScene(name.ends_with(".glb") ? name : "builtin:" + name, {});
  EXPECT_TRUE(scene) << scene.error().message;
  return opened[name] = scene ? std::move(scene).value() : scene::SceneDescription{};
}

CameraDesc cameraDesc(const scene::Camera& camera) {
  CameraDesc desc{.verticalFovRadians = camera.verticalFovRadians,
                  .nearDistance = camera.nearDistance,
                  .farDistance = camera.farDistance};
  store(camera.eyeWorld, desc.eye);
  store(camera.targetWorld, desc.target);
  store(camera.up, desc.up);
  return desc;
}

LightDesc lightDesc(const scene::AreaLight& light) {
  LightDesc desc{.intensity = light.intensity, .referenceDistance = light.referenceDistance};
  std::copy_n(glm::value_ptr(light.color), 3, desc.color);
  store(light.centerWorld, desc.center);
  store(light.halfU, desc.halfU);
  store(light.halfV, desc.halfV);
  store(light.emission, desc.emission);
  return desc;
}

ObjectDesc objectDesc(const scene::SceneObject& object) {
  const scene::TriangleMesh& mesh = *object.mesh;
  ObjectDesc desc{.mesh = {.positions = glm::value_ptr(mesh.positions.front()),
                           .vertexCount = static_cast<std::uint32_t>(mesh.positions.size()),
                           .indices = mesh.indices.data(),
                           .indexCount = mesh.indices.size(),
                           .normals = mesh.normals.empty() ? nullptr : glm::value_ptr(mesh.normals.front())},
                  .casts = object.casts,
                  .receives = object.receives};
  std::copy_n(glm::value_ptr(object.worldFromObject), 16, desc.worldFromObject);
  return desc;
}

std::string Configuration::text() const {
  std::string text = technique;
  for (const Setting& setting : settings) text += " " + setting.key + "=" + setting.value;
  return text;
}

std::vector<float> Image::visibility(int channel) const {
  std::vector<float> values(pixels());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(byte(i, channel)) / 255.0f;
  return values;
}

std::size_t Report::lightPasses() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(passes, [](const Pass& pass) { return pass.lightSpace; }));
}

bool Report::hasSkip(const std::string& what, const std::string& whyPart) const {
  return std::ranges::any_of(skips, [&](const Skip& skip) {
    return skip.what == what && skip.why.find(whyPart) != std::string::npos;
  });
}

Report reportOf(const FrameReport& report) {
  Report result{.framebufferSwitches = report.framebufferSwitches,
                .draws = report.draws,
                .textureBytesUploaded = report.textureBytesUploaded,
                .bufferBytesUploaded = report.bufferBytesUploaded};
  for (std::size_t i = 0; i < report.passCount; ++i)
    result.passes.push_back({report.passes[i].name, report.passes[i].lightSpace});
  for (std::size_t i = 0; i < report.skipCount; ++i)
    result.skips.push_back({report.skips[i].what, report.skips[i].why});
  return result;
}

void SceneRenderer::load(const scene::SceneDescription& scene) {
  for (const ObjectId id : ids_) expectOk(engine_->removeObject(id), "removeObject");
  ids_.clear();
  for (const scene::SceneObject& object : scene.objects) {
    ObjectId id = 0;
    expectOk(engine_->addObject(objectDesc(object), id), "addObject " + object.name);
    ids_.push_back(id);
  }
  // Another scene's lights are new ones, not those of the scene before moved: numbered from 0.
  setLights({});
  setLights(scene.lights);
  desc_ = {};
  desc_.camera = cameraDesc(scene.camera.value());
  desc_.target.width = kWidth;
  desc_.target.height = kHeight;
}

void SceneRenderer::setLights(const std::vector<scene::AreaLight>& lights) {
  std::vector<LightDesc> descs;
  for (const scene::AreaLight& light : lights) descs.push_back(lightDesc(light));
  expectOk(engine_->setLights(descs.data(), descs.size()), "setLights");
}

void SceneRenderer::setTransform(std::size_t object, const glm::dmat4& worldFromObject) {
  expectOk(engine_->setTransform(ids_.at(object), glm::value_ptr(worldFromObject)), "setTransform");
}

void SceneRenderer::choose(const Configuration& configuration) {
  for (const Setting& setting : defaultsOfChanged_)
    expectOk(engine_->set(setting.key.c_str(), setting.value.c_str()), setting.key);
  defaultsOfChanged_.clear();
  expectOk(engine_->setTechnique(configuration.technique.c_str()), configuration.technique);
  for (const Setting& setting : configuration.settings) {
    for (std::size_t i = 0; i < engine_->settingCount(); ++i) {
      const SettingRecord record = engine_->setting(i);
      if (setting.key == record.key) defaultsOfChanged_.push_back({setting.key, record.defaultValue});
    }
    expectOk(engine_->set(setting.key.c_str(), setting.value.c_str()), setting.key);
  }
}

Image SceneRenderer::render(Output output) {
  Image image{.width = desc_.target.width, .height = desc_.target.height};
  image.rgba.resize(image.pixels() * 4);
  desc_.output = output;
  FrameReport frame;
  expectOk(engine_->render(desc_, frame), "render");
  report_ = reportOf(frame);
  expectOk(engine_->readOutput(image.rgba.data(), image.rgba.size()), "readOutput");
  return image;
}

std::vector<std::string> techniquesBut(Engine& engine, const std::vector<OptOut>& optOuts) {
  std::vector<std::string> ids;
  std::size_t leftOut = 0;
  for (std::size_t i = 0; i < engine.techniqueCount(); ++i) {
    const TechniqueRecord record = engine.technique(i);
    const bool named =
        std::ranges::any_of(optOuts, [&](const OptOut& o) { return o.id == std::string(record.id); });
    leftOut += named;
    if (!named && record.supported) ids.emplace_back(record.id);
  }
  EXPECT_EQ(leftOut, optOuts.size()) << "an opt-out names no technique";
  return ids;
}

void EngineTest::SetUp() {
  ASSERT_NE(headless(), nullptr) << contextFailure();
}

void EngineTest::TearDown() {
  if (headless() == nullptr) return;
  EXPECT_EQ(hostGl().getError(), static_cast<GLenum>(GL_NO_ERROR)) << "the test left an OpenGL ES error";
}

SceneRenderer& SharedEngineTest::renderer() {
  auto& shared = sharedRenderer();
  if (!shared) shared = std::make_unique<SceneRenderer>(makeEngine());
  return *shared;
}

bool SharedEngineTest::supports(const std::string& technique, std::string& reason) {
  Engine& engine = renderer().engine();
  for (std::size_t i = 0; i < engine.techniqueCount(); ++i) {
    const TechniqueRecord record = engine.technique(i);
    if (technique != record.id) continue;
    reason = record.unsupportedReason;
    return record.supported;
  }
  reason = "unknown";
  return false;
}

}  // namespace halfshadow::test
