// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress/scene_edits.hpp"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

namespace halfshadow::stress {
namespace {
glm::dmat4 turnOf(const Placement& placement) {
  return glm::rotate(glm::dmat4(1.0), placement.angle, placement.axis);
}
glm::dmat4 matrixOf(const Placement& placement) {
  return glm::translate(glm::dmat4(1.0), placement.shift) * turnOf(placement) *
         glm::scale(glm::dmat4(1.0), glm::dvec3(placement.scale));
}
glm::dvec3 point(const glm::dmat4& matrix, const glm::dvec3& p) {
  return glm::dvec3(matrix * glm::dvec4(p, 1.0));
}

void placeViewAndLights(SceneDescription& scene, const Placement& placement) {
  const glm::dmat4 matrix = matrixOf(placement);
  const glm::dmat3 turn(turnOf(placement));
  for (scene::AreaLight& light : scene.lights) {
    light.centerWorld = point(matrix, light.centerWorld);
    light.halfU = turn * light.halfU * placement.scale;
    light.halfV = turn * light.halfV * placement.scale;
    light.emission = turn * light.emission;
    light.referenceDistance *= placement.scale;
  }
  scene::Camera& camera = *scene.camera;
  camera.eyeWorld = point(matrix, camera.eyeWorld);
  camera.targetWorld = point(matrix, camera.targetWorld);
  camera.up = turn * camera.up;
  camera.nearDistance *= placement.scale;
  camera.farDistance *= placement.scale;
}

using Shape = scenes::Shape;
Shape shapeOf(const scene::TriangleMesh& mesh) {
  return {.positions = mesh.positions, .normals = mesh.normals, .indices = mesh.indices};
}
/// Each caster's mesh replaced by another.
template <typename Edit>
SceneDescription edited(SceneDescription scene, Edit edit) {
  for (scene::SceneObject& object : scene.objects) {
    if (object.casts) object.mesh = scenes::meshOf(edit(shapeOf(*object.mesh), object));
  }
  return scene;
}
}  // namespace

SceneDescription placed(SceneDescription scene, const Placement& placement) {
  const glm::dmat4 matrix = matrixOf(placement);
  for (scene::SceneObject& object : scene.objects) object.worldFromObject = matrix * object.worldFromObject;
  placeViewAndLights(scene, placement);
  return scene;
}

SceneDescription baked(const SceneDescription& scene, const Placement& placement) {
  SceneDescription result = placed(scene, placement);
  for (scene::SceneObject& object : result.objects) {
    Shape shape = shapeOf(*object.mesh);
    for (glm::vec3& position : shape.positions)
      position = glm::vec3(point(object.worldFromObject, glm::dvec3(position)));
    const glm::dmat3 turn(object.worldFromObject);
    for (glm::vec3& normal : shape.normals) normal = glm::vec3(glm::normalize(turn * glm::dvec3(normal)));
    object.mesh = scenes::meshOf(shape);
    object.worldFromObject = glm::dmat4(1.0);
  }
  return result;
}

SceneDescription mirroredNodes(SceneDescription scene) {
  return edited(std::move(scene), [](Shape shape, scene::SceneObject& object) {
    for (glm::vec3& position : shape.positions) position.x = -position.x;
    for (glm::vec3& normal : shape.normals) normal.x = -normal.x;
    // Counter-clockwise seen from outside in its own space, as files have it.
    for (std::size_t i = 0; i < shape.indices.size(); i += 3)
      std::swap(shape.indices[i + 1], shape.indices[i + 2]);
    object.worldFromObject = glm::scale(object.worldFromObject, {-1.0, 1.0, 1.0});
    return shape;
  });
}

SceneDescription reordered(SceneDescription scene, Random& random) {
  const auto shuffle = [&random](auto& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random.below(i)]);
  };
  shuffle(scene.objects);
  return edited(std::move(scene), [&](Shape shape, scene::SceneObject&) {
    std::vector<glm::uvec3> triangles;
    for (std::size_t i = 0; i < shape.indices.size(); i += 3)
      triangles.emplace_back(shape.indices[i], shape.indices[i + 1], shape.indices[i + 2]);
    shuffle(triangles);
    shape.indices.clear();
    for (const glm::uvec3& t : triangles) {
      const int first = static_cast<int>(random.below(3));
      for (int k = 0; k < 3; ++k) shape.indices.push_back(t[(first + k) % 3]);
    }
    return shape;
  });
}

SceneDescription unwelded(SceneDescription scene) {
  return edited(std::move(scene), [](const Shape& shape, scene::SceneObject&) {
    Shape soup;
    for (const std::uint32_t index : shape.indices) {
      soup.positions.push_back(shape.positions[index]);
      if (!shape.normals.empty()) soup.normals.push_back(shape.normals[index]);
      soup.indices.push_back(static_cast<std::uint32_t>(soup.indices.size()));
    }
    return soup;
  });
}

SceneDescription split(SceneDescription scene, SplitRule rule) {
  std::vector<scene::SceneObject> pieces;
  for (const scene::SceneObject& object : scene.objects) {
    if (!object.casts) {
      pieces.push_back(object);
      continue;
    }
    const Shape whole = shapeOf(*object.mesh);
    const double middle = scene::boundsOf(*object.mesh).center().x;
    Shape parts[2] = {whole, whole};
    for (Shape& part : parts) part.indices.clear();
    for (std::size_t i = 0; i < whole.indices.size(); i += 3) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += whole.positions[whole.indices[i + k]].x;
      const bool second = rule == SplitRule::bySide ? sum / 3.0 > middle : i / 3 % 2 == 1;
      parts[second].indices.insert(parts[second].indices.end(), whole.indices.begin() + static_cast<long>(i),
                                   whole.indices.begin() + static_cast<long>(i) + 3);
    }
    for (const Shape& part : parts) {
      if (part.indices.empty()) continue;
      pieces.push_back(object);
      pieces.back().mesh = scenes::meshOf(part);
    }
  }
  scene.objects = std::move(pieces);
  return scene;
}

SceneDescription flipped(SceneDescription scene, FlipRule rule) {
  std::size_t number = 0;
  return edited(std::move(scene), [&](Shape shape, scene::SceneObject&) {
    if (rule == FlipRule::everySecond && number++ % 2 == 0) return shape;
    for (std::size_t i = 0; i < shape.indices.size(); i += 3)
      std::swap(shape.indices[i + 1], shape.indices[i + 2]);
    for (glm::vec3& normal : shape.normals) normal = -normal;
    return shape;
  });
}

SceneDescription with(SceneDescription scene, const std::string& name, const Shape& shape) {
  scene.objects.push_back(scenes::casterOf(name, shape));
  return scene;
}

SceneDescription withReceiver(SceneDescription scene, const std::string& name, const Shape& shape) {
  scene = with(std::move(scene), name, shape);
  scene.objects.back().casts = false;
  return scene;
}

SceneDescription withGround(SceneDescription scene, double width, bool casts) {
  std::erase_if(scene.objects, [](const scene::SceneObject& o) { return o.name == "ground"; });
  scene = with(std::move(scene), "ground", scenes::planeShape({0, 0, 0}, width));
  scene.objects.back().casts = casts;
  return scene;
}

}  // namespace halfshadow::stress
