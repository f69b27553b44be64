// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What is to be seen: everything that a command line of the tool can say, and nothing of how it is drawn.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "measure/engine_session.hpp"
#include "scene/scene_description.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::viewer {

/// Setting values that were chosen by hand, by key; all others have their start values.
using Choices = std::map<std::string, std::string>;

struct View {
  std::string source = "builtin:figure";  ///< as openScene takes it
  scenes::GroundMode ground = scenes::GroundMode::automatic;
  glm::dvec3 up{0, 1, 0};  ///< as in scenes::SceneOptions
  scenes::Sides sides = scenes::Sides::asInFile;
  int animationIndex = 0;
  double animationSeconds = 0.0;
  std::shared_ptr<const scene::SceneDescription> scene;  ///< null until one could be opened
  scene::Camera camera;
  std::vector<scene::AreaLight> lights;  ///< at most kMaxLights
  std::string technique = "auto";
  Choices choices;
  std::vector<std::string> forcedOff;  ///< capability names
  std::string driver = "default", deviceProfile = "auto";
  int width = 1, height = 1;  ///< of the picture, pixels
};

/// Whether both show the same surfaces from the same eye under the same first light: what a traced truth
/// depends on.
bool sameTruth(const View& a, const View& b);

/// Opens `view.source` anew, at its animation's time. Camera and lights of the scene replace those of the
/// view with Keep::nothing. With Keep::cameraAndLights they stay, and so does a ground that was added to the
/// scene before, so that nothing sways while an animation runs. On error the view is as it was. Errors: those
/// of scenes::openScene.
enum class Keep { nothing, cameraAndLights, ground };
Status openScene(View& view, Keep keep);

/// See scenes::commandText. Camera and lights are said even where they are the scene's own.
std::string commandLine(const View& view, const std::string& program, const std::string& output);

}  // namespace halfshadow::viewer
