// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Names of what is on the panels, so that scripts find by name what hands find by eye.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viewer/script.hpp"

namespace halfshadow::viewer {

class Controls {
 public:
  /// Names the ImGui item that was drawn last; spaces become '-'.
  void mark(std::string name);
  /// Names a place of the picture.
  void markPlace(const std::string& name, const Place& place) { drawn_[name] = place; }
  /// When all of a frame was named: find() answers by it from then on.
  void endFrame();
  /// Of the last frame. What lies outside of its window is scrolled to, and found in a later frame.
  std::optional<Place> find(const std::string& name);
  std::vector<std::string> names() const;

 private:
  std::map<std::string, Place> drawn_, last_;
  std::string wanted_;
};

}  // namespace halfshadow::viewer
