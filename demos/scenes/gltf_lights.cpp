// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "scenes/gltf_accessors.hpp"

namespace halfshadow::scenes {
namespace {
/// The sun's diameter as seen from the Earth.
constexpr double kSunDegrees = 0.53;
/// Of the scene's bounds, to a directional light: its rays are parallel within a twentieth of a degree, a
/// tenth of the sun's disc, and the depth of the scene is still a thousandth of the distance.
constexpr double kDirectionalRadii = 1000.0;

/// One number or [width, height], both zero or both positive.
std::optional<glm::dvec2> readSize(const tinygltf::Value& size) {
  glm::dvec2 sides(-1.0);
  if (size.IsNumber()) {
    sides = glm::dvec2(size.GetNumberAsDouble());
  } else if (size.IsArray() && size.ArrayLen() == 2 && size.Get(0).IsNumber() && size.Get(1).IsNumber()) {
    sides = {size.Get(0).GetNumberAsDouble(), size.Get(1).GetNumberAsDouble()};
  }
  const bool isSize = std::isfinite(sides.x) && std::isfinite(sides.y) &&
                      ((sides.x > 0 && sides.y > 0) || (sides.x == 0 && sides.y == 0));
  return isSize ? std::optional(sides) : std::nullopt;
}

struct Placed {
  glm::dvec3 center{0.0}, aim{0.0}, up{0.0};
  glm::dvec2 size{0.0};
};

Placed placeOf(const PendingLight& pending, const scene::Bounds& bounds) {
  const glm::dmat4& world = pending.worldFromNode;
  Placed placed{.center = glm::dvec3(world[3]),
                .aim = -glm::normalize(glm::dvec3(world[2])),
                .up = glm::dvec3(world[1]),
                .size = pending.size.value_or(glm::dvec2(0.0))};
  if (pending.source->type == "directional") {
    const double distance = kDirectionalRadii * std::max(bounds.radius(), 1e-30);
    placed.center = bounds.center() - placed.aim * distance;
    const glm::dvec2 degrees = pending.size.value_or(glm::dvec2(kSunDegrees));
    placed.size = 2.0 * distance * glm::tan(glm::radians(0.5 * glm::min(degrees, glm::dvec2(170.0))));
  } else if (pending.source->type == "point" && !pending.size) {
    // It shines everywhere, and one half of that can be had: the one that the scene is in.
    const glm::dvec3 way = bounds.center() - placed.center;
    if (glm::length(way) > 1e-6 * bounds.radius()) placed.aim = glm::normalize(way);
  }
  return placed;
}

void setCone(const tinygltf::Light& source, scene::AreaLight& light) {
  if (source.type != "spot") return;
  constexpr double kWidest = 1.5707963267948966;
  const double outer = source.spot.outerConeAngle;
  if (!(outer > 0.0) || !std::isfinite(outer)) return;
  light.outerConeRadians = std::min(outer, kWidest);
  const double inner = std::isfinite(source.spot.innerConeAngle) ? source.spot.innerConeAngle : 0.0;
  light.innerConeRadians = std::clamp(inner, 0.0, 0.999 * light.outerConeRadians);
}
}  // namespace

const tinygltf::Value* ownExtras(const tinygltf::Value& extras) {
  if (!extras.IsObject() || !extras.Has("halfshadow")) return nullptr;
  const tinygltf::Value& own = extras.Get("halfshadow");
  return own.IsObject() ? &own : nullptr;
}

Result<std::optional<PendingLight>> lightOf(const tinygltf::Model& model, const tinygltf::Node& node,
                                            const glm::dmat4& worldFromNode, const std::string& what) {
  const auto found = node.extensions.find("KHR_lights_punctual");
  if (found == node.extensions.end()) return std::optional<PendingLight>();
  const tinygltf::Value& extension = found->second;
  const int index = extension.IsObject() ? indexIn(extension.Get("light")) : -1;
  if (index < 0 || static_cast<std::size_t>(index) >= model.lights.size()) {
    return malformed(what + " uses a light that does not exist; the file has " +
                     std::to_string(model.lights.size()));
  }
  PendingLight light{
      .what = "light at " + what, .worldFromNode = worldFromNode, .source = &model.lights[index]};
  for (const tinygltf::Value* extras : {&node.extras, &light.source->extras}) {
    const tinygltf::Value* own = ownExtras(*extras);
    if (own == nullptr || !own->Has("size")) continue;
    light.size = readSize(own->Get("size"));
    if (!light.size) {
      return malformed("extras.halfshadow.size of the light at " + what +
                       " must be one number or [width, height], both zero or both positive");
    }
    break;
  }
  return std::optional(light);
}

Status addLights(const std::vector<PendingLight>& lights, scene::SceneDescription& scene) {
  double brightest = 0.0;
  for (const PendingLight& light : lights) brightest = std::max(brightest, light.source->intensity);
  const scene::Bounds bounds = scene::boundsWorld(scene, scene::ObjectFilter::all);
  for (const PendingLight& pending : lights) {
    if (!(glm::length(glm::dvec3(pending.worldFromNode[2])) > 0.0)) {
      scene.notes.push_back(pending.what + " is scaled to nothing and was skipped");
      continue;
    }
    const Placed placed = placeOf(pending, bounds);
    // The aim is a unit vector: far from the origin a target one unit away would be rounding noise.
    const double reach = std::max(bounds.radius(), glm::length(placed.center) * 1e-6 + 1e-6);
    Result<scene::AreaLight> light = scene::areaLightAimed(placed.center, placed.center + placed.aim * reach,
                                                           placed.size.x, placed.size.y, placed.up);
    if (!light) return malformed(pending.what + ": " + light.error().message);
    light->referenceDistance = 0.0;  // the file names no distance, and none may come from the bounds
    setCone(*pending.source, *light);
    const std::vector<double>& color = pending.source->color;
    if (color.size() == 3) light->color = glm::vec3(color[0], color[1], color[2]);
    // Candela and lux do not compare with anything here: the brightest light counts as 1.
    light->intensity = brightest > 0.0 ? std::max(pending.source->intensity, 0.0) / brightest : 1.0;
    scene.lights.push_back(*light);
  }
  return {};
}

}  // namespace halfshadow::scenes
