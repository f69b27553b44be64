// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/scene_source.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "scenes/added_ground.hpp"
#include "scenes/added_lamp.hpp"
#include "scenes/builtin_scenes.hpp"
#include "scenes/fitted_camera.hpp"
#include "scenes/gltf_loader.hpp"
#include "scenes/shapes.hpp"
#include "scenes/triangle_tree.hpp"

namespace halfshadow::scenes {
namespace {
using scene::Bounds;
using scene::SceneDescription;
using scene::SceneObject;

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

/// Of the width times the depth of what stands on it.
constexpr double kSmallFloorShare = 0.25;

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
  if (size.x >= otherSize.x && size.z >= otherSize.z) return bounds[candidate].low.y <= others.center().y;
  // A smaller one lies under what stands on it.
  const glm::dvec3 shared = glm::max(
      glm::min(bounds[candidate].high, others.high) - glm::max(bounds[candidate].low, others.low), 0.0);
  return shared.x * shared.z >= kSmallFloorShare * otherSize.x * otherSize.z &&
         bounds[candidate].low.y <= others.low.y && bounds[candidate].high.y <= others.center().y;
}

bool hasFloor(const SceneDescription& description, const std::vector<Bounds>& bounds) {
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (isFloor(description, bounds, i)) return true;
  }
  return false;
}

/// Of what stands on it: a floor up to here belongs into the picture.
constexpr double kWideFloorRadii = 2.0;

/// What light and camera are fitted to: the casters without what is only the floor under them.
Bounds subjectBounds(const SceneDescription& description, const std::vector<Bounds>& bounds) {
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
void addGroundIfWanted(SceneDescription& description, const TriangleTree& tree,
                       const std::vector<Bounds>& bounds, const Bounds& subject, GroundMode mode) {
  if (mode == GroundMode::off || hasGround(description)) return;
  if (mode == GroundMode::automatic && hasFloor(description, bounds)) return;
  const GroundPlace place = groundPlaceFor(description, tree);
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

Status addLight(SceneDescription& description, const TriangleTree& tree, const Bounds& subject) {
  Result<LampPlace> lamp = lampPlaceFor(description, tree, subject);
  if (!lamp) return lamp.error();
  description.lights = {lamp->light};
  description.notes.push_back(std::move(lamp->note));
  return {};
}

void addCamera(SceneDescription& description, const std::vector<Bounds>& bounds, const Bounds& subject) {
  std::vector<char> isSubject;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const bool isWideFloor =
        isFloor(description, bounds, i) && bounds[i].radius() > kWideFloorRadii * subject.radius();
    isSubject.push_back(description.objects[i].casts && !isWideFloor);
  }
  description.camera =
      cameraFittedTo(castersAndShadows(description, isSubject, subject, description.lights.front()));
  description.notes.push_back("the scene has no camera: one was fitted to its casters and their shadow");
}

/// The rotation that brings `up` to +y, about the axis across both.
glm::dmat4 turnedUpright(const glm::dvec3& up) {
  const glm::dvec3 from = glm::normalize(up), y(0, 1, 0);
  const double cosine = from.y;
  if (cosine > 1.0 - 1e-12) return glm::dmat4(1.0);
  if (cosine < -1.0 + 1e-12) return glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, -1));
  return glm::rotate(glm::dmat4(1.0), std::acos(cosine), glm::cross(from, y));
}

void turn(SceneDescription& description, const glm::dmat4& rotation) {
  const glm::dmat3 linear(rotation);
  for (SceneObject& object : description.objects) object.worldFromObject = rotation * object.worldFromObject;
  for (scene::AreaLight& light : description.lights) {
    light.centerWorld = linear * light.centerWorld;
    light.halfU = linear * light.halfU;
    light.halfV = linear * light.halfV;
    light.emission = linear * light.emission;
  }
  if (!description.camera) return;
  description.camera->eyeWorld = linear * description.camera->eyeWorld;
  description.camera->targetWorld = linear * description.camera->targetWorld;
  description.camera->up = linear * description.camera->up;
}

}  // namespace

namespace {
/// In a world whose up is +y; overrides are the scene's own already.
Status completeUpright(SceneDescription& description, const SceneOptions& options) {
  if (description.objects.empty()) {
    return Error{ErrorCode::emptyScene,
                 description.name + ": the scene has no triangles; give one that has some"};
  }
  const std::vector<Bounds> bounds = boundsPerObject(description);
  const Bounds subject = subjectBounds(description, bounds);
  const TriangleTree tree(description);
  if (description.lights.empty()) {
    if (Status status = addLight(description, tree, subject); !status) return status;
  }
  if (!description.camera) addCamera(description, bounds, subject);
  if (Status status = scene::checkCamera(*description.camera); !status) return status;
  addGroundIfWanted(description, tree, bounds, subject, options.ground);
  if (std::ranges::none_of(description.objects, &SceneObject::receives)) {
    return Error{ErrorCode::emptyScene,
                 description.name +
                     ": nothing in the scene receives shadows; mark an object with receives = true or use "
                     "--ground on"};
  }
  return {};
}
}  // namespace

Status completeScene(SceneDescription& description, const SceneOptions& options) {
  if (!(glm::length(options.up) > 0.0) || !std::isfinite(glm::length(options.up))) {
    return Error{ErrorCode::invalidArgument,
                 "the up axis needs a direction; give finite numbers, not all zero"};
  }
  if (options.sides == Sides::both) {
    for (SceneObject& object : description.objects) object.material.doubleSided = true;
  }
  if (options.light) description.lights = {*options.light};
  description.lights.insert(description.lights.end(), options.moreLights.begin(), options.moreLights.end());
  if (options.camera) {
    if (Status status = scene::checkCamera(*options.camera); !status) return status;
    description.camera = *options.camera;
  }
  const glm::dmat4 upright = turnedUpright(options.up);
  const bool isTurned = upright != glm::dmat4(1.0);
  if (isTurned) turn(description, upright);
  const Status completed = completeUpright(description, options);
  if (isTurned) turn(description, glm::transpose(upright));
  if (!completed) return completed;
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
  // What a file holds stays; the grounds of built-in scenes are the tool's own.
  if (options.ground == GroundMode::off && source.starts_with(kBuiltin)) removeGround(description);
  if (Status status = completeScene(description, options); !status) return status.error();
  return description;
}

}  // namespace halfshadow::scenes
