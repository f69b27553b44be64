// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What the viewer knows again when it is started the next time.
#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "viewer/view.hpp"

namespace halfshadow::viewer {

struct Remembered {
  int windowWidth = 1280, windowHeight = 720;
  std::optional<int> windowX, windowY;  ///< screen coordinates
  std::string source, technique;        ///< empty: none
  Choices choices;
  std::string tab = "Scene";
  bool showsHandles = true;
};

/// $XDG_CONFIG_HOME/halfshadow/viewer.json, or that of ~/.config; empty when neither is known.
std::string rememberedPath();
/// What the file says; defaults for all that is missing or malformed, so that no file can keep the viewer
/// from starting.
Remembered readRemembered(const std::string& path);
/// Makes the folder when it is missing. Errors: fileNotWritable.
Status writeRemembered(const std::string& path, const Remembered& remembered);

}  // namespace halfshadow::viewer
