// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/camera_light_options.hpp"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <map>
#include <span>
#include <string>

#include "scenes/numbers.hpp"

namespace halfshadow::scenes {
namespace {
using Words = std::map<std::string_view, std::string_view>;

/// The text as key=value words. Fails with `code` on a repeated or unknown key or a word without '='.
Result<Words> wordsOf(std::string_view text, std::string_view what, std::string_view form, ErrorCode code) {
  Words words;
  const auto keyIsKnown = [&](std::string_view key) {
    return (" " + std::string(form)).find(" " + std::string(key) + "=") != std::string::npos;
  };
  for (const std::string_view word : splitAt(text, ' ')) {
    if (word.empty()) continue;
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    if (equals == std::string_view::npos || !keyIsKnown(key)) {
      return Error{code, std::string(what) + ": '" + std::string(word) + "' is not understood; write " +
                             std::string(form) + " with spaces only between the words"};
    }
    if (!words.try_emplace(key, word.substr(equals + 1)).second) {
      return Error{code, std::string(what) + ": '" + std::string(key) + "' is given twice; leave one out"};
    }
  }
  return words;
}

Result<glm::dvec3> vectorOf(const Words& words, std::string_view key, std::string_view what, ErrorCode code) {
  const auto found = words.find(key);
  const std::string label = std::string(what) + ": '" + std::string(key);
  if (found == words.end()) return Error{code, label + "=x,y,z' is missing; add it"};
  const auto parts = splitAt(found->second, ',');
  glm::dvec3 value(0.0);
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> number = parts.size() == 3 ? parseNumber(parts[i]) : std::nullopt;
    if (!number) {
      return Error{code, label + "=" + std::string(found->second) + "' is not three finite numbers like " +
                             std::string(key) + "=1,2.5,-3"};
    }
    value[i] = *number;
  }
  return value;
}

Result<scene::AreaLight> aimedLight(const Words& words) {
  constexpr std::string_view kWhat = "--light";
  const auto center = vectorOf(words, "center", kWhat, ErrorCode::invalidLight);
  if (!center) return center.error();
  const auto target = vectorOf(words, "target", kWhat, ErrorCode::invalidLight);
  if (!target) return target.error();
  glm::dvec3 up(0, 1, 0);
  if (words.contains("up")) {
    const auto given = vectorOf(words, "up", kWhat, ErrorCode::invalidLight);
    if (!given) return given.error();
    up = *given;
  }
  const auto size = words.find("size");
  if (size == words.end()) {
    return Error{ErrorCode::invalidLight,
                 "--light: 'size=WxH' is missing; add the full side lengths, e.g. size=2x2"};
  }
  const auto parts = splitAt(size->second, 'x');
  const auto width = parseNumber(parts.front()), height = parseNumber(parts.back());
  if (parts.size() > 2 || !width || !height) {
    return Error{ErrorCode::invalidLight, "--light: 'size=" + std::string(size->second) +
                                              "' is not WxH; give two numbers like size=2x1.5"};
  }
  return scene::areaLightAimed(*center, *target, *width, *height, up);
}
Result<scene::AreaLight> placedLight(const Words& words) {
  constexpr std::string_view kWhat = "--light";
  constexpr ErrorCode kCode = ErrorCode::invalidLight;
  const bool hasVectors = words.contains("u") || words.contains("v") || words.contains("emission");
  const bool isAimed = words.contains("target") || words.contains("size") || words.contains("up");
  if (hasVectors && isAimed) {
    return Error{kCode, "--light: u, v and emission cannot be mixed with target, size or up; give one form"};
  }
  if (!hasVectors) return aimedLight(words);
  const auto center = vectorOf(words, "center", kWhat, kCode);
  if (!center) return center.error();
  const auto u = vectorOf(words, "u", kWhat, kCode);
  if (!u) return u.error();
  const auto v = vectorOf(words, "v", kWhat, kCode);
  if (!v) return v.error();
  auto light = scene::areaLightFromVectors(*center, *u, *v);
  if (!light || !words.contains("emission")) return light;
  const auto emission = vectorOf(words, "emission", kWhat, kCode);
  if (!emission) return emission.error();
  const double length = glm::length(*emission);
  if (light->halfU != glm::dvec3(0.0) || !(length > 0.0)) {
    return Error{
        kCode,
        "--light: 'emission' is a direction, for points (u=0,0,0 v=0,0,0) only; leave it out or give "
        "one like emission=0,-1,0"};
  }
  light->emission = *emission / length;
  return light;
}

/// A number >= 0 that may be left out.
Status readNumber(const Words& words, std::string_view key, double& value) {
  const auto found = words.find(key);
  if (found == words.end()) return {};
  const auto number = parseNumber(found->second);
  if (!number || *number < 0.0) {
    return Error{ErrorCode::invalidLight, "--light: '" + std::string(key) + "=" + std::string(found->second) +
                                              "' is not a number from 0; write it like " + std::string(key) +
                                              "=2.5"};
  }
  value = *number;
  return {};
}

Status readStrength(const Words& words, scene::AreaLight& light) {
  if (words.contains("color")) {
    const auto color = vectorOf(words, "color", "--light", ErrorCode::invalidLight);
    if (!color) return color.error();
    light.color = glm::vec3(*color);
  }
  if (Status status = readNumber(words, "intensity", light.intensity); !status) return status;
  return readNumber(words, "reference", light.referenceDistance);
}
}  // namespace

Result<scene::Camera> parseCamera(std::string_view text) {
  constexpr std::string_view kWhat = "--camera";
  constexpr ErrorCode kCode = ErrorCode::invalidCamera;
  const Result<Words> words = wordsOf(text, kWhat, "eye=x,y,z target=x,y,z fov=DEGREES up=x,y,z", kCode);
  if (!words) return words.error();
  const auto eye = vectorOf(*words, "eye", kWhat, kCode);
  if (!eye) return eye.error();
  const auto target = vectorOf(*words, "target", kWhat, kCode);
  if (!target) return target.error();
  scene::Camera camera{.eyeWorld = *eye, .targetWorld = *target, .verticalFovRadians = glm::radians(34.0)};
  if (const auto fov = words->find("fov"); fov != words->end()) {
    const auto degrees = parseNumber(fov->second);
    if (!degrees || !(*degrees > 0.0 && *degrees < 180.0)) {
      return Error{kCode, "--camera: 'fov=" + std::string(fov->second) +
                              "' is not an angle between 0 and 180 degrees"};
    }
    camera.verticalFovRadians = glm::radians(*degrees);
  }
  if (words->contains("up")) {
    const auto up = vectorOf(*words, "up", kWhat, kCode);
    if (!up) return up.error();
    camera.up = *up;
  }
  // Near and far are nobody's concern here; the scene fits them later.
  if (Status status = scene::checkCamera(camera); !status) return status.error();
  return camera;
}

Result<scene::AreaLight> parseLight(std::string_view text) {
  constexpr std::string_view kWhat = "--light";
  constexpr ErrorCode kCode = ErrorCode::invalidLight;
  const Result<Words> words = wordsOf(
      text, kWhat,
      "center=x,y,z target=x,y,z size=WxH up=x,y,z, or center=x,y,z u=x,y,z v=x,y,z emission=x,y,z, and "
      "color=r,g,b intensity=I reference=D",
      kCode);
  if (!words) return words.error();
  Result<scene::AreaLight> light = placedLight(*words);
  if (!light) return light;
  if (Status status = readStrength(*words, *light); !status) return status.error();
  return light;
}

Result<glm::dvec3> parseUp(std::string_view text) {
  std::string_view axis = text;
  const double sign = axis.starts_with('-') ? -1.0 : 1.0;
  if (sign < 0.0) axis.remove_prefix(1);
  if (axis == "x") return glm::dvec3(sign, 0, 0);
  if (axis == "y") return glm::dvec3(0, sign, 0);
  if (axis == "z") return glm::dvec3(0, 0, sign);
  const auto parts = splitAt(text, ',');
  glm::dvec3 up(0.0);
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> number = parts.size() == 3 ? parseNumber(parts[i]) : std::nullopt;
    if (number) up[i] = *number;
  }
  if (parts.size() == 3 && glm::length(up) > 0.0) return up;
  return Error{ErrorCode::invalidArgument, "--up: '" + std::string(text) +
                                               "' is no direction; give x, y, z, -x, -y, -z or three numbers "
                                               "like 0,0,1, not all zero"};
}

}  // namespace halfshadow::scenes
