// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "test_meshes.hpp"

#include <cmath>
#include <utility>

#include "scenes/shapes.hpp"

namespace halfshadow::testing {
namespace {
constexpr double kPi = 3.14159265358979323846;

Triangles fromShape(const scenes::Shape& shape) {
  return {shape.positions, shape.indices};
}
}  // namespace

std::uint32_t Triangles::addVertex(const glm::vec3& position) {
  positions.push_back(position);
  return static_cast<std::uint32_t>(positions.size()) - 1;
}

void Triangles::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

void Triangles::addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  addTriangle(a, b, c);
  addTriangle(a, c, d);
}

void Triangles::append(const Triangles& other, const glm::vec3& offset) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (const glm::vec3& p : other.positions) positions.push_back(p + offset);
  for (const std::uint32_t i : other.indices) indices.push_back(first + i);
}

void Triangles::flip(std::size_t triangle) {
  std::swap(indices[3 * triangle + 1], indices[3 * triangle + 2]);
}

scene::TriangleMesh Triangles::mesh() const {
  return scene::buildMesh({.positions = &positions.front().x,
                           .vertexCount = static_cast<std::uint32_t>(positions.size()),
                           .indices = indices.data(),
                           .indexCount = indices.size()})
      .value();
}

Triangles cube() {
  return fromShape(scenes::boxShape({0, 0, 0}, {1, 1, 1}));
}

Triangles sphere(int subdivisions) {
  return fromShape(scenes::icosphereShape({0, 0, 0}, 1.0, subdivisions));
}

Triangles torus(double radius, double tubeRadius) {
  constexpr std::uint32_t kAround = 24, kTube = 12;
  Triangles result;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      const double u = 2 * kPi * i / kAround, v = 2 * kPi * j / kTube;
      const double r = radius + tubeRadius * std::cos(v);
      result.addVertex({r * std::cos(u), tubeRadius * std::sin(v), r * std::sin(u)});
    }
  }
  const auto at = [](std::uint32_t i, std::uint32_t j) { return i % kAround * kTube + j % kTube; };
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      result.addQuad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return result;
}

Triangles capsule() {
  return fromShape(scenes::capsuleShape({-0.4, -0.3, 0.1}, {0.5, 0.4, 0.0}, 0.35));
}

Triangles sheet(int cells, double bendPerUnit) {
  Triangles result;
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      const double x = 2.0 * i / cells - 1.0, z = 2.0 * k / cells - 1.0;
      result.addVertex({x, bendPerUnit * x * x, z});
    }
  }
  const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (cells + 1) + k); };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) result.addQuad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
  }
  return result;
}

Triangles fold() {
  Triangles result;
  result.positions = {{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}, {-1, 1, 0}, {1, 1, 0}};
  result.addQuad(0, 3, 2, 1);
  result.addQuad(0, 1, 5, 4);
  return result;
}

Triangles moebius() {
  constexpr std::uint32_t kSteps = 32;
  Triangles result;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double u = 2 * kPi * i / kSteps;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1.0 + side * std::cos(u / 2);
      result.addVertex({r * std::cos(u), side * std::sin(u / 2), r * std::sin(u)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < kSteps; ++i) result.addQuad(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
  result.addQuad(2 * kSteps - 2, 2 * kSteps - 1, 0, 1);
  return result;
}

glm::dvec3 Random::direction() {
  while (true) {
    const glm::dvec3 d = inBox(1.0);
    const double length = glm::length(d);
    if (length <= 1.0 && length > 0.01) return d / length;
  }
}

}  // namespace halfshadow::testing
