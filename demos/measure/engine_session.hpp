// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A headless context with an engine in it that holds one scene: what the command line tool renders with.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "egl/headless.hpp"
#include "halfshadow/halfshadow.hpp"
#include "scene/scene_description.hpp"
#include "threads/worker_threads.hpp"

namespace halfshadow::measure {

struct SessionOptions {
  std::string driver = "default";        ///< see HeadlessOptions::driver
  std::string eglLibrary;                ///< see HeadlessOptions::eglLibrary
  std::vector<std::string> forcedOff{};  ///< capability names
  int threads = 1;                       ///< that the engine may use, the calling one among them
  std::string deviceProfile = "auto";    ///< see deviceSettings
  HostState hostState = HostState::leaveDirty;
};

/// A context of the caller's: current on this thread whenever the session is used, and alive as long as it.
struct HostContext {
  void* (*getProcAddress)(const char* name, void* user) = nullptr;
  void* user = nullptr;
  std::string description;  ///< how it was opened, one line
};

struct Setting {
  std::string key, value;  ///< "pcf.size", "7"
};

/// An image as the engine delivered it, row 0 on top.
struct RgbaImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< width × height × 4
};

CameraDesc cameraDesc(const scene::Camera& camera);
/// A ten-millionth of its distance nearer: to the engine another view, in which everything that the camera
/// sees is drawn again, with the same picture but for rounding. For measuring frames with an unchanged light,
/// since of a wholly unchanged frame nothing is drawn.
CameraDesc nudged(const CameraDesc& camera);
LightDesc lightDesc(const scene::AreaLight& light);

class EngineSession {
 public:
  /// Opens the driver, makes its context current and an engine in it. Errors: invalidArgument (unknown driver
  /// or capability), driverMissing.
  static Result<std::unique_ptr<EngineSession>> open(const SessionOptions& options);
  /// An engine in a context that is there already; `options.driver` and `eglLibrary` are not read. Errors:
  /// those of Engine::create; invalidArgument (unknown capability), fileNotFound, fileMalformed (profile).
  static Result<std::unique_ptr<EngineSession>> openIn(const HostContext& context,
                                                       const SessionOptions& options);
  ~EngineSession();
  EngineSession(const EngineSession&) = delete;
  EngineSession& operator=(const EngineSession&) = delete;

  Engine& engine() { return *engine_; }
  /// Texture and renderbuffer limit of this device, pixels.
  int sizeLimit() const;
  /// How the context was opened, one line.
  const std::string& contextDescription() const { return host_.description; }

  /// A new engine in the same context: no objects, no caches, default settings. Measurements start here, so
  /// that none pays for, or profits from, what another left.
  Status renewEngine();
  /// Uploads the scene's objects and sets its first light (the scene has one). Only onto a new engine.
  /// Errors: those of Engine::addObject, with the object's name.
  Status load(const scene::SceneDescription& scene);
  /// Brings the objects of a loaded scene to those of `scene`: by new transforms and vertices where the
  /// triangles stayed the same, else by loading all again. Lights stay. Errors: those of load.
  Status update(const scene::SceneDescription& scene);
  /// Replaces the light(s).
  Status setLights(const std::vector<scene::AreaLight>& lights);
  /// Errors: unknownTechnique, capabilityMissing, unknownSetting, invalidArgument.
  Status choose(const std::string& technique, const std::vector<Setting>& settings);
  Status set(const std::vector<Setting>& settings);

  /// Renders one frame into the engine's own target. `report` is valid until the next call.
  Status render(const RenderDesc& desc, FrameReport& report);
  Status render(const RenderDesc& desc);
  /// Pixels of the last frame.
  Result<RgbaImage> read(int width, int height);

 private:
  EngineSession() = default;
  Status addObjects(const scene::SceneDescription& scene);
  Status updateObject(std::size_t index, const scene::SceneObject& object);
  SessionOptions options_;
  std::unique_ptr<HeadlessContext> context_;  ///< null in a context of the caller's
  HostContext host_;
  WorkerThreads threads_{1};
  std::unique_ptr<Engine> engine_;
  std::vector<ObjectId> objectIds_;
  std::vector<scene::SceneObject> objects_;  ///< as loaded, without images; meshes are shared
};

/// Which bytes of a visibility frame hold the value: Output::visibility or Output::visibility16.
std::vector<float> decodeVisibility(const RgbaImage& image, Output output);
/// Texture fetches per pixel of an Output::taps frame.
std::vector<std::uint32_t> decodeTaps(const RgbaImage& image);

/// What users get of a technique: 16 bits of `sampled` and 8 bits of all others.
Output visibilityOutputOf(const std::string& technique);

}  // namespace halfshadow::measure
