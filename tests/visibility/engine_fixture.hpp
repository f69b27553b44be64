// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Rendering scenes through the public interface, on the driver named by HALFSHADOW_TEST_DRIVER ("llvmpipe"
/// when unset), with the capabilities in HALFSHADOW_TEST_FORCE (separated by commas) treated as absent.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "egl/headless.hpp"
#include "gl/functions.hpp"
#include "halfshadow/halfshadow.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::test {

/// The images of this folder: 4:3, small enough that every technique meets every scene on every rung.
inline constexpr int kWidth = 192, kHeight = 144;

/// The process's context, or a null pointer with the reason in contextFailure().
HeadlessContext* headless();
const std::string& contextFailure();
/// The driver's functions, for what a host does itself.
const gl::Functions& hostGl();
std::vector<std::string> forcedOffByEnvironment();
bool isForcedOff(const std::string& capability);

/// An engine on the process's context. `alsoForcedOff` adds to the environment's list.
std::unique_ptr<Engine> makeEngine(const std::vector<std::string>& alsoForcedOff = {},
                                   HostState hostState = HostState::restore);

/// Opens "figure@light=1" and the like; a failure is a test failure and gives an empty scene. Kept for the
/// process.
const scene::SceneDescription& builtinScene(const std::string& name);

CameraDesc cameraDesc(const scene::Camera& camera);
LightDesc lightDesc(const scene::AreaLight& light);
/// Points into `object`.
ObjectDesc objectDesc(const scene::SceneObject& object);

struct Setting {
  std::string key, value;
};
/// A technique and what differs from its defaults.
struct Configuration {
  std::string technique;
  std::vector<Setting> settings{};
  std::string text() const;
};

/// RGBA8 as the engine delivered it, row 0 on top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  std::uint8_t byte(std::size_t pixel, int channel = 0) const {
    return rgba[4 * pixel + static_cast<std::size_t>(channel)];
  }
  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::vector<float> visibility(int channel = 0) const;
};

struct Pass {
  std::string name;
  bool lightSpace = false;
};
struct Skip {
  std::string what, why;
};
/// A FrameReport as values.
struct Report {
  std::vector<Pass> passes;
  std::vector<Skip> skips;
  std::uint64_t framebufferSwitches = 0, draws = 0, textureBytesUploaded = 0, bufferBytesUploaded = 0;
  std::size_t lightPasses() const;
  bool hasSkip(const std::string& what, const std::string& whyPart) const;
};

/// An engine that holds one scene at a time.
class SceneRenderer {
 public:
  explicit SceneRenderer(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
  Engine& engine() { return *engine_; }

  /// Replaces objects, lights and camera. The engine and its compiled programs stay.
  void load(const scene::SceneDescription& scene);
  void setLights(const std::vector<scene::AreaLight>& lights);
  void setTransform(std::size_t object, const glm::dmat4& worldFromObject);
  ObjectId id(std::size_t object) const { return ids_[object]; }
  /// Chooses the technique; settings that an earlier call changed go back to their defaults.
  void choose(const Configuration& configuration);

  Image render(Output output = Output::visibility);
  Image render(const Configuration& configuration, Output output = Output::visibility) {
    choose(configuration);
    return render(output);
  }
  /// Of the last frame.
  const Report& report() const { return report_; }
  RenderDesc& desc() { return desc_; }

 private:
  std::unique_ptr<Engine> engine_;
  std::vector<ObjectId> ids_;
  std::vector<Setting> defaultsOfChanged_;
  RenderDesc desc_;
  Report report_;
};

Report reportOf(const FrameReport& report);

/// A technique that a test leaves out, and why.
struct OptOut {
  const char* id;
  const char* reason;
};
/// All techniques of the engine that this device supports, in its order, without those named. A new technique
/// is tested without being asked; an opt-out that names none is a test failure.
std::vector<std::string> techniquesBut(Engine& engine, const std::vector<OptOut>& optOuts);

/// Fails when the driver is missing; after each test the context has no OpenGL ES error.
class EngineTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
};

/// The same with an engine that all tests of the process share: programs compile once. It has the settings
/// and scene that the test before left; `renderer()` resets neither.
class SharedEngineTest : public EngineTest {
 protected:
  static SceneRenderer& renderer();
  static bool supports(const std::string& technique, std::string& reason);
};

}  // namespace halfshadow::test
