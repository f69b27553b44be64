// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {
namespace {
/// Layers that a face adds seen from the light: of a closed part its light-facing faces; of a sheet all
/// faces, those that look away turned round.
int layersOf(bool facing, bool closed) {
  return facing ? 1 : (closed ? 0 : -1);
}

bool inside(const Bounds& bounds, const glm::dvec3& p) {
  return glm::all(glm::greaterThanEqual(p, bounds.low)) && glm::all(glm::lessThanEqual(p, bounds.high));
}

/// Winding number of a closed part around a point, from the faces' solid angles.
/// Based on: Van Oosterom, Strackee, "The Solid Angle of a Plane Triangle", 1983.
double windingNumber(const HalfEdgeMesh& mesh, const CasterPart& part, const glm::dvec3& point) {
  double sum = 0.0;
  for (std::uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
    const glm::uvec3& face = mesh.faces()[f];
    const glm::dvec3 a = glm::dvec3(mesh.positions()[face.x]) - point;
    const glm::dvec3 b = glm::dvec3(mesh.positions()[face.y]) - point;
    const glm::dvec3 c = glm::dvec3(mesh.positions()[face.z]) - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (2.0 * 3.14159265358979323846);
}

void link(Silhouette& s, std::uint32_t from, std::uint32_t to) {
  if (s.firstLink[from] < 0) s.starts.push_back(from);
  s.links.push_back({to, s.firstLink[from]});
  s.firstLink[from] = static_cast<std::int32_t>(s.links.size()) - 1;
}

/// Walks linked edges into loops. Every vertex has as many edges in as out, so a walk ends where it began.
void chain(Silhouette& s) {
  for (const std::uint32_t start : s.starts) {
    while (s.firstLink[start] >= 0) {
      const auto first = static_cast<std::uint32_t>(s.vertices.size());
      std::uint32_t at = start;
      do {
        s.vertices.push_back(at);
        const Silhouette::Link& taken = s.links[static_cast<std::size_t>(s.firstLink[at])];
        s.firstLink[at] = taken.next;
        at = taken.to;
      } while (at != start);
      const auto count = static_cast<std::uint32_t>(s.vertices.size()) - first;
      // There and back along one edge covers nothing.
      if (count > 2) {
        s.loops.push_back({first, count});
      } else {
        s.vertices.resize(first);
      }
    }
  }
  s.links.clear();
  s.starts.clear();
}
}  // namespace

void extractSilhouette(const HalfEdgeMesh& mesh, const glm::dvec3& lightObject, Silhouette& silhouette) {
  Silhouette& s = silhouette;
  s.vertices.clear();
  s.loops.clear();
  s.parts.clear();
  s.links.clear();
  s.starts.clear();
  s.firstLink.assign(mesh.positions().size(), -1);
  s.facing.resize(mesh.faces().size());
  const glm::vec3 light(lightObject - mesh.origin());
  const std::span<const glm::vec4> planes = mesh.facePlanes();
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const glm::vec4& p = planes[f];
    s.facing[f] = p.x * light.x + p.y * light.y + p.z * light.z + p.w > 0.0f;
  }
  for (std::uint32_t i = 0; i < mesh.parts().size(); ++i) {
    const CasterPart& part = mesh.parts()[i];
    Silhouette::Part found{.part = i, .firstLoop = static_cast<std::uint32_t>(s.loops.size())};
    for (const EdgeRecord& edge : mesh.edges().subspan(part.firstEdge, part.edgeCount)) {
      int layers = layersOf(s.facing[edge.face] != 0, part.closed);
      if (edge.opposite != kNoFace) layers -= layersOf(s.facing[edge.opposite] != 0, part.closed);
      for (; layers > 0; --layers) link(s, edge.from, edge.to);
      for (; layers < 0; ++layers) link(s, edge.to, edge.from);
    }
    chain(s);
    found.loopCount = static_cast<std::uint32_t>(s.loops.size()) - found.firstLoop;
    found.enclosesLight =
        part.closed && inside(part.bounds, lightObject) && windingNumber(mesh, part, lightObject) > 0.5;
    if (found.loopCount > 0 || found.enclosesLight) s.parts.push_back(found);
  }
}

}  // namespace halfshadow::scene
