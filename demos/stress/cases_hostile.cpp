// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Geometry that files hold and nobody means: needles, triangles of no area, duplicates, T-junctions, shells.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "stress/stages.hpp"

namespace halfshadow::stress {
namespace {
using scenes::boxShape;
using scenes::Shape;

/// The object's mesh as a file would hand it over: nothing checked, nothing dropped.
scene::SceneObject rawObject(const std::string& name, const Shape& shape) {
  auto mesh = std::make_shared<scene::TriangleMesh>();
  mesh->positions = shape.positions;
  mesh->indices = shape.indices;
  for (std::uint32_t i = 0; i < shape.positions.size(); ++i) mesh->weldedVertex.push_back(i);
  return {.name = name, .mesh = std::move(mesh)};
}

/// The first caster of the base scene replaced.
SceneDescription withCaster(const std::string& base, const Shape& shape) {
  SceneDescription scene = baseScene(base);
  scene.objects.front() = rawObject("hostile", shape);
  return scene;
}

Shape boxOfBase() {
  const scene::TriangleMesh& mesh = *baseScene("box").objects.front().mesh;
  return {.positions = mesh.positions, .normals = {}, .indices = mesh.indices};
}

/// Each triangle cut into `count` long ones that meet in one corner.
Shape needles(const Shape& shape, int count) {
  Shape result;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    glm::dvec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = glm::dvec3(shape.positions[shape.indices[i + k]]);
    const std::uint32_t apex = result.addVertex(corner[0]);
    std::uint32_t before = result.addVertex(corner[1]);
    for (int n = 1; n <= count; ++n) {
      const std::uint32_t next =
          result.addVertex(glm::mix(corner[1], corner[2], static_cast<double>(n) / count));
      result.addTriangle(apex, before, next);
      before = next;
    }
  }
  return result;
}

Shape withZeroAreas(Shape shape) {
  const std::size_t count = shape.indices.size();
  for (std::size_t i = 0; i < count; i += 3) {
    const std::uint32_t a = shape.indices[i], b = shape.indices[i + 1];
    shape.addTriangle(a, b, b);
    shape.addTriangle(a, a, a);
    const std::uint32_t middle =
        shape.addVertex(0.5 * (glm::dvec3(shape.positions[a]) + glm::dvec3(shape.positions[b])));
    shape.addTriangle(a, b, middle);
    shape.addTriangle(b, a, middle);
  }
  return shape;
}

Shape doubled(Shape shape) {
  const std::vector<std::uint32_t> once = shape.indices;
  shape.indices.insert(shape.indices.end(), once.begin(), once.end());
  return shape;
}

/// Two triangles a side on five sides, four on the sixth: a T-junction in the middle of a common edge.
Shape tJunctions(Shape shape) {
  const std::uint32_t a = shape.indices[0], b = shape.indices[1], c = shape.indices[2];
  const auto at = [&](std::uint32_t i) { return glm::dvec3(shape.positions[i]); };
  const std::uint32_t ab = shape.addVertex(0.5 * (at(a) + at(b))),
                      bc = shape.addVertex(0.5 * (at(b) + at(c))),
                      ca = shape.addVertex(0.5 * (at(c) + at(a)));
  shape.indices.erase(shape.indices.begin(), shape.indices.begin() + 3);
  shape.addTriangle(a, ab, ca);
  shape.addTriangle(ab, b, bc);
  shape.addTriangle(ca, bc, c);
  shape.addTriangle(ab, bc, ca);
  return shape;
}

Shape shells(int count) {
  Shape shape;
  for (int i = 0; i < count; ++i)
    shape.append(boxShape({0, 1.8, 0}, glm::dvec3(1.1, 0.35, 0.8) * (1.0 - 0.5 * i / count)));
  return shape;
}

/// Crowds of needles: a bush of long thin closed boxes.
SceneDescription bush(std::uint64_t seed) {
  Random random(seed + 30);
  SceneDescription scene = baseScene("box");
  Shape shape;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 x = random.direction();
    glm::dvec3 y = glm::cross(x, random.direction());
    if (glm::length(y) < 1e-3) y = glm::cross(x, glm::dvec3(0, 1, 0.3));
    shape.append(
        boxShape(glm::dvec3(0, 1.8, 0) + 0.4 * random.direction(), {1.1, 0.015, 0.01}, x, glm::normalize(y)));
  }
  scene.objects.front() = rawObject("bush", shape);
  return scene;
}

std::vector<Variant> sameBox(std::uint64_t) {
  const Shape box = boxOfBase();
  return {{"needles", withCaster("box", needles(box, 60)), "box"},
          {"zero-areas", withCaster("box", withZeroAreas(box)), "box"},
          {"duplicates", withCaster("box", doubled(box)), "box"},
          {"t-junctions", withCaster("box", tJunctions(box)), "box"}};
}

std::vector<Variant> hostileShapes(std::uint64_t seed) {
  SceneDescription crossing = baseScene("box");
  crossing = with(crossing, "second", boxShape({0.2, 1.8, 0.1}, {0.4, 1.2, 0.3}));
  return {{"shells-20", withCaster("box", shells(20)), "box"},
          {"bush", bush(seed), "box"},
          {"crossing", crossing, "box"},
          {"sunk", with(baseScene("box"), "sunk", boxShape({-2.2, 0.1, 0.4}, {0.5, 0.6, 0.4})), "box"}};
}
}  // namespace

std::vector<Case> hostileCases() {
  return {
      {"same-box", "the box in needles, with triangles of no area, duplicates, T-junctions", Rule::same,
       sameBox},
      {"hostile", "nested shells, a bush of needles, casters that pierce each other or the ground", Rule::own,
       hostileShapes},
  };
}

}  // namespace halfshadow::stress
