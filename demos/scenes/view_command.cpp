// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/view_command.hpp"

#include <charconv>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace halfshadow::scenes {
namespace {
/// The shortest text that is read back as the same number.
std::string numberText(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value);
  return {text, end};
}

std::string numbersText(const glm::dvec3& v) {
  return numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
}

std::string vectorText(const char* key, const glm::dvec3& v) {
  return std::string(key) + "=" + numbersText(v);
}

std::string quoted(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Degrees that become these radians again: one rounding there and one back may miss by the last digit.
double degreesOf(double radians) {
  double degrees = glm::degrees(radians);
  for (const double candidate : {degrees, std::nextafter(degrees, 0.0), std::nextafter(degrees, 180.0)}) {
    if (glm::radians(candidate) == radians) return candidate;
  }
  return degrees;
}

class Words {
 public:
  explicit Words(std::string text) : text_(std::move(text)) {}
  void add(const char* option, const std::string& value) {
    // A value that begins with '-' would be taken for an option.
    const bool isGlued = value.starts_with('-');
    text_ += std::string(" ") + option + (isGlued ? "=" : " ") + quoted(value);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void addScene(const ViewCommand& view, Words& words) {
  if (view.camera) words.add("--camera", cameraText(*view.camera));
  for (const scene::AreaLight& light : view.lights) words.add("--light", lightText(light));
  if (view.ground != GroundMode::automatic)
    words.add("--ground", view.ground == GroundMode::on ? "on" : "off");
  if (view.up != glm::dvec3(0, 1, 0)) words.add("--up", numbersText(view.up));
  if (view.sides == Sides::both) words.add("--sides", "both");
  if (view.animationSeconds != 0.0) words.add("--animation-time", numberText(view.animationSeconds));
  if (view.animationIndex != 0) words.add("--animation", std::to_string(view.animationIndex));
}

void addDevice(const ViewCommand& view, Words& words) {
  for (const std::string& name : view.forcedOff) words.add("--force", name + "=off");
  if (view.driver != "default") words.add("--driver", view.driver);
  if (!view.eglLibrary.empty()) words.add("--egl-library", view.eglLibrary);
  if (view.deviceProfile != "auto") words.add("--device-profile", view.deviceProfile);
}
}  // namespace

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

std::string commandText(const std::string& program, const ViewCommand& view, const std::string& rest) {
  // A file whose name begins with '-' would be taken for an option as well.
  Words words(program + " " + quoted((view.source.starts_with('-') ? "./" : "") + view.source));
  addScene(view, words);
  if (!view.technique.empty()) words.add("-t", view.technique);
  for (const auto& [key, value] : view.settings) words.add("--set", key + "=" + value);
  addDevice(view, words);
  if (view.width > 0) words.add("--size", std::to_string(view.width) + "x" + std::to_string(view.height));
  return words.take() + (rest.empty() ? "" : " " + rest);
}

}  // namespace halfshadow::scenes
