// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>

#include "reference/embree_scene.hpp"
#include "reference/reference.hpp"

namespace halfshadow::reference {

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
    meshes.back().frontOnly = !scene::showsBackFaces(*object.mesh, object.material);
    meshes.back().mirrored = glm::determinant(glm::dmat3(object.worldFromObject)) < 0.0;
    anyTriangle = anyTriangle || !meshes.back().indices.empty();
  }
  if (!anyTriangle)
    return Error{ErrorCode::emptyScene, "scene '" + scene.name + "' has no triangles; add an object"};
  const glm::dvec3 eye = space.fromWorld(camera.eyeWorld);
  Result<EmbreeScene> embree = EmbreeScene::build(std::move(meshes), glm::length(eye));
  if (!embree) return embree.error();

  const std::size_t pixelCount = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ReceiverImage image{.width = width, .height = height};
  image.positionWorld.resize(pixelCount, glm::dvec3(0.0));
  image.normalWorld.resize(pixelCount, glm::dvec3(0.0));
  image.kind.resize(pixelCount, kNoReceiver);

  const glm::dvec3 forwardWorld = glm::normalize(camera.targetWorld - camera.eyeWorld);
  for (std::size_t pixel = 0; pixel < pixelCount; ++pixel) {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(width));
    const int y = static_cast<int>(pixel / static_cast<std::size_t>(width));
    const glm::dvec3 direction = glm::normalize(scene::pixelRayWorld(camera, width, height, x, y));
    const double traceUnitsPerDepth = space.traceFromWorldScale / glm::dot(direction, forwardWorld);
    RayHit hit;
    if (!embree->nearest(eye, direction, camera.nearDistance * traceUnitsPerDepth,
                         camera.farDistance * traceUnitsPerDepth, hit))
      continue;
    const scene::SceneObject& object = scene.objects[hit.mesh];
    const glm::dvec3 positionWorld = camera.eyeWorld + hit.distance / space.traceFromWorldScale * direction;
    image.positionWorld[pixel] = positionWorld;
    image.normalWorld[pixel] = hit.normal;
    if (object.receives && glm::dot(hit.normal, light.centerWorld - positionWorld) > 0.0) {
      image.kind[pixel] = object.casts ? kCasterReceiver : kGroundReceiver;
    }
  }
  return image;
}

}  // namespace halfshadow::reference
