// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a light is drawn with where programs of the technique that was asked for draw nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "techniques/core/technique.hpp"

namespace halfshadow::api {

/// Kept beside the light, so that a frame does not begin again with what is known to draw nothing. Other
/// settings begin anew.
class LightFallbacks {
 public:
  using TechniqueNamed = std::function<techniques::Technique*(std::string_view id)>;
  struct Choice {
    techniques::Technique* technique = nullptr;              ///< null: nothing is left
    const techniques::Settings* settings = nullptr;          ///< valid for two more calls of choose()
    std::vector<std::pair<std::string, std::string>> notes;  ///< by technique given up: its id, and why
  };
  Choice choose(techniques::Technique& asked, const techniques::Settings& settings,
                const TechniqueNamed& techniqueNamed);
  /// `program` of a technique that choose() gave draws nothing: the next choice is another.
  void stepDown(const techniques::Technique& technique, const std::string& program);

 private:
  struct Steps {
    const techniques::Technique* technique = nullptr;
    std::size_t count = 0;
    std::string program;  ///< the last that drew nothing
  };
  const Steps* stepsOf(const techniques::Technique& technique) const;
  std::vector<Steps> steps_;
  std::uint64_t settingsRevision_ = 0;
  std::vector<std::unique_ptr<techniques::Settings>> changed_;
};

}  // namespace halfshadow::api
