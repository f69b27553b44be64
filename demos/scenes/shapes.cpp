// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/shapes.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace halfshadow::scenes {
namespace {
constexpr double kPi = std::numbers::pi;

/// Two triangles per quad between ring `upper` and ring `lower`, both of `count` vertices.
void addRingQuad(Shape& shape, std::uint32_t upper, std::uint32_t lower, std::uint32_t k,
                 std::uint32_t count) {
  const std::uint32_t next = (k + 1) % count;
  shape.addTriangle(upper + k, upper + next, lower + k);
  shape.addTriangle(upper + next, lower + next, lower + k);
}
}  // namespace

std::uint32_t Shape::addVertex(const glm::dvec3& position) {
  positions.push_back(glm::vec3(position));
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void Shape::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

void Shape::append(const Shape& other) {
  const auto base = static_cast<std::uint32_t>(positions.size());
  assert(normals.empty() == other.normals.empty() || positions.empty());
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  for (const std::uint32_t index : other.indices) indices.push_back(base + index);
}

Shape boxShape(const glm::dvec3& center, const glm::dvec3& half, const glm::dvec3& xAxis,
               const glm::dvec3& yAxis) {
  const glm::dvec3 x = xAxis * half.x, y = yAxis * half.y, z = glm::cross(xAxis, yAxis) * half.z;
  Shape shape;
  for (int i = 0; i < 8; ++i) {
    shape.addVertex(center + (i & 1 ? x : -x) + (i & 2 ? y : -y) + (i & 4 ? z : -z));
  }
  shape.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return shape;
}

Shape uvSphereShape(double radius) {
  constexpr std::uint32_t kSlices = 20, kStacks = 20;
  const auto at = [&](std::uint32_t stack, std::uint32_t slice) {
    const double polar = kPi * stack / kStacks, azimuth = 2 * kPi * slice / kSlices;
    return radius * glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                               std::sin(polar) * std::sin(azimuth));
  };
  Shape shape;
  const std::uint32_t top = shape.addVertex(at(0, 0));
  for (std::uint32_t stack = 1; stack < kStacks; ++stack) {
    for (std::uint32_t slice = 0; slice < kSlices; ++slice) shape.addVertex(at(stack, slice));
  }
  const std::uint32_t bottom = shape.addVertex(at(kStacks, 0));
  const auto ring = [](std::uint32_t stack) { return 1 + (stack - 1) * kSlices; };
  for (std::uint32_t k = 0; k < kSlices; ++k) {
    const std::uint32_t next = (k + 1) % kSlices;
    shape.addTriangle(top, ring(1) + next, ring(1) + k);
    shape.addTriangle(bottom, ring(kStacks - 1) + k, ring(kStacks - 1) + next);
  }
  const std::uint32_t equator = ring(kStacks / 2), below = ring(kStacks / 2 + 1),
                      above = ring(kStacks / 2 - 1);
  const std::uint32_t middle =
      shape.addVertex(radius * glm::normalize(at(kStacks / 2, 0) + at(kStacks / 2, 1)));
  for (std::uint32_t stack = 1; stack + 1 < kStacks; ++stack) {
    for (std::uint32_t k = 0; k < kSlices; ++k) {
      if (k == 0 && ring(stack) == above) {
        shape.addTriangle(above, above + 1, equator);
        shape.addTriangle(above + 1, equator + 1, middle);
        shape.addTriangle(above + 1, middle, equator);
      } else if (k == 0 && ring(stack) == equator) {
        shape.addTriangle(equator, middle, below);
        shape.addTriangle(middle, equator + 1, below);
        shape.addTriangle(equator + 1, below + 1, below);
      } else {
        addRingQuad(shape, ring(stack), ring(stack + 1), k, kSlices);
      }
    }
  }
  return shape;
}

Shape capsuleShape(const glm::dvec3& a, const glm::dvec3& b, double radius) {
  constexpr std::uint32_t kSides = 16, kCapRings = 5;
  const glm::dvec3 w = glm::normalize(b - a);
  const glm::dvec3 u =
      glm::normalize(glm::cross(w, std::abs(w.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0}));
  const glm::dvec3 v = glm::cross(w, u);
  Shape shape;
  const std::uint32_t first = shape.addVertex(a - radius * w);
  const auto addRing = [&](const glm::dvec3& center, double angle) {  // angle from -w
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double turn = 2 * kPi * k / kSides;
      shape.addVertex(center - w * (radius * std::cos(angle)) +
                      (u * std::cos(turn) + v * std::sin(turn)) * (radius * std::sin(angle)));
    }
  };
  for (std::uint32_t i = 1; i <= kCapRings; ++i) addRing(a, kPi / 2 * i / kCapRings);
  for (std::uint32_t i = 0; i < kCapRings; ++i)
    addRing(b, kPi / 2 * (1 + static_cast<double>(i) / kCapRings));
  const std::uint32_t last = shape.addVertex(b + radius * w);
  const std::uint32_t lastRing = 1 + (2 * kCapRings - 1) * kSides;
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const std::uint32_t next = (k + 1) % kSides;
    shape.addTriangle(first, 1 + next, 1 + k);
    shape.addTriangle(last, lastRing + k, lastRing + next);
  }
  for (std::uint32_t ring = 1; ring < lastRing; ring += kSides) {
    for (std::uint32_t k = 0; k < kSides; ++k) addRingQuad(shape, ring, ring + kSides, k, kSides);
  }
  return shape;
}

Shape icosphereShape(const glm::dvec3& center, double radius, int subdivisions) {
  const double t = std::numbers::phi;
  std::vector<glm::dvec3> unit = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                                  {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  for (glm::dvec3& p : unit) p = glm::normalize(p);
  std::vector<std::uint32_t> indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                        4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                        6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(a, b);
      const auto [entry, isNew] = middles.try_emplace(edge, static_cast<std::uint32_t>(unit.size()));
      if (isNew) unit.push_back(glm::normalize(unit[a] + unit[b]));
      return entry->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
    }
    indices = std::move(finer);
  }
  Shape shape;
  shape.indices = std::move(indices);
  for (const glm::dvec3& p : unit) {
    shape.addVertex(center + radius * p);
    shape.normals.push_back(glm::vec3(p));
  }
  return shape;
}

Shape frustumShape(const glm::dvec3& baseCenter, double baseRadius, double topRadius, double height,
                   int sides) {
  const auto count = static_cast<std::uint32_t>(sides);
  Shape shape;
  const auto addRing = [&](double y, double radius) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const double turn = 2 * kPi * k / count;
      shape.addVertex(baseCenter + glm::dvec3(radius * std::cos(turn), y, radius * std::sin(turn)));
    }
  };
  addRing(0, baseRadius);
  const std::uint32_t bottom = shape.addVertex(baseCenter),
                      top = shape.addVertex(baseCenter + glm::dvec3(0, height, 0));
  const std::uint32_t upper = top + 1;
  if (topRadius > 0) addRing(height, topRadius);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t next = (k + 1) % count;
    shape.addTriangle(bottom, k, next);
    if (topRadius > 0) {
      addRingQuad(shape, upper, 0, k, count);
      shape.addTriangle(top, upper + next, upper + k);
    } else {
      shape.addTriangle(top, next, k);
    }
  }
  return shape;
}

Shape planeShape(const glm::dvec3& center, double width) {
  const double half = width / 2;
  Shape shape;
  shape.addVertex(center + glm::dvec3(-half, 0, -half));
  shape.addVertex(center + glm::dvec3(half, 0, -half));
  shape.addVertex(center + glm::dvec3(half, 0, half));
  shape.addVertex(center + glm::dvec3(-half, 0, half));
  shape.indices = {0, 2, 1, 0, 3, 2};
  return shape;
}

std::shared_ptr<const scene::TriangleMesh> meshOf(const Shape& shape) {
  Result<scene::TriangleMesh> mesh = scene::buildMesh({
      .positions = &shape.positions.front().x,
      .vertexCount = static_cast<std::uint32_t>(shape.positions.size()),
      .indices = shape.indices.data(),
      .indexCount = shape.indices.size(),
      .normals = shape.normals.empty() ? nullptr : &shape.normals.front().x,
  });
  // The shapes are made from constants, so a failure here is a mistake in this folder.
  assert(mesh.ok());
  return std::make_shared<const scene::TriangleMesh>(std::move(mesh).value());
}

scene::SceneObject casterOf(std::string name, const Shape& shape, const glm::vec3& color) {
  scene::SceneObject object{.name = std::move(name), .mesh = meshOf(shape)};
  object.material.baseColor = glm::vec4(color, 1.0f);
  return object;
}

scene::SceneObject groundObject() {
  scene::SceneObject ground = casterOf("ground", planeShape({0, 0, 0}, 120));
  ground.casts = false;
  return ground;
}

}  // namespace halfshadow::scenes
