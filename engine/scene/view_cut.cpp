// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/view_cut.hpp"

#include <algorithm>
#include <array>

#include "scene/bounds.hpp"

namespace halfshadow::scene {
namespace {
/// Of an edge's length: what a cut in single precision may put a place off by.
constexpr double kCutRounding = 1.0 / (1 << 23);
/// Of a pixel: by so much a place may be off.
constexpr double kPixelShare = 1.0 / 16.0;
/// The part kept reaches so far beyond the view's sides, so that a rasteriser has nothing left to cut there.
constexpr double kMargin = 1.125;

struct Corner {
  glm::dvec3 position{0.0}, normal{0.0};
  glm::dvec2 texcoord{0.0};
  glm::dvec4 color{0.0};
  glm::dvec4 clip{0.0};
};

Corner between(const Corner& a, const Corner& b, double at) {
  return {glm::mix(a.position, b.position, at), glm::mix(a.normal, b.normal, at),
          glm::mix(a.texcoord, b.texcoord, at), glm::mix(a.color, b.color, at), glm::mix(a.clip, b.clip, at)};
}

/// Sutherland, Hodgman, "Reentrant polygon clipping", 1974; in homogeneous coordinates.
void cut(std::vector<Corner>& polygon) {
  const std::array<glm::dvec4, 6> inside{{{0, 0, 1, 1},
                                          {1, 0, 0, kMargin},
                                          {-1, 0, 0, kMargin},
                                          {0, 1, 0, kMargin},
                                          {0, -1, 0, kMargin},
                                          {0, 0, -1, 1}}};
  std::vector<Corner> kept;
  for (const glm::dvec4& plane : inside) {
    kept.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double sideA = glm::dot(plane, a.clip), sideB = glm::dot(plane, b.clip);
      if (sideA >= 0.0) kept.push_back(a);
      if ((sideA >= 0.0) != (sideB >= 0.0)) kept.push_back(between(a, b, sideA / (sideA - sideB)));
    }
    polygon.swap(kept);
  }
}

/// Whether rounding shows of corners so far apart, on what lies in the box.
bool isTooWide(double length, const Bounds& boxWorld, const ObjectView& view) {
  const glm::dvec3 nearest = glm::clamp(view.eyeWorld, boxWorld.low, boxWorld.high);
  const double distance = std::max(glm::length(nearest - view.eyeWorld), view.nearDistance);
  return length * kCutRounding > kPixelShare * view.pixelAngle * distance;
}
bool isTooWide(const std::array<glm::dvec3, 3>& cornersWorld, const ObjectView& view) {
  const auto& [a, b, c] = cornersWorld;
  Bounds box;
  for (const glm::dvec3& corner : cornersWorld) box.include(corner);
  return isTooWide(std::max({glm::length(a - b), glm::length(b - c), glm::length(c - a)}), box, view);
}

class Builder {
 public:
  explicit Builder(const TriangleMesh& source) : source_(source) {}
  void keep(std::size_t first) {
    for (std::size_t k = first; k < first + 3; ++k) {
      const std::uint32_t v = source_.indices[k];
      result_.positions.push_back(source_.positions[v]);
      if (!source_.normals.empty()) result_.normals.push_back(source_.normals[v]);
      if (!source_.texcoords.empty()) result_.texcoords.push_back(source_.texcoords[v]);
      if (!source_.colors.empty()) result_.colors.push_back(source_.colors[v]);
      result_.indices.push_back(static_cast<std::uint32_t>(result_.indices.size()));
    }
  }
  void add(const Corner& corner) {
    result_.positions.emplace_back(corner.position);
    if (!source_.normals.empty()) result_.normals.emplace_back(corner.normal);
    if (!source_.texcoords.empty()) result_.texcoords.emplace_back(corner.texcoord);
    if (!source_.colors.empty()) result_.colors.emplace_back(corner.color);
    result_.indices.push_back(static_cast<std::uint32_t>(result_.indices.size()));
  }
  Corner corner(std::uint32_t v, const glm::dmat4& clipFromObject) const {
    const glm::dvec3 position(source_.positions[v]);
    return {.position = position,
            .normal = source_.normals.empty() ? glm::dvec3(0.0) : glm::dvec3(source_.normals[v]),
            .texcoord = source_.texcoords.empty() ? glm::dvec2(0.0) : glm::dvec2(source_.texcoords[v]),
            .color = source_.colors.empty() ? glm::dvec4(0.0) : glm::dvec4(source_.colors[v]),
            .clip = clipFromObject * glm::dvec4(position, 1.0)};
  }
  TriangleMesh take() { return std::move(result_); }

 private:
  const TriangleMesh& source_;
  TriangleMesh result_;
};
}  // namespace

std::optional<TriangleMesh> cutToView(const TriangleMesh& mesh, const ObjectView& view) {
  const Bounds box = transformed(view.worldFromObject, boundsOf(mesh));
  if (!isTooWide(2.0 * box.radius(), box, view)) return std::nullopt;
  std::vector<bool> wide(mesh.triangleCount());
  bool any = false;
  for (std::size_t t = 0; t < wide.size(); ++t) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 position(mesh.positions[mesh.indices[3 * t + k]]);
      corners[k] = glm::dvec3(view.worldFromObject * glm::dvec4(position, 1.0));
    }
    wide[t] = isTooWide(corners, view);
    any = any || wide[t];
  }
  if (!any) return std::nullopt;
  Builder builder(mesh);
  std::vector<Corner> polygon;
  for (std::size_t t = 0; t < wide.size(); ++t) {
    if (!wide[t]) {
      builder.keep(3 * t);
      continue;
    }
    polygon.clear();
    for (std::size_t k = 0; k < 3; ++k)
      polygon.push_back(builder.corner(mesh.indices[3 * t + k], view.clipFromObject));
    cut(polygon);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      for (const Corner* corner : {&polygon[0], &polygon[k - 1], &polygon[k]}) builder.add(*corner);
    }
  }
  return builder.take();
}

}  // namespace halfshadow::scene
