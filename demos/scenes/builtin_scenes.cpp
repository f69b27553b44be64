// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/builtin_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <iterator>

#include "scenes/numbers.hpp"
#include "scenes/scene_makers.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::scenes {
namespace {
struct Entry {
  const char* name;
  const char* description;
  scene::SceneDescription (*make)(double lightHalfSize);
  double lightHalfSize = 1.0;
  double scale = 1.0;
  double shift = 0.0;
};

constexpr Entry kEntries[] = {
    {"box", "one tilted box above the ground", makeBox},
    {"bars", "two crossed bars at different heights", makeBars},
    {"fence", "17 posts and 2 rails standing close above the ground", makeFence},
    {"leaves", "70 thin plates in random directions", makeLeaves},
    {"figure", "a figure of 11 overlapping capsules", makeFigure},
    {"mannequin", "a smooth standing person of one connected mesh with more than 50,000 vertices",
     makeMannequin, 0.5},
    {"spheres27", "27 spheres in a 3×3×3 grid", makeSpheres27},
    {"spheres81", "81 spheres in one layer of 9×9", makeSpheres81},
    {"spheres-cube", "729 spheres in a 9×9×9 grid", makeSpheresCube},
    {"contact", "a plate lying, a ball resting and a pole standing on the ground", makeContact},
    {"room", "an interior with table, chairs and a lamp below the ceiling", makeRoom, 0.25},
    {"terrain", "hills that shadow themselves, with trees and boxes", makeTerrain},
    {"sheets", "40 open, double-sided bent leaves", makeSheets},
    {"convex", "one smooth icosphere above the ground", makeConvex},
    {"butterfly", "a butterfly with thin wings that rise through many heights", makeButterfly},
    {"large-world", "the figure 10,000 units away from the origin in x and z", makeFigure, 1.0, 1.0, 1e4},
    {"tiny", "the figure at a thousandth of its size, camera and light too", makeFigure, 1.0, 1e-3},
};

std::string knownNames() {
  std::string names;
  for (const Entry& entry : kEntries) names += std::string(names.empty() ? "" : ", ") + entry.name;
  return names;
}

Error argumentError(std::string message) {
  return {ErrorCode::invalidArgument, std::move(message)};
}

Status applyParameter(Entry& entry, std::string_view word) {
  const std::size_t equals = word.find('=');
  const std::string quoted = "'" + std::string(word) + "'";
  const std::optional<double> number =
      equals == std::string_view::npos ? std::nullopt : parseNumber(word.substr(equals + 1));
  if (!number)
    return argumentError("the scene parameter " + quoted + " must be key=number, such as light=0.5");
  const std::string_view key = word.substr(0, equals);
  if (key == "light") {
    if (*number < 0)
      return argumentError("the scene parameter " + quoted + " must be 0 (a point light) or more");
    entry.lightHalfSize = *number;
  } else if (key == "scale") {
    if (!(*number > 0)) return argumentError("the scene parameter " + quoted + " must be more than 0");
    entry.scale = *number;
  } else if (key == "shift") {
    entry.shift = *number;
  } else {
    return argumentError("the scene parameter " + quoted + " is unknown; there are light, scale and shift");
  }
  return {};
}

void placeInWorld(scene::SceneDescription& description, double scale, double shift) {
  const glm::dvec3 offset(shift, 0, shift);
  if (scale == 1.0 && shift == 0.0) return;
  const glm::dmat4 placed = glm::scale(glm::translate(glm::dmat4(1.0), offset), glm::dvec3(scale));
  for (scene::SceneObject& object : description.objects)
    object.worldFromObject = placed * object.worldFromObject;
  for (scene::AreaLight& light : description.lights) {
    light.centerWorld = light.centerWorld * scale + offset;
    light.halfU *= scale;
    light.halfV *= scale;
    light.referenceDistance *= scale;
  }
  description.camera->eyeWorld = description.camera->eyeWorld * scale + offset;
  description.camera->targetWorld = description.camera->targetWorld * scale + offset;
}
}  // namespace

std::uint64_t BuiltinInfo::triangleCount() const {
  const Result<scene::SceneDescription> made = makeBuiltinScene(name);
  std::uint64_t count = 0;
  if (made) {
    for (const scene::SceneObject& object : made->objects) count += object.mesh->triangleCount();
  }
  return count;
}

std::vector<BuiltinInfo> builtinScenes() {
  std::vector<BuiltinInfo> infos;
  for (const Entry& entry : kEntries) infos.push_back({entry.name, entry.description});
  return infos;
}

Result<scene::SceneDescription> makeBuiltinScene(std::string_view name) {
  const std::size_t at = name.find('@');
  const std::string_view base = name.substr(0, at);
  const Entry* found = std::find_if(std::begin(kEntries), std::end(kEntries),
                                    [&](const Entry& candidate) { return candidate.name == base; });
  if (found == std::end(kEntries)) {
    return argumentError("no built-in scene is called '" + std::string(base) + "'; there are " +
                         knownNames());
  }
  Entry entry = *found;
  if (at != std::string_view::npos) {
    for (const std::string_view word : splitAt(name.substr(at + 1), ',')) {
      if (Status status = applyParameter(entry, word); !status) return status.error();
    }
  }
  scene::SceneDescription description = entry.make(entry.lightHalfSize);
  description.name = std::string(name);
  placeInWorld(description, entry.scale, entry.shift);
  fitNearAndFar(*description.camera, description);
  return description;
}

}  // namespace halfshadow::scenes
