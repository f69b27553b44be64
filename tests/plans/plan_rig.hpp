// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A scene as planners get it, without an engine and without GL.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/scene_description.hpp"
#include "techniques/core/technique.hpp"

namespace halfshadow::test {

/// All there are, at the limits of a small device, but those named.
device::Capabilities capabilitiesWithout(const std::vector<device::Capability>& missing);

/// What a light's planner leaves.
struct Planned {
  Status status;
  techniques::PassPlan plan;
};

class PlanRig {
 public:
  /// `settings`: of the techniques that are planned.
  PlanRig(const scene::SceneDescription& scene, device::Capabilities capabilities,
          std::vector<techniques::SettingInfo> settings);

  /// Moves the last caster by a tenth of its size.
  void moveCaster();
  /// Moves the light by a hundredth of its distance.
  void moveLight();
  /// What planners refer to until the next call.
  const techniques::LightScene& prepare(int channel);
  /// One frame of the light that has this place among the frame's lights.
  Planned plan(techniques::LightPlanner& planner, int channel = 0);
  const device::Capabilities& capabilities() const { return capabilities_; }
  scene::CasterSilhouettes& silhouettes() { return silhouettes_; }
  techniques::Settings& settings() { return settings_; }

 private:
  struct Object {
    std::uint64_t id = 0;
    scene::SceneObject source;
    scene::CasterGeometry geometry;
    std::uint64_t revision = 0;
    std::vector<glm::dvec3> pointsWorld;
  };
  techniques::DrawItem itemOf(const Object& object) const;

  device::Capabilities capabilities_;
  techniques::Settings settings_;
  std::vector<std::unique_ptr<Object>> objects_;
  scene::AreaLight light_;
  techniques::View screen_;
  std::uint64_t lastRevision_ = 0, lightRevision_ = 1;
  std::vector<planner::CasterShape> casterShapes_;
  std::vector<techniques::DrawItem> casters_, receivers_, shadowlessReceivers_;
  scene::CasterGroups groups_;
  scene::CasterSilhouettes silhouettes_;
  std::unique_ptr<techniques::LightScene> scene_;
};

}  // namespace halfshadow::test
