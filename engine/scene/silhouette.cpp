// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene/edge_uses.hpp"
#include "scene/enclosure.hpp"
#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {
namespace {
enum Facing : std::uint8_t { kAway = 0, kTowards = 1, kMixed = 2 };

/// Whether the cluster's faces all look towards `light` (relative to the mesh's origin) or all away.
/// Based on: Sander, Gu, Gortler, Hoppe, Snyder, "Silhouette Clipping", 2000, section 3, anchored cones.
Facing clusterFacing(const FaceCluster& cluster, const glm::vec3& light) {
  const glm::vec3 d = light - cluster.center;
  const float along = glm::dot(cluster.axis, d);
  const float across = std::sqrt(std::max(0.0f, glm::dot(d, d) - along * along));
  const float shared = along * cluster.cosAngle, spread = across * cluster.sinAngle;
  const float rounding = 2e-6f * (std::abs(along) + across);
  if (shared - spread > cluster.highOffset + rounding) return kTowards;
  if (shared + spread < cluster.lowOffset - rounding) return kAway;
  return kMixed;
}

void findFacing(const HalfEdgeMesh& mesh, const glm::vec3& light, SilhouetteScratch& scratch, Silhouette& s) {
  const std::span<const FaceCluster> clusters = mesh.clusters();
  const std::span<const glm::vec4> planes = mesh.facePlanes();
  s.facing.resize(mesh.faces().size());
  scratch.clusterFacing.resize(clusters.size());
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const FaceCluster& cluster = clusters[c];
    const Facing facing = clusterFacing(cluster, light);
    scratch.clusterFacing[c] = facing;
    std::uint8_t* const faces = s.facing.data() + cluster.firstFace;
    if (facing != kMixed) {
      std::memset(faces, facing, cluster.faceCount);
      ++s.counters.clustersSkipped;
      continue;
    }
    const glm::vec4* const own = planes.data() + cluster.firstFace;
    for (std::uint32_t f = 0; f < cluster.faceCount; ++f) {
      faces[f] = own[f].x * light.x + own[f].y * light.y + own[f].z * light.z + own[f].w > 0.0f;
    }
    s.counters.facesTested += cluster.faceCount;
  }
}

void link(SilhouetteScratch& scratch, std::uint32_t from, std::uint32_t to) {
  if (scratch.firstLink[from] < 0) scratch.starts.push_back(from);
  scratch.links.push_back({to, scratch.firstLink[from]});
  scratch.firstLink[from] = static_cast<std::int32_t>(scratch.links.size()) - 1;
}

/// Walks linked edges into loops. Every vertex has as many edges in as out, so a walk ends where it began.
void chain(SilhouetteScratch& scratch, Silhouette& s) {
  for (const std::uint32_t start : scratch.starts) {
    while (scratch.firstLink[start] >= 0) {
      const auto first = static_cast<std::uint32_t>(s.vertices.size());
      std::uint32_t at = start;
      do {
        s.vertices.push_back(at);
        const SilhouetteScratch::Link& taken = scratch.links[static_cast<std::size_t>(scratch.firstLink[at])];
        scratch.firstLink[at] = taken.next;
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
  scratch.links.clear();
  scratch.starts.clear();
}
enum class Side { facing, away };

/// Whether the light looks into the fold between two faces of one side.
bool looksInto(const HalfEdgeMesh& mesh, const EdgeRecord& edge, Side side) {
  const glm::vec4 plane = mesh.facePlanes()[edge.face];
  if (glm::dot(glm::vec3(plane), glm::vec3(mesh.facePlanes()[edge.opposite])) >= kSharpFold) return false;
  const glm::uvec3& beyond = mesh.faces()[edge.opposite];
  double above = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double height =
        glm::dot(glm::dvec3(plane), glm::dvec3(mesh.positions()[beyond[k]]) - mesh.origin()) +
        double(plane.w);
    if (std::abs(height) > std::abs(above)) above = height;
  }
  return side == Side::facing ? above > 0.0 : above < 0.0;
}

/// Numbers the regions of a side of a sheet in `s.regions`, between folds that the light looks into. Returns
/// how many; 1 where there is no such fold, and then no numbers.
std::uint32_t findRegions(const HalfEdgeMesh& mesh, const CasterPart& part, Side side, Silhouette& s) {
  if (part.foldedEdges == 0) return 1;
  const auto edges = mesh.edges().subspan(part.firstEdge, part.edgeCount);
  const auto within = [&](std::uint32_t face) { return (s.facing[face] != 0) == (side == Side::facing); };
  const auto inner = [&](const EdgeRecord& edge) {
    return edge.opposite != kNoFace && within(edge.face) && within(edge.opposite);
  };
  if (std::ranges::none_of(
          edges, [&](const EdgeRecord& edge) { return inner(edge) && looksInto(mesh, edge, side); })) {
    return 1;
  }
  DisjointSets sets(part.faceCount);
  for (const EdgeRecord& edge : edges) {
    if (inner(edge) && !looksInto(mesh, edge, side))
      sets.merge(edge.face - part.firstFace, edge.opposite - part.firstFace);
  }
  s.regions.resize(mesh.faces().size(), kNoFace);
  std::vector<std::uint32_t> regionOf(part.faceCount, kNoFace);
  std::uint32_t count = 0;
  for (std::uint32_t f = 0; f < part.faceCount; ++f) {
    std::uint32_t& region = s.regions[part.firstFace + f];
    if (!within(part.firstFace + f)) continue;
    std::uint32_t& known = regionOf[sets.root(f)];
    if (known == kNoFace) known = count++;
    region = known;
  }
  return count;
}

/// For each region the boundary of its faces, in the direction of linkBoundary().
void collectRegionEdges(const HalfEdgeMesh& mesh, const CasterPart& part, Side side, std::uint32_t count,
                        const Silhouette& s, SilhouetteScratch& scratch) {
  scratch.regionEdges.resize(std::max<std::size_t>(scratch.regionEdges.size(), count));
  for (auto& edges : scratch.regionEdges) edges.clear();
  const auto regionOf = [&](std::uint32_t face) {
    const bool within = face != kNoFace && (s.facing[face] != 0) == (side == Side::facing);
    return within ? s.regions[face] : kNoFace;
  };
  for (const EdgeRecord& edge : mesh.edges().subspan(part.firstEdge, part.edgeCount)) {
    const std::uint32_t here = regionOf(edge.face), beyond = regionOf(edge.opposite);
    if (here == beyond) continue;
    const glm::uvec2 along(edge.from, edge.to), back(edge.to, edge.from);
    if (here != kNoFace) scratch.regionEdges[here].push_back(side == Side::facing ? along : back);
    if (beyond != kNoFace) scratch.regionEdges[beyond].push_back(side == Side::facing ? back : along);
  }
}

/// Links the boundary of the part's faces that look towards the light; or of those that look away, turned
/// round.
void linkBoundary(const HalfEdgeMesh& mesh, const CasterPart& part, Side side, SilhouetteScratch& scratch,
                  Silhouette& s) {
  for (const EdgeGroup& group : mesh.edgeGroups().subspan(part.firstGroup, part.groupCount)) {
    const std::uint8_t a = scratch.clusterFacing[group.clusterA];
    if (group.clusterB == kNoFace) {
      if (a == (side == Side::facing ? kAway : kTowards)) continue;
    } else if (a != kMixed && a == scratch.clusterFacing[group.clusterB]) {
      continue;
    }
    s.counters.edgesVisited += group.edgeCount;
    for (const EdgeRecord& edge : mesh.edges().subspan(group.firstEdge, group.edgeCount)) {
      const bool facing = s.facing[edge.face] != 0;
      // A boundary edge continues where its own side ends.
      const bool beyond = edge.opposite != kNoFace ? s.facing[edge.opposite] != 0 : side == Side::away;
      if (facing == beyond) continue;
      if (facing) {
        link(scratch, edge.from, edge.to);
      } else {
        link(scratch, edge.to, edge.from);
      }
    }
  }
}
}  // namespace

void extractSilhouette(const HalfEdgeMesh& mesh, const glm::dvec3& lightObject, SilhouetteScratch& scratch,
                       Silhouette& silhouette) {
  Silhouette& s = silhouette;
  s.vertices.clear();
  s.loops.clear();
  s.parts.clear();
  s.counters = {};
  // Chaining takes all links out again, so that what is there is -1.
  if (scratch.firstLink.size() < mesh.positions().size())
    scratch.firstLink.resize(mesh.positions().size(), -1);
  findFacing(mesh, glm::vec3(lightObject - mesh.origin()), scratch, s);
  for (std::uint32_t i = 0; i < mesh.parts().size(); ++i) {
    const CasterPart& part = mesh.parts()[i];
    for (const Side side : {Side::facing, Side::away}) {
      if (side == Side::away && part.closed) break;
      const std::uint32_t regions = findRegions(mesh, part, side, s);
      if (regions > 1) {
        collectRegionEdges(mesh, part, side, regions, s, scratch);
        for (std::uint32_t region = 0; region < regions; ++region) {
          Silhouette::Part found{.part = i, .firstLoop = static_cast<std::uint32_t>(s.loops.size())};
          found.turnedAway = side == Side::away;
          found.region = region;
          for (const glm::uvec2& edge : scratch.regionEdges[region]) link(scratch, edge.x, edge.y);
          chain(scratch, s);
          found.loopCount = static_cast<std::uint32_t>(s.loops.size()) - found.firstLoop;
          if (found.loopCount > 0) s.parts.push_back(found);
        }
        continue;
      }
      Silhouette::Part found{.part = i, .firstLoop = static_cast<std::uint32_t>(s.loops.size())};
      found.turnedAway = side == Side::away;
      linkBoundary(mesh, part, side, scratch, s);
      chain(scratch, s);
      found.loopCount = static_cast<std::uint32_t>(s.loops.size()) - found.firstLoop;
      found.enclosesLight = enclosesPoint(mesh, part, lightObject);
      if (found.loopCount > 0 || found.enclosesLight) s.parts.push_back(found);
    }
  }
}

void extractSilhouette(const HalfEdgeMesh& mesh, const glm::dvec3& lightObject, Silhouette& silhouette) {
  SilhouetteScratch scratch;
  extractSilhouette(mesh, lightObject, scratch, silhouette);
}

}  // namespace halfshadow::scene
