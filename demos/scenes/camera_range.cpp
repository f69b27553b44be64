// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scenes/scene_source.hpp"

namespace halfshadow::scenes {
namespace {
constexpr double kWidestAspect = 2.0;
constexpr double kNothing = std::numeric_limits<double>::infinity();
/// Rays across and down that find out how near what is seen begins.
constexpr int kRaysAcross = 32, kRaysDown = 16;
/// Nearer than this share of what those rays meet there are only slivers: a plane through the eye, seen
/// edge-on.
constexpr double kSliver = 0.02;

/// Of the depth of the scene, before and behind it.
constexpr double kFarAwayMargin = 0.05;

struct Triangle {
  std::array<glm::dvec3, 3> corners;  ///< x right, y up, z along the view, from the eye
};

std::vector<Triangle> trianglesFromEye(const scene::Camera& camera,
                                       const scene::SceneDescription& description) {
  std::vector<Triangle> triangles;
  const glm::dmat4 viewFromWorld = scene::viewFromWorld(camera);
  std::vector<glm::dvec3> vertices;
  for (const scene::SceneObject& object : description.objects) {
    const glm::dmat4 viewFromObject = viewFromWorld * object.worldFromObject;
    vertices.clear();
    for (const glm::vec3& position : object.mesh->positions) {
      const glm::dvec3 view(viewFromObject * glm::dvec4(glm::dvec3(position), 1.0));
      vertices.push_back({view.x, view.y, -view.z});
    }
    for (std::size_t i = 0; i + 2 < object.mesh->indices.size(); i += 3) {
      triangles.push_back({{vertices[object.mesh->indices[i]], vertices[object.mesh->indices[i + 1]],
                            vertices[object.mesh->indices[i + 2]]}});
    }
  }
  return triangles;
}

/// Smallest depth of the part of the triangle inside the view's pyramid; infinite when there is none.
double nearestSeen(const Triangle& triangle, double tangentX, double tangentY) {
  const std::array<glm::dvec3, 4> inward{glm::dvec3(1, 0, tangentX), glm::dvec3(-1, 0, tangentX),
                                         glm::dvec3(0, 1, tangentY), glm::dvec3(0, -1, tangentY)};
  std::vector<glm::dvec3> polygon(triangle.corners.begin(), triangle.corners.end()), clipped;
  for (const glm::dvec3& plane : inward) {
    clipped.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double atA = glm::dot(plane, a), atB = glm::dot(plane, b);
      if (atA >= 0.0) clipped.push_back(a);
      if ((atA < 0.0) != (atB < 0.0)) clipped.push_back(a + (b - a) * (atA / (atA - atB)));
    }
    polygon.swap(clipped);
  }
  double nearest = kNothing;
  for (const glm::dvec3& point : polygon) nearest = std::min(nearest, std::max(point.z, 0.0));
  return nearest;
}

/// Depth at which the ray (x, y, 1) meets the triangle, either side; infinite when it does not.
double depthAlong(const Triangle& triangle, const glm::dvec3& ray) {
  const glm::dvec3 ab = triangle.corners[1] - triangle.corners[0],
                   ac = triangle.corners[2] - triangle.corners[0];
  const glm::dvec3 p = glm::cross(ray, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return kNothing;
  const glm::dvec3 toEye = -triangle.corners[0];
  const double u = glm::dot(toEye, p) / determinant;
  const glm::dvec3 q = glm::cross(toEye, ab);
  const double v = glm::dot(ray, q) / determinant, depth = glm::dot(ac, q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && depth > 0.0 ? depth : kNothing;
}

double nearestOfRays(const std::vector<Triangle>& triangles, double tangentX, double tangentY) {
  double nearest = kNothing;
  for (const Triangle& triangle : triangles) {
    const auto z = [&](int i) { return triangle.corners[static_cast<std::size_t>(i)].z; };
    if (std::min({z(0), z(1), z(2)}) >= nearest || std::max({z(0), z(1), z(2)}) <= 0.0) continue;
    for (int i = 0; i < kRaysAcross * kRaysDown; ++i) {
      const glm::dvec3 ray(((i % kRaysAcross + 0.5) / kRaysAcross * 2 - 1) * tangentX,
                           ((i / kRaysAcross + 0.5) / kRaysDown * 2 - 1) * tangentY, 1.0);
      nearest = std::min(nearest, depthAlong(triangle, ray));
    }
  }
  return nearest;
}
}  // namespace

void fitNearAndFar(scene::Camera& camera, const scene::SceneDescription& description) {
  const double tangentY = std::tan(camera.verticalFovRadians / 2), tangentX = tangentY * kWidestAspect;
  const std::vector<Triangle> triangles = trianglesFromEye(camera, description);
  double nearest = kNothing, farthest = 0.0, farthestAnywhere = 0.0;
  for (const Triangle& triangle : triangles) {
    double low = kNothing;
    for (const glm::dvec3& corner : triangle.corners) {
      low = std::min(low, corner.z);
      farthest = std::max(farthest, corner.z);
      farthestAnywhere = std::max(farthestAnywhere, glm::length(corner));
    }
    if (low < nearest) nearest = std::min(nearest, nearestSeen(triangle, tangentX, tangentY));
  }
  if (!(farthest > 0.0)) farthest = farthestAnywhere;  // nothing in front: any range will do
  if (!(farthest > 0.0)) farthest = 1.0;
  camera.farDistance = 1.1 * farthest;
  // Only where the range is hard on the depth buffer is it worth asking for what is hardly seen.
  if (nearest < camera.farDistance / 5000.0) {
    const double ofRays = nearestOfRays(triangles, tangentX, tangentY);
    if (ofRays < kNothing) nearest = std::max(nearest, kSliver * ofRays);
  }
  // Nothing in view, or only slivers through the eye: any near plane shows the same.
  if (!(nearest > 0.0 && nearest < kNothing)) nearest = camera.farDistance / 5000.0;
  camera.nearDistance = std::min(0.9 * nearest, 0.5 * camera.farDistance);
  if (camera.leastNearDistance > 0.0 && camera.leastNearDistance < farthest) {
    // From far away a share of the distance would be many times the scene, and most of the depth buffer.
    const double begin = std::max(std::min(nearest, farthest), camera.leastNearDistance);
    const double margin = kFarAwayMargin * (farthest - begin);
    camera.nearDistance = std::max(begin - margin, camera.leastNearDistance);
    camera.farDistance = farthest + std::max(margin, 1e-6 * farthest);
  }
}

}  // namespace halfshadow::scenes
