// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/view.hpp"

#include <algorithm>

#include "scenes/view_command.hpp"

namespace halfshadow::viewer {
namespace {
bool isGround(const scene::SceneObject& object) {
  return object.name == "ground" && !object.casts;
}

bool hasGround(const scene::SceneDescription& scene) {
  return std::ranges::any_of(scene.objects, isGround);
}

bool sameCamera(const scene::Camera& a, const scene::Camera& b) {
  return a.eyeWorld == b.eyeWorld && a.targetWorld == b.targetWorld && a.up == b.up &&
         a.verticalFovRadians == b.verticalFovRadians;
}
}  // namespace

bool sameTruth(const View& a, const View& b) {
  return a.scene == b.scene && sameCamera(a.camera, b.camera) && a.width == b.width && a.height == b.height &&
         !a.lights.empty() && !b.lights.empty() && a.lights.front() == b.lights.front();
}

Status openScene(View& view, Keep keep) {
  scenes::SceneOptions options{.ground = view.ground,
                               .animationTimeSeconds = view.animationSeconds,
                               .animationIndex = view.animationIndex,
                               .up = view.up,
                               .sides = view.sides};
  const bool keeps = keep != Keep::nothing && view.scene != nullptr;
  if (keeps) {
    options.camera = view.camera;
    options.light = view.lights.front();
    options.moreLights.assign(view.lights.begin() + 1, view.lights.end());
    // Decided again for another camera, a ground could come and go.
    options.ground = hasGround(*view.scene) ? scenes::GroundMode::on : scenes::GroundMode::off;
    if (keep == Keep::ground) options.ground = scenes::GroundMode::off;
  }
  auto opened = scenes::openScene(view.source, options);
  if (!opened) return opened.error();
  if (keeps && keep == Keep::ground) {
    for (const scene::SceneObject& object : view.scene->objects) {
      if (isGround(object)) opened->objects.push_back(object);
    }
    scenes::fitNearAndFar(*opened->camera, *opened);
  }
  if (opened->lights.size() > static_cast<std::size_t>(kMaxLights)) opened->lights.resize(kMaxLights);
  view.camera = *opened->camera;
  view.lights = opened->lights;
  view.scene = std::make_shared<const scene::SceneDescription>(std::move(opened).value());
  return {};
}

std::string commandLine(const View& view, const std::string& program, const std::string& output) {
  scenes::ViewCommand command{.source = view.source, .camera = view.camera, .lights = view.lights};
  if (view.scene) command.ground = hasGround(*view.scene) ? scenes::GroundMode::on : scenes::GroundMode::off;
  command.up = view.up, command.sides = view.sides;
  command.animationSeconds = view.animationSeconds, command.animationIndex = view.animationIndex;
  command.technique = view.technique;
  command.settings.assign(view.choices.begin(), view.choices.end());
  command.forcedOff = view.forcedOff;
  command.driver = view.driver, command.deviceProfile = view.deviceProfile;
  command.width = view.width, command.height = view.height;
  return scenes::commandText(program, command, output);
}

}  // namespace halfshadow::viewer
