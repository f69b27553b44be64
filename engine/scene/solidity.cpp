// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/solidity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace halfshadow::scene {
namespace {
constexpr std::size_t kMostTests = 4'000'000, kMostRays = 128, kFewestRays = 16;
// Lights stand below a facet's horizon by their own size at most, where that matters: some ten degrees.
constexpr double kBelow = 0.17;
// Golden-ratio multiples lie evenly however many are taken (Roberts 2018).
constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532, kThird = 0.8191725133961645;

struct Facet {
  glm::dvec3 a, edgeAB, edgeAC;
};

Facet facetOf(const TriangleMesh& mesh, std::size_t triangle) {
  const auto corner = [&](std::size_t k) {
    return glm::dvec3(mesh.positions[mesh.indices[3 * triangle + k]]);
  };
  return {corner(0), corner(1) - corner(0), corner(2) - corner(0)};
}

// Based on: Möller, Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
bool meets(const Facet& facet, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 p = glm::cross(direction, facet.edgeAC);
  const double determinant = glm::dot(facet.edgeAB, p);
  if (determinant == 0.0) return false;
  const glm::dvec3 fromA = origin - facet.a;
  const double u = glm::dot(fromA, p) / determinant;
  if (u < 0.0 || u > 1.0) return false;
  const glm::dvec3 q = glm::cross(fromA, facet.edgeAB);
  const double v = glm::dot(direction, q) / determinant;
  return v >= 0.0 && u + v <= 1.0 && glm::dot(facet.edgeAC, q) / determinant > 0.0;
}
}  // namespace

double solidity(const TriangleMesh& mesh) {
  if (mesh.statistics.closed() && mesh.statistics.nonManifoldEdges == 0) return 1.0;
  const std::size_t triangles = mesh.triangleCount();
  if (triangles == 0) return 0.0;
  std::vector<double> areaUpTo(triangles);
  double area = 0.0;
  for (std::size_t i = 0; i < triangles; ++i) {
    const Facet facet = facetOf(mesh, i);
    areaUpTo[i] = area += glm::length(glm::cross(facet.edgeAB, facet.edgeAC));
  }
  const std::size_t rays = std::clamp(kMostTests / triangles, kFewestRays, kMostRays);
  std::size_t inside = 0;
  for (std::size_t ray = 0; ray < rays; ++ray) {
    const double number = static_cast<double>(ray) + 0.5;
    const auto found = std::ranges::lower_bound(areaUpTo, area * number / static_cast<double>(rays));
    const auto own = std::min(static_cast<std::size_t>(found - areaUpTo.begin()), triangles - 1);
    const Facet facet = facetOf(mesh, own);
    double s = std::fmod(number * kFirst, 1.0), t = std::fmod(number * kSecond, 1.0);
    if (s + t > 1.0) s = 1.0 - s, t = 1.0 - t;
    const glm::dvec3 origin = facet.a + s * facet.edgeAB + t * facet.edgeAC;
    const glm::dvec3 normal = glm::normalize(glm::cross(facet.edgeAB, facet.edgeAC));
    const glm::dvec3 along = glm::normalize(facet.edgeAB);
    const double turn = 2.0 * std::numbers::pi * std::fmod(number * kThird, 1.0);
    const glm::dvec3 direction =
        std::cos(turn) * along + std::sin(turn) * glm::cross(normal, along) - kBelow * normal;
    for (std::size_t i = 0; i < triangles; ++i) {
      if (i == own || !meets(facetOf(mesh, i), origin, direction)) continue;
      ++inside;
      break;
    }
  }
  return static_cast<double>(inside) / static_cast<double>(rays);
}

}  // namespace halfshadow::scene
