// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>

#include "reference/embree_scene.hpp"
#include "reference/reference.hpp"

namespace halfshadow::reference {
namespace {

struct Hit {
  glm::dvec3 positionWorld;
  glm::dvec3 normalWorld;
};

/// The hit again in double: Embree names the triangle, its float distance is only the fallback.
Hit refined(const scene::SceneObject& object, unsigned triangle, const glm::dvec3& eyeWorld,
            const glm::dvec3& directionWorld, double floatDistance) {
  glm::dvec3 corners[3];
  for (unsigned i = 0; i < 3; ++i) {
    const glm::vec3 position = object.mesh->positions[object.mesh->indices[3 * triangle + i]];
    corners[i] = glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0));
  }
  glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(normal);
  normal = length > 0.0 ? normal / length : -directionWorld;
  double slope = glm::dot(normal, directionWorld);
  if (slope > 0.0) normal = -normal, slope = -slope;
  double distance = glm::dot(normal, corners[0] - eyeWorld) / slope;
  // A grazing triangle's plane may be met far from the triangle.
  if (!(std::abs(distance - floatDistance) <= 1e-3 * floatDistance)) distance = floatDistance;
  return {eyeWorld + distance * directionWorld, normal};
}

}  // namespace

Result<ReceiverImage> traceReceivers(const scene::SceneDescription& scene, const scene::Camera& camera,
                                     const scene::AreaLight& light, int width, int height) {
  if (width < 1 || height < 1) {
    return Error{ErrorCode::invalidArgument, "the image size must be at least 1 x 1 pixel"};
  }
  if (Status status = scene::checkCamera(camera); !status) return status.error();
  const TraceSpace space = traceSpaceOf(scene);
  std::vector<TraceMesh> meshes;
  bool anyTriangle = false;
  for (const scene::SceneObject& object : scene.objects) {
    meshes.push_back(traceMeshOf(object, space));
    anyTriangle = anyTriangle || !meshes.back().indices.empty();
  }
  if (!anyTriangle)
    return Error{ErrorCode::emptyScene, "scene '" + scene.name + "' has no triangles; add an object"};
  Result<EmbreeScene> embree = EmbreeScene::build(meshes);
  if (!embree) return embree.error();

  const std::size_t pixelCount = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ReceiverImage image{.width = width, .height = height};
  image.positionWorld.resize(pixelCount, glm::dvec3(0.0));
  image.normalWorld.resize(pixelCount, glm::vec3(0.0f));
  image.kind.resize(pixelCount, kNoReceiver);

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const glm::dvec3 forwardWorld = glm::normalize(camera.targetWorld - camera.eyeWorld);
  const glm::vec3 eye(space.fromWorld(camera.eyeWorld));
  for (std::size_t pixel = 0; pixel < pixelCount; ++pixel) {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(width));
    const int y = static_cast<int>(pixel / static_cast<std::size_t>(width));
    const glm::dvec3 directionWorld = scene::pixelRayWorld(camera, width, height, x, y);
    const double traceUnitsPerDepth = space.traceFromWorldScale / glm::dot(directionWorld, forwardWorld);
    RTCRayHit ray{};
    ray.ray.org_x = eye.x, ray.ray.org_y = eye.y, ray.ray.org_z = eye.z;
    ray.ray.dir_x = static_cast<float>(directionWorld.x);
    ray.ray.dir_y = static_cast<float>(directionWorld.y);
    ray.ray.dir_z = static_cast<float>(directionWorld.z);
    ray.ray.tnear = static_cast<float>(camera.nearDistance * traceUnitsPerDepth);
    ray.ray.tfar = static_cast<float>(camera.farDistance * traceUnitsPerDepth);
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree->handle(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;

    const scene::SceneObject& object = scene.objects[ray.hit.geomID];
    const Hit hit = refined(object, ray.hit.primID, camera.eyeWorld, directionWorld,
                            static_cast<double>(ray.ray.tfar) / space.traceFromWorldScale);
    image.positionWorld[pixel] = hit.positionWorld;
    image.normalWorld[pixel] = glm::vec3(hit.normalWorld);
    if (object.receives && glm::dot(hit.normalWorld, light.centerWorld - hit.positionWorld) > 0.0) {
      image.kind[pixel] = object.casts ? kCasterReceiver : kGroundReceiver;
    }
  }
  return image;
}

}  // namespace halfshadow::reference
