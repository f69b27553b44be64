// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a hand does, from the window system or from a script: both take the same way.
#pragma once

#include <string>
#include <vector>

namespace halfshadow::viewer {

struct InputEvent {
  enum class Kind { move, button, scroll, key, text, drop };
  Kind kind = Kind::move;
  double x = 0.0, y = 0.0;  ///< move: window coordinates; scroll: steps
  int code = 0;             ///< button: 0 left, 1 right, 2 middle; key: a Window::Key
  bool pressed = false;
  int modifiers = 0;  ///< a sum of Window::Modifier
  unsigned codepoint = 0;
  std::vector<std::string> paths;
};

}  // namespace halfshadow::viewer
