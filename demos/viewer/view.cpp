// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/view.hpp"

#include <algorithm>
#include <charconv>
#include <glm/trigonometric.hpp>

#include "scenes/camera_light_options.hpp"

namespace halfshadow::viewer {
namespace {
/// The shortest text that is read back as the same number.
std::string numberText(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value);
  return {text, end};
}

std::string vectorText(const char* key, const glm::dvec3& v) {
  return std::string(key) + "=" + numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
}

std::string quoted(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

bool isGround(const scene::SceneObject& object) {
  return object.name == "ground" && !object.casts;
}

bool hasGround(const scene::SceneDescription& scene) {
  return std::ranges::any_of(scene.objects, isGround);
}

/// Degrees that become these radians again: one rounding there and one back may miss by the last digit.
double degreesOf(double radians) {
  double degrees = glm::degrees(radians);
  for (const double candidate : {degrees, std::nextafter(degrees, 0.0), std::nextafter(degrees, 180.0)}) {
    if (glm::radians(candidate) == radians) return candidate;
  }
  return degrees;
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
                               .animationIndex = view.animationIndex};
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

std::string cameraText(const scene::Camera& camera) {
  return vectorText("eye", camera.eyeWorld) + " " + vectorText("target", camera.targetWorld) +
         " fov=" + numberText(degreesOf(camera.verticalFovRadians)) + " " + vectorText("up", camera.up);
}

std::string lightText(const scene::AreaLight& light) {
  std::string text = vectorText("center", light.centerWorld) + " " + vectorText("u", light.halfU) + " " +
                     vectorText("v", light.halfV);
  if (light.halfU == glm::dvec3(0.0) && light.halfV == glm::dvec3(0.0))
    text += " " + vectorText("emission", light.emission);
  return text + " " + vectorText("color", glm::dvec3(light.color)) +
         " intensity=" + numberText(light.intensity) + " reference=" + numberText(light.referenceDistance);
}

std::string commandLine(const View& view, const std::string& program, const std::string& output) {
  std::string text = program + " " + quoted(view.source);
  const auto add = [&](const std::string& option, const std::string& value) {
    text += " " + option + " " + quoted(value);
  };
  add("--camera", cameraText(view.camera));
  for (const scene::AreaLight& light : view.lights) add("--light", lightText(light));
  if (view.scene) add("--ground", hasGround(*view.scene) ? "on" : "off");
  if (view.animationSeconds != 0.0) add("--animation-time", numberText(view.animationSeconds));
  if (view.animationIndex != 0) add("--animation", std::to_string(view.animationIndex));
  add("-t", view.technique);
  for (const auto& [key, value] : view.choices) add("--set", key + "=" + value);
  for (const std::string& name : view.forcedOff) add("--force", name + "=off");
  if (view.driver != "default") add("--driver", view.driver);
  if (view.deviceProfile != "auto") add("--device-profile", view.deviceProfile);
  add("--size", std::to_string(view.width) + "x" + std::to_string(view.height));
  if (!output.empty()) text += " " + output;
  return text;
}

}  // namespace halfshadow::viewer
