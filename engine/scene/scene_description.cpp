// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/scene_description.hpp"

namespace halfshadow::scene {

Bounds boundsWorld(const SceneDescription& scene, ObjectFilter filter) {
  Bounds bounds;
  for (const SceneObject& object : scene.objects) {
    if (filter == ObjectFilter::casters && !object.casts) continue;
    if (filter == ObjectFilter::receivers && !object.receives) continue;
    for (const std::uint32_t index : object.mesh->indices) {
      bounds.include(
          glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(object.mesh->positions[index]), 1.0)));
    }
  }
  return bounds;
}

bool showsBackFaces(const TriangleMesh& mesh, const Material& material) {
  const bool isClosed = mesh.statistics.closed() && mesh.statistics.nonManifoldEdges == 0;
  return material.doubleSided || !mesh.turned.empty() || (isClosed && !(material.alphaCutoff > 0.0f));
}

void releaseColorImages(SceneDescription& scene) {
  for (SceneObject& object : scene.objects) {
    if (!(object.material.alphaCutoff > 0.0f)) object.material.baseColorImage = nullptr;
  }
}

}  // namespace halfshadow::scene
