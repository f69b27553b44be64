// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/light_lines.hpp"

#include "scene/half_edge_mesh.hpp"
#include "scene/light_silhouettes.hpp"
#include "viewer/light_handles.hpp"

namespace halfshadow::viewer {
namespace {
/// A light of no size has no plane coordinates; this share of the scene is small enough to be a point.
constexpr double kSmallestHalf = 1e-4;
/// More lines than this are a surface.
constexpr std::size_t kMostWedgeVertices = 100;

void addWedge(const glm::dvec3& vertex, const scene::AreaLight& light, double floor, double reach,
              std::vector<LightLine>& lines) {
  for (const glm::dvec3& corner : cornersOf(light)) {
    const glm::dvec3 ray = vertex - corner;
    const double length = glm::length(ray);
    if (!(length > 0.0)) continue;
    // To the floor, or as far as the scene reaches.
    double along = reach / length;
    if (ray.y < 0.0) along = glm::min(along, (floor - vertex.y) / ray.y);
    if (along > 0.0) lines.push_back({vertex, vertex + along * ray, true});
  }
}
}  // namespace

std::vector<LightLine> linesOfLight(const View& view, std::size_t lightIndex, bool withWedges) {
  std::vector<LightLine> lines;
  if (!view.scene || lightIndex >= view.lights.size()) return lines;
  const scene::AreaLight& light = view.lights[lightIndex];
  const scene::Bounds bounds = scene::boundsWorld(*view.scene, scene::ObjectFilter::casters);
  if (bounds.empty()) return lines;
  std::vector<scene::HalfEdgeMesh> meshes;
  std::vector<scene::PlacedCaster> casters;
  meshes.reserve(view.scene->objects.size());
  for (const scene::SceneObject& object : view.scene->objects) {
    if (!object.casts) continue;
    meshes.push_back(scene::HalfEdgeMesh::build(*object.mesh));
    casters.push_back({.mesh = &meshes.back(),
                       .worldFromObject = object.worldFromObject,
                       .object = static_cast<std::uint32_t>(casters.size())});
  }
  const double reach = 2.0 * (bounds.radius() + glm::length(light.centerWorld - bounds.center()));
  const scene::LightPlane plane(light, reach, kSmallestHalf * reach);
  scene::LightSilhouettes silhouettes;
  scene::lightSilhouettes(casters, plane, 0.0, 0.0, 1e-4, silhouettes);
  for (const auto& loop : silhouettes.loops) {
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const glm::dvec3 a = plane.toWorld(silhouettes.points[loop.first + i]);
      const glm::dvec3 b = plane.toWorld(silhouettes.points[loop.first + (i + 1) % loop.count]);
      lines.push_back({a, b, false});
    }
  }
  if (!withWedges) return lines;
  const std::size_t count = silhouettes.points.size();
  const std::size_t step = 1 + count / kMostWedgeVertices;
  for (std::size_t i = 0; i < count; i += step)
    addWedge(plane.toWorld(silhouettes.points[i]), light, bounds.low.y, reach, lines);
  return lines;
}

}  // namespace halfshadow::viewer
