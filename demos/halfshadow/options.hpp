// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Options that several commands share. All are checked while the command line is parsed, so that a bad one
/// is bad usage and costs nothing.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "measure/engine_session.hpp"
#include "scene/scene_description.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::cli {

struct SceneArguments {
  std::string source;
  std::string camera;               ///< empty = the scene's, or fitted
  std::vector<std::string> lights;  ///< none = the scene's, or a fitted one
  std::string ground = "auto";
  std::string up = "y", sides = "file";
  double animationTimeSeconds = 0.0;
  int animationIndex = 0;
};

struct SizeArguments {
  std::string text = "640x480";
  int width = 640, height = 480;
};

struct TruthArguments {
  int samples = 4096;
  double originLiftWorld = 0.0;
};

struct DriverArguments {
  std::string driver = "default", eglLibrary, deviceProfile = "auto";
  std::vector<std::string> force;  ///< "depth-texture=off"
  int threads = 1;
};

struct SettingArguments {
  std::vector<std::string> texts;  ///< "pcf.size=7"
};

/// A check for real options: what is wrong with the text, or empty.
std::string finiteProblem(const std::string& text);

/// A check for output options: the file's name ends with `extension` (".png").
CLI::Validator endsWith(const std::string& extension);

/// SCENE, --camera, --light, --ground, --up, --sides, --animation-time, --animation.
void addSceneArguments(CLI::App& app, SceneArguments& arguments);
/// --size.
void addSizeArgument(CLI::App& app, SizeArguments& arguments);
void addTruthArguments(CLI::App& app, TruthArguments& arguments);
/// --driver, --egl-library, --force, --device-profile, --threads.
void addDriverArguments(CLI::App& app, DriverArguments& arguments);
/// --set.
void addSettingArguments(CLI::App& app, SettingArguments& arguments);
/// --json.
void addJsonArgument(CLI::App& app, std::string& path);

scenes::SceneOptions sceneOptions(const SceneArguments& arguments);
std::vector<measure::Setting> settingsOf(const SettingArguments& arguments);

/// Opens the scene and says its notes on standard error. Its first light is the one that is measured.
Result<scene::SceneDescription> openScene(const SceneArguments& arguments);
Result<std::unique_ptr<measure::EngineSession>> openSession(const DriverArguments& arguments);
/// The error with the option in front that caused it.
Error named(const std::string& option, const Error& error);
/// invalidArgument when a side is above the device's limit.
Status checkSize(const SizeArguments& size, const measure::EngineSession& session);
/// The asked-for techniques ("all": every one), each once. Errors: unknownTechnique.
Result<std::vector<std::string>> chosenTechniques(measure::EngineSession& session,
                                                  const std::vector<std::string>& asked);

}  // namespace halfshadow::cli
