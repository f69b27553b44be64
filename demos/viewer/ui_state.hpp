// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What the panels show and change, beside the view itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf_animations.hpp"
#include "viewer/light_handles.hpp"
#include "viewer/view.hpp"

namespace halfshadow::viewer {

enum class Compare { off, technique, truth };
enum class Showing { shaded, visibility };
enum class PathRun { off, camera, light, both };

struct UiState {
  View view;
  scene::Camera homeCamera;                  ///< of the scene as it was opened
  std::vector<scene::AreaLight> homeLights;  ///< likewise

  Showing showing = Showing::shaded;
  Compare compare = Compare::off;
  std::string otherTechnique = "hard";
  double slider = 0.5;  ///< share of the picture's width that the first technique has
  bool heatMap = false;
  double heatFull = 0.1;  ///< error at the end of the colours
  bool magnifier = false;

  bool showsHandles = true, showsPanels = true, showsKeys = false;
  bool showsSilhouettes = false, showsWedges = false;
  bool seenFromLight = false;
  scene::Camera besideLight;  ///< to go back to
  std::size_t light = 0;      ///< whose numbers the panel shows
  std::string tab = "Scene";
  std::string image;  ///< of those to look inside; empty: the first
  int imageWay = 1;   ///< a Shown: what its bytes mean

  bool measures = false;
  bool playing = false;  ///< the file's animation
  std::vector<scenes::AnimationInfo> animations;
  PathRun path = PathRun::off;

  std::string message;     ///< an error, until the next thing that works
  std::string news;        ///< what was done
  double newsUntil = 0.0;  ///< seconds of the window's clock
};

/// What panels ask for; done once they are drawn.
struct Requests {
  std::optional<std::string> open;  ///< a scene
  bool reload = false;
  bool repose = false;  ///< the animation's time is another
  bool resetCamera = false, resetLights = false;
  bool copyCommand = false, savePicture = false, saveVisibility = false;
  bool toggleLightView = false;
  bool reopenEngine = false;  ///< what is forced off is another
};

}  // namespace halfshadow::viewer
