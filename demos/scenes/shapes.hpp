// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Closed triangle shapes from which the built-in scenes are put together (internal to demos/scenes).
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

/// Triangles under construction, counter-clockwise seen from outside.
struct Shape {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< empty or one per position
  std::vector<std::uint32_t> indices;

  std::uint32_t addVertex(const glm::dvec3& position);
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void append(const Shape& other);
};

/// Box with half extents `half` along the unit axes x, y and x × y. 12 triangles.
Shape boxShape(const glm::dvec3& center, const glm::dvec3& half, const glm::dvec3& xAxis = {1, 0, 0},
               const glm::dvec3& yAxis = {0, 1, 0});

/// UV sphere, poles on ±y, 20 slices × 20 stacks, one equatorial edge split at its normalised midpoint:
/// 762 triangles. The split gives the silhouette code one vertex of valence four to get right.
Shape uvSphereShape(double radius);

/// Capsule around the segment a-b: 16 sides, 5 rings per cap, 320 triangles.
Shape capsuleShape(const glm::dvec3& a, const glm::dvec3& b, double radius);

/// Icosahedron subdivided `subdivisions` times, with smooth normals. 20 · 4^subdivisions triangles.
Shape icosphereShape(const glm::dvec3& center, double radius, int subdivisions);

/// Closed frustum of a cone along y with `sides` sides; topRadius 0 makes a cone.
Shape frustumShape(const glm::dvec3& baseCenter, double baseRadius, double topRadius, double height,
                   int sides);

/// Horizontal square of two triangles facing up.
Shape planeShape(const glm::dvec3& center, double width);

std::shared_ptr<const scene::TriangleMesh> meshOf(const Shape& shape);

scene::SceneObject casterOf(std::string name, const Shape& shape, const glm::vec3& color = glm::vec3(0.8f));

/// The receiver plane y = 0, 120 wide, that casts nothing.
scene::SceneObject groundObject();

}  // namespace halfshadow::scenes
