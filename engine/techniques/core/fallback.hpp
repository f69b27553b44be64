// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a technique does instead where a device does not draw its programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace halfshadow::techniques {

/// A step down: other values of settings, or another technique with the settings that are set.
struct Fallback {
  std::string text;  ///< one clause, for the frame's report: "one map in place of several"
  std::vector<std::pair<std::string, std::string>> settings{};  ///< key and value, in place of what is set
  std::string technique{};                                      ///< its id; empty: the same
};

/// Visibility and shading in two passes, besides other settings.
Fallback shadedApart(std::vector<std::pair<std::string, std::string>> settings = {}, std::string text = {});

}  // namespace halfshadow::techniques
