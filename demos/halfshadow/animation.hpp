// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What moves in `render --frames`.
#pragma once

#include "options.hpp"

namespace halfshadow::cli {

enum class Motion {
  light,   ///< the light's centre goes once round a circle in the light's plane, a tenth of its distance wide
  camera,  ///< the camera goes once round its target
  time     ///< the file's animation runs
};

class Animation {
 public:
  /// `first` is the scene at its first frame. For Motion::time each frame is loaded again, `framesPerSecond`
  /// apart; camera, light and ground that were fitted stay those of the first frame.
  Animation(SceneArguments arguments, scene::SceneDescription first, Motion motion, int frames,
            double framesPerSecond);
  /// Frame 0 is the scene as it was opened. Errors: those of openScene.
  Result<scene::SceneDescription> sceneAt(int frame) const;

 private:
  Result<scene::SceneDescription> poseAt(int frame) const;
  SceneArguments arguments_;
  scene::SceneDescription first_;
  Motion motion_;
  int frames_;
  double framesPerSecond_;
};

/// out.png, 3 → out_0003.png
std::string framePath(const std::string& path, int frame);

}  // namespace halfshadow::cli
