// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Meshes for silhouette tests: clean ones, and ways to spoil them.
#pragma once

#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "scene/mesh.hpp"

namespace halfshadow::testing {

/// Positions and corner indices, counter-clockwise seen from outside.
struct Triangles {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;

  std::uint32_t addVertex(const glm::vec3& position);
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  void append(const Triangles& other, const glm::vec3& offset);
  std::size_t count() const { return indices.size() / 3; }
  void flip(std::size_t triangle);  ///< turns its winding round
  scene::TriangleMesh mesh() const;
};

Triangles cube();                                    ///< side 2 around the origin, 12 triangles
Triangles sphere(int subdivisions);                  ///< radius 1, 20 · 4^subdivisions triangles
Triangles torus(double radius, double tubeRadius);   ///< around y, 24 × 12 quads
Triangles capsule();                                 ///< 320 triangles
Triangles sheet(int cells, double bendPerUnit = 0);  ///< [-1, 1]² in xz facing up, y = bend · x²
Triangles fold();                                    ///< two squares that meet at a right angle
Triangles moebius();                                 ///< one half twist, 32 quads

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  glm::dvec3 inBox(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  glm::dvec3 direction();

 private:
  std::mt19937 engine_;
};

}  // namespace halfshadow::testing
