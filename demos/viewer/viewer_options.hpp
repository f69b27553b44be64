// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The viewer's command line: what `halfshadow render` takes to make a picture, and how to look at it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/ui_state.hpp"
#include "window/window.hpp"

namespace halfshadow::viewer {

struct ViewerOptions {
  View view;  ///< without its scene
  bool sceneIsGiven = false, techniqueIsGiven = false;
  std::optional<scene::Camera> camera;
  std::vector<scene::AreaLight> lights;
  std::optional<int> windowWidth, windowHeight;  ///< screen coordinates
  std::optional<int> fixedWidth, fixedHeight;    ///< of the picture, pixels
  std::optional<int> windowX, windowY;           ///< as remembered
  WindowOptions::Context context = WindowOptions::Context::any;
  Showing showing = Showing::shaded;
  std::string beside;  ///< a technique's id or "truth"; empty = nothing
  double scale = 0.0;  ///< of text and panels; 0 = the desktop's
  std::string script, screenshot, json, controls, remember = "auto";
  int samples = 4096;  ///< of the truth
  int frames = 0;      ///< 0 = until the script ends, or the window is closed
  bool isScripted() const { return !script.empty() || frames > 0 || !screenshot.empty(); }
};

/// Nothing when the program should end with `status`: after --help, or with what is wrong said.
std::optional<ViewerOptions> parseOptions(int argc, char** argv, int& status);

}  // namespace halfshadow::viewer
