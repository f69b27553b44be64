// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Small scenes of parallelograms for testing the tracer.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>

#include "reference/reference.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::test {

/// Parallelogram center ± u ± v, facing u × v, as one object placed by its matrix.
inline scene::SceneObject parallelogram(std::string name, glm::dvec3 centerWorld, glm::dvec3 u,
                                        glm::dvec3 v) {
  auto mesh = std::make_shared<scene::TriangleMesh>();
  mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh->indices = {0, 1, 2, 0, 2, 3};
  scene::SceneObject object{.name = std::move(name), .mesh = std::move(mesh)};
  object.worldFromObject[0] = glm::dvec4(u, 0.0);
  object.worldFromObject[1] = glm::dvec4(v, 0.0);
  object.worldFromObject[3] = glm::dvec4(centerWorld, 1.0);
  return object;
}

/// side × side receivers of kind kGroundReceiver on the parallelogram center ± u ± v.
inline reference::ReceiverImage receiverGrid(int side, glm::dvec3 centerWorld, glm::dvec3 u, glm::dvec3 v) {
  reference::ReceiverImage image{.width = side, .height = side};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      image.positionWorld.push_back(centerWorld + u * ((x + 0.5) / side * 2 - 1) +
                                    v * ((y + 0.5) / side * 2 - 1));
      image.normalWorld.push_back(glm::normalize(glm::cross(u, v)));
      image.kind.push_back(reference::kGroundReceiver);
    }
  }
  return image;
}

}  // namespace halfshadow::test
