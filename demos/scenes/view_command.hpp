// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A view as the words of a command line, which `halfshadow render` and the viewer both read.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/scene_source.hpp"

namespace halfshadow::scenes {

/// Words are left out where they say what a program does without them.
struct ViewCommand {
  std::string source;                      ///< as openScene takes it
  std::optional<scene::Camera> camera{};   ///< none: the scene's, or fitted
  std::vector<scene::AreaLight> lights{};  ///< none: the scene's, or a fitted one
  GroundMode ground = GroundMode::automatic;
  glm::dvec3 up{0, 1, 0};
  Sides sides = Sides::asInFile;
  double animationSeconds = 0.0;
  int animationIndex = 0;
  std::string technique{};
  std::vector<std::pair<std::string, std::string>> settings{};  ///< key and value of those that were chosen
  std::vector<std::string> forcedOff{};                         ///< capability names
  std::string driver = "default", eglLibrary{}, deviceProfile = "auto";
  int width = 0, height = 0;  ///< of the picture, pixels; 0: the program's own
};

/// `program`, the view, and `rest` ("-o picture.png"). Words are in quotes where a POSIX shell needs them.
/// Numbers are written so that they are read back as they are.
std::string commandText(const std::string& program, const ViewCommand& view, const std::string& rest);

/// The words of --camera and --light, without quotes: what parseCamera and parseLight read.
std::string cameraText(const scene::Camera& camera);
std::string lightText(const scene::AreaLight& light);

}  // namespace halfshadow::scenes
