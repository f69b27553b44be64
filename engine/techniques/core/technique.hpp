// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a technique is: what it says of itself, and the planner that it gives to each light. No GL.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "device/capabilities.hpp"
#include "techniques/core/fallback.hpp"
#include "techniques/core/light_scene.hpp"
#include "techniques/core/pass_plan.hpp"
#include "techniques/core/settings.hpp"
#include "techniques/core/shader_families.hpp"

namespace halfshadow::techniques {

struct TechniqueInfo {
  std::string id;
  std::string paper;  ///< author, year, section
  std::string summary;
  std::string guarantees;     ///< what holds exactly
  std::string knownFailures;  ///< what it gets wrong by construction
  /// It takes casters by their outlines, which follow alpha as far as triangles can.
  bool takesOutlines = false;
};

struct Support {
  bool supported = true;
  std::string reason;  ///< the missing capability by name, and what would provide it
};

/// What a technique makes of setting sub_lights.
enum class SubLightUse {
  none,       ///< it sees the light whole
  whenAsked,  ///< whole at `auto`
  automatic   ///< as many at `auto` as planner::chooseSubLights() says
};

class Technique {
 public:
  virtual ~Technique() = default;
  virtual const TechniqueInfo& info() const = 0;
  virtual std::vector<SettingInfo> settings() const { return {}; }
  virtual Support support(const device::Capabilities& capabilities) const {
    (void)capabilities;
    return {};
  }
  /// Of all programs that its planners may ask for; others are refused. Those that several techniques declare
  /// alike count once.
  virtual std::vector<ShaderFamily> shaderFamilies() const { return {}; }
  /// Asked each frame before planning, about geometry alone. Lights whose visibility a host evaluates itself
  /// keep their technique, since a stand-in may work on the screen only.
  virtual std::optional<StandIn> standIn(const LightScene& scene) const {
    (void)scene;
    return std::nullopt;
  }
  virtual SubLightUse subLightUse(const Settings& settings) const {
    (void)settings;
    return SubLightUse::none;
  }
  /// What setting sub_lights is decided from; `mapSize` is the setting's.
  virtual planner::SubLightNeeds subLightNeeds(const Settings& settings, int mapSize) const {
    (void)settings;
    return {.mapSize = mapSize};
  }
  /// Taken one after another, each in place of the one before, where a program of the technique draws nothing
  /// on the device. After the last, `hard` takes the light, and after it `none`.
  virtual std::vector<Fallback> fallbacks() const { return {}; }
  /// For a light that takes this technique; the engine keeps it beside the light.
  virtual std::unique_ptr<LightPlanner> newPlanner() const = 0;
};

}  // namespace halfshadow::techniques
