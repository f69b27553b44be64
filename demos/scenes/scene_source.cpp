// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/scene_source.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "scenes/added_ground.hpp"
#include "scenes/builtin_scenes.hpp"
#include "scenes/gltf_loader.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::scenes {
namespace {
using scene::Bounds;
using scene::SceneDescription;
using scene::SceneObject;

constexpr double kFovRadians = 34.0 * 3.14159265358979323846 / 180.0;

Bounds boundsWorldOf(const SceneObject& object) {
  Bounds bounds;
  for (const std::uint32_t index : object.mesh->indices) {
    bounds.include(
        glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(object.mesh->positions[index]), 1.0)));
  }
  return bounds;
}

std::vector<Bounds> boundsPerObject(const SceneDescription& description) {
  std::vector<Bounds> bounds;
  for (const SceneObject& object : description.objects) bounds.push_back(boundsWorldOf(object));
  return bounds;
}

bool isFloor(const SceneDescription& description, const std::vector<Bounds>& bounds, std::size_t candidate) {
  const SceneObject& object = description.objects[candidate];
  if (!object.receives) return false;
  Bounds others;
  for (std::size_t i = 0; i < description.objects.size(); ++i) {
    if (i != candidate && description.objects[i].casts) others.include(bounds[i]);
  }
  const glm::dvec3 size = bounds[candidate].high - bounds[candidate].low;
  if (!(size.y < 0.25 * std::min(size.x, size.z))) return false;
  if (others.empty()) return !object.casts;
  const glm::dvec3 otherSize = others.high - others.low;
  return size.x >= otherSize.x && size.z >= otherSize.z && bounds[candidate].low.y <= others.center().y;
}

bool hasFloor(const SceneDescription& description) {
  const std::vector<Bounds> bounds = boundsPerObject(description);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (isFloor(description, bounds, i)) return true;
  }
  return false;
}

/// What light and camera are fitted to: the casters without what is only the floor under them.
Bounds subjectBounds(const SceneDescription& description) {
  const std::vector<Bounds> bounds = boundsPerObject(description);
  Bounds subject, all;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    all.include(bounds[i]);
    if (description.objects[i].casts && !isFloor(description, bounds, i)) subject.include(bounds[i]);
  }
  return subject.empty() ? all : subject;
}

void removeGround(SceneDescription& description) {
  std::erase_if(description.objects, [](const SceneObject& o) { return o.name == "ground" && !o.casts; });
}

bool hasGround(const SceneDescription& description) {
  return std::ranges::any_of(description.objects,
                             [](const SceneObject& o) { return o.name == "ground" && !o.casts; });
}

void addGround(SceneDescription& description, const Bounds& subject, double height) {
  SceneObject ground = casterOf("ground", planeShape({0, 0, 0}, 40.0));
  ground.casts = false;
  const glm::dvec3 center(subject.center().x, height, subject.center().z);
  ground.worldFromObject =
      glm::scale(glm::translate(glm::dmat4(1.0), center), glm::dvec3(std::max(subject.radius(), 1e-30)));
  description.objects.push_back(std::move(ground));
}

/// With the camera and the lights that the scene has in the end.
void addGroundIfWanted(SceneDescription& description, const Bounds& subject, GroundMode mode) {
  if (mode == GroundMode::off || hasGround(description)) return;
  if (mode == GroundMode::automatic && hasFloor(description)) return;
  const GroundPlace place = groundPlaceFor(description);
  if (mode == GroundMode::automatic && !place.wanted) {
    description.notes.push_back(place.note);
    return;
  }
  addGround(description, subject, place.height);
  if (place.wanted) {
    description.notes.push_back("the scene has no floor: a ground plane was added at its lowest point" +
                                (place.note.empty() ? place.note : "; " + place.note));
  } else {
    description.notes.push_back("a ground plane was added as asked; without that " + place.note);
  }
}

Status addLight(SceneDescription& description, const Bounds& subject) {
  const double distance = 3.0 * subject.radius();
  const glm::dvec3 center = subject.center() + distance * glm::normalize(glm::dvec3(0.35, 1.0, 0.3));
  const double size = 2 * 0.1 * distance;
  const auto light = scene::areaLightAimed(center, subject.center(), size, size, {0.2, 0.1, 1.0});
  if (!light) return light.error();
  description.lights = {*light};
  description.notes.push_back(
      "the scene has no light: one was placed three radii above and beside its centre");
  return {};
}

/// The box of the casters and of their shadow, cast from the light's centre onto the plane at their lowest y.
Bounds casterAndShadowBounds(const Bounds& subject, const scene::AreaLight& light) {
  Bounds result = subject;
  for (const glm::dvec3& corner : subject.corners()) {
    const double drop = light.centerWorld.y - corner.y;
    if (!(drop > 0.0)) continue;
    const double stretch = (light.centerWorld.y - subject.low.y) / drop;
    // A light near the horizon casts endless shadows; twice the radius of one is enough to look at.
    const glm::dvec3 offset = (corner - light.centerWorld) * (stretch - 1.0);
    const double limit = 2.0 * subject.radius(), length = glm::length(offset);
    result.include(corner + (length > limit ? offset * (limit / length) : offset));
  }
  return result;
}

void addCamera(SceneDescription& description, const Bounds& subject) {
  const Bounds seen = casterAndShadowBounds(subject, description.lights.front());
  scene::Camera camera{.targetWorld = seen.center(), .verticalFovRadians = kFovRadians};
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0.55, -0.75, -0.6));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double tanHalf = std::tan(kFovRadians / 2), tanHalfWide = tanHalf * 4 / 3;
  double distance = 0.0;
  for (const glm::dvec3& corner : seen.corners()) {
    const glm::dvec3 offset = corner - camera.targetWorld;
    const double needed =
        std::max(std::abs(glm::dot(offset, up)) / tanHalf, std::abs(glm::dot(offset, right)) / tanHalfWide);
    distance = std::max(distance, needed - glm::dot(offset, forward));
  }
  camera.eyeWorld = camera.targetWorld - forward * (1.05 * distance);
  description.camera = camera;
  description.notes.push_back("the scene has no camera: one was fitted to its casters and their shadow");
}

}  // namespace

Status completeScene(SceneDescription& description, const SceneOptions& options) {
  if (options.ground == GroundMode::off) removeGround(description);
  if (description.objects.empty()) {
    return Error{ErrorCode::emptyScene,
                 description.name + ": the scene has no triangles; give one that has some"};
  }
  const Bounds subject = subjectBounds(description);
  if (options.light) description.lights = {*options.light};
  description.lights.insert(description.lights.end(), options.moreLights.begin(), options.moreLights.end());
  if (description.lights.empty()) {
    if (Status status = addLight(description, subject); !status) return status;
  }
  if (options.camera) {
    description.camera = *options.camera;
  } else if (!description.camera) {
    addCamera(description, subject);
  }
  if (Status status = scene::checkCamera(*description.camera); !status) return status;
  addGroundIfWanted(description, subject, options.ground);
  if (std::ranges::none_of(description.objects, &SceneObject::receives)) {
    return Error{ErrorCode::emptyScene,
                 description.name +
                     ": nothing in the scene receives shadows; mark an object with receives = true or use "
                     "--ground on"};
  }
  fitNearAndFar(*description.camera, description);
  return scene::checkCamera(*description.camera);
}

Result<SceneDescription> openScene(const std::string& source, const SceneOptions& options) {
  constexpr std::string_view kBuiltin = "builtin:";
  Result<SceneDescription> opened =
      source.starts_with(kBuiltin) ? makeBuiltinScene(std::string_view(source).substr(kBuiltin.size()))
                                   : loadGltf(source, {.animationTimeSeconds = options.animationTimeSeconds,
                                                       .animationIndex = options.animationIndex});
  if (!opened) return opened.error();
  SceneDescription description = std::move(opened).value();
  if (Status status = completeScene(description, options); !status) return status.error();
  return description;
}

}  // namespace halfshadow::scenes
