// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <imgui.h>

#include <glm/trigonometric.hpp>

#include "scenes/builtin_scenes.hpp"
#include "viewer/panels.hpp"

namespace halfshadow::viewer {
namespace {
void sceneList(PanelInput& in) {
  const std::string& source = in.state.view.source;
  ImGui::SetNextItemWidth(-1);
  const bool isOpen = ImGui::BeginCombo("##scene", source.c_str(), ImGuiComboFlags_HeightLarge);
  in.controls.mark("scene");
  if (isOpen) {
    for (const scenes::BuiltinInfo& info : scenes::builtinScenes()) {
      const std::string name = "builtin:" + info.name;
      if (ImGui::Selectable(name.c_str(), source == name)) in.requests.open = name;
      in.controls.mark("scene/" + info.name);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.description.c_str());
    }
    ImGui::EndCombo();
  }
  help("Drop a .glb or .gltf file on the window to open it; it is read again whenever it changes.");
}

bool numbers(PanelInput& in, const char* label, const char* name, double* values, int count, float speed) {
  ImGui::SetNextItemWidth(-5.0f * ImGui::GetFontSize());
  const bool changed =
      ImGui::DragScalarN(label, ImGuiDataType_Double, values, count, speed, nullptr, nullptr, "%.3g");
  in.controls.mark(name);
  return changed;
}

void cameraNumbers(PanelInput& in) {
  scene::Camera& camera = in.state.view.camera;
  const float speed = static_cast<float>(0.003 * glm::distance(camera.eyeWorld, camera.targetWorld));
  scene::Camera edited = camera;
  numbers(in, "eye", "camera/eye", &edited.eyeWorld.x, 3, speed);
  numbers(in, "target", "camera/target", &edited.targetWorld.x, 3, speed);
  double degrees = glm::degrees(edited.verticalFovRadians);
  if (numbers(in, "view, deg", "camera/fov", &degrees, 1, 0.1f))
    edited.verticalFovRadians = glm::radians(glm::clamp(degrees, 1.0, 150.0));
  if (scene::checkCamera(edited)) camera = edited;
  if (namedButton(in, "As it was", "camera/reset")) in.requests.resetCamera = true;
}

void lightSizes(PanelInput& in, scene::AreaLight& light) {
  double sides[2] = {2 * glm::length(light.halfU), 2 * glm::length(light.halfV)};
  const double least = 1e-3 * (sides[0] + sides[1]);
  if (light.halfU == glm::dvec3(0.0)) {
    help("A point: it has no sides.");
    return;
  }
  const double before[2] = {sides[0], sides[1]};
  if (!numbers(in, "sides", "light/sides", sides, 2, static_cast<float>(0.01 * (sides[0] + sides[1]))))
    return;
  light.halfU *= glm::max(sides[0], least) / before[0];
  light.halfV *= glm::max(sides[1], least) / before[1];
}

void lightNumbers(PanelInput& in) {
  std::vector<scene::AreaLight>& lights = in.state.view.lights;
  std::size_t& chosen = in.state.light;
  chosen = std::min(chosen, lights.size() - 1);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    const std::string name = std::to_string(i + 1);
    if (namedRadio(in, name.c_str(), "light/" + name, chosen == i)) chosen = i;
  }
  scene::AreaLight& light = lights[chosen];
  const float speed =
      static_cast<float>(0.003 * glm::distance(light.centerWorld, in.state.view.camera.targetWorld));
  numbers(in, "centre", "light/center", &light.centerWorld.x, 3, speed);
  lightSizes(in, light);
  ImGui::SetNextItemWidth(-5.0f * ImGui::GetFontSize());
  ImGui::ColorEdit3("colour", &light.color.x, ImGuiColorEditFlags_Float);
  in.controls.mark("light/color");
  double strength = light.intensity;
  if (numbers(in, "strength", "light/intensity", &strength, 1, 0.01f))
    light.intensity = glm::max(strength, 0.0);
  const glm::dvec3 pivot = in.state.view.camera.targetWorld;
  if (lights.size() < static_cast<std::size_t>(kMaxLights)) {
    if (namedButton(in, "Add a light", "light/add")) {
      lights.push_back(anotherLight(lights.back(), pivot));
      chosen = lights.size() - 1;
    }
    ImGui::SameLine();
  }
  if (lights.size() > 1) {
    if (namedButton(in, "Remove", "light/remove")) lights.erase(lights.begin() + static_cast<long>(chosen));
    ImGui::SameLine();
  }
  if (namedButton(in, "As they were", "light/reset")) in.requests.resetLights = true;
  namedCheckbox(in, "Handles in the picture", "light/handles", in.state.showsHandles);
}

void animationList(PanelInput& in) {
  UiState& state = in.state;
  if (state.animations.size() < 2) return;
  int& index = state.view.animationIndex;
  const std::string now = index < 0 ? "rest pose" : state.animations[static_cast<std::size_t>(index)].name;
  ImGui::SetNextItemWidth(-1);
  const bool isOpen = ImGui::BeginCombo("##animation", now.c_str());
  in.controls.mark("animation");
  if (!isOpen) return;
  for (int i = 0; i < static_cast<int>(state.animations.size()); ++i) {
    ImGui::PushID(i);  // names may repeat
    if (ImGui::Selectable(state.animations[static_cast<std::size_t>(i)].name.c_str(), i == index)) {
      index = i;
      state.view.animationSeconds = 0.0;
      in.requests.repose = true;
    }
    ImGui::PopID();
    in.controls.mark("animation/" + std::to_string(i));
  }
  ImGui::EndCombo();
}

void motion(PanelInput& in) {
  UiState& state = in.state;
  if (!state.animations.empty()) {
    animationList(in);
    const scenes::AnimationInfo& info =
        state.animations[static_cast<std::size_t>(std::max(state.view.animationIndex, 0))];
    if (namedButton(in, state.playing ? "Pause" : "Play", "animation/play")) {
      state.playing = !state.playing;
      if (!state.playing) in.requests.repose = true;
    }
    ImGui::SameLine();
    float seconds = static_cast<float>(state.view.animationSeconds);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##time", &seconds, 0.0f, static_cast<float>(info.seconds), "%.3f s")) {
      state.view.animationSeconds = static_cast<double>(seconds);
      state.playing = false;
      in.requests.repose = true;
    }
    in.controls.mark("animation/time");
  }
  constexpr std::pair<const char*, PathRun> kPaths[] = {
      {"off", PathRun::off}, {"camera", PathRun::camera}, {"light", PathRun::light}, {"both", PathRun::both}};
  ImGui::TextUnformatted("Path");
  for (const auto& [label, path] : kPaths) {
    ImGui::SameLine();
    if (namedRadio(in, label, std::string("path/") + label, state.path == path)) state.path = path;
  }
}
}  // namespace

void scenePanel(PanelInput& in) {
  sceneList(in);
  if (!in.state.view.scene) return;
  heading("Motion");
  motion(in);
  heading("Light");
  lightNumbers(in);
  heading("Camera");
  cameraNumbers(in);
  heading("Notes of the file");
  for (const std::string& note : in.state.view.scene->notes) help(note);
  if (in.state.view.scene->notes.empty()) help("none");
}

}  // namespace halfshadow::viewer
