// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/face_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace halfshadow::scene {
namespace {
/// Place (in units of the part's extent) and normal of a face.
using Feature = std::array<float, 6>;

int widestDimension(std::span<const std::uint32_t> order, const std::vector<Feature>& features) {
  Feature low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (const std::uint32_t f : order) {
    for (std::size_t k = 0; k < 6; ++k) {
      low[k] = std::min(low[k], features[f][k]);
      high[k] = std::max(high[k], features[f][k]);
    }
  }
  int widest = 0;
  for (int k = 1; k < 6; ++k) {
    if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
  }
  return widest;
}

/// Halves the range across its widest dimension until it fits a cluster; all clusters but one are full.
void split(std::span<std::uint32_t> order, const std::vector<Feature>& features) {
  if (order.size() <= kClusterFaces) return;
  const std::size_t clusters = (order.size() + kClusterFaces - 1) / kClusterFaces;
  const std::size_t middle = clusters / 2 * kClusterFaces;
  const auto k = static_cast<std::size_t>(widestDimension(order, features));
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(middle), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return features[a][k] != features[b][k] ? features[a][k] < features[b][k] : a < b;
                   });
  split(order.first(middle), features);
  split(order.subspan(middle), features);
}
}  // namespace

std::vector<std::uint32_t> clusterOrder(std::span<const glm::uvec3> faces,
                                        std::span<const glm::vec3> positions) {
  std::vector<std::uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0u);
  if (faces.size() <= kClusterFaces) return order;
  Bounds bounds;
  for (const glm::uvec3& face : faces) {
    for (int k = 0; k < 3; ++k) bounds.include(glm::dvec3(positions[face[k]]));
  }
  const glm::dvec3 center = bounds.center();
  const double scale = 1.0 / bounds.radius();
  std::vector<Feature> features(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const glm::dvec3 a(positions[faces[f].x]), b(positions[faces[f].y]), c(positions[faces[f].z]);
    const glm::dvec3 place = ((a + b + c) / 3.0 - center) * scale;
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    const glm::dvec3 normal = length > 0.0 ? cross / length : glm::dvec3(0.0);
    for (int k = 0; k < 3; ++k) {
      features[f][static_cast<std::size_t>(k)] = static_cast<float>(place[k]);
      features[f][static_cast<std::size_t>(k + 3)] = static_cast<float>(normal[k]);
    }
  }
  split(order, features);
  return order;
}

void fitCluster(FaceCluster& cluster, std::span<const glm::uvec3> faces, std::span<const glm::vec3> positions,
                std::span<const glm::vec4> planes, const glm::dvec3& origin) {
  const std::uint32_t first = cluster.firstFace, end = first + cluster.faceCount;
  Bounds bounds;
  glm::vec3 sum(0.0f);
  for (std::uint32_t f = first; f < end; ++f) {
    for (int k = 0; k < 3; ++k) bounds.include(glm::dvec3(positions[faces[f][k]]) - origin);
    sum += glm::vec3(planes[f]);
  }
  cluster.center = glm::vec3(bounds.center());
  const float length = glm::length(sum);
  cluster.axis = length > 0.0f ? sum / length : glm::vec3(0.0f);
  cluster.cosAngle = 1.0f;
  cluster.lowOffset = cluster.highOffset = 0.0f;
  for (std::uint32_t f = first; f < end; ++f) {
    const glm::vec3 normal(planes[f]);
    cluster.cosAngle = std::min(cluster.cosAngle, glm::dot(normal, cluster.axis));
    const float offset = -planes[f].w - glm::dot(normal, cluster.center);
    cluster.lowOffset = std::min(cluster.lowOffset, offset);
    cluster.highOffset = std::max(cluster.highOffset, offset);
  }
  // From 85 degrees on the cone excludes next to nothing; below, the two inequalities of its test hold.
  if (cluster.cosAngle < 0.09f) {
    cluster.lowOffset = -std::numeric_limits<float>::infinity();
    cluster.highOffset = std::numeric_limits<float>::infinity();
  }
  cluster.sinAngle = std::sqrt(std::max(0.0f, 1.0f - cluster.cosAngle * cluster.cosAngle));
}

}  // namespace halfshadow::scene
