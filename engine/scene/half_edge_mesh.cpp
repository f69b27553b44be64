// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/half_edge_mesh.hpp"

#include <algorithm>
#include <utility>

#include "scene/edge_uses.hpp"
#include "scene/face_clusters.hpp"
#include "scene/mesh_repair.hpp"

namespace halfshadow::scene {
namespace {
/// A part with few concave edges and dents no deeper than this share of its radius counts as convex.
constexpr double kShallowDent = 0.02;
constexpr std::uint32_t kMostConcaveEdges = 16;

/// Pairs the two directions of the edge [first, last); what is left over has no opposite.
void pairEdge(std::span<const EdgeUse> uses, std::vector<EdgeRecord>& records) {
  const std::uint32_t low = uses.front().low(), high = uses.front().high();
  std::size_t f = 0, b = 0;
  const auto seek = [&](std::size_t& i, bool forward) {
    while (i < uses.size() && uses[i].forward != forward) ++i;
    return i < uses.size();
  };
  while (true) {
    const bool hasForward = seek(f, true), hasBackward = seek(b, false);
    if (!hasForward && !hasBackward) return;
    if (hasForward) {
      records.push_back({low, high, uses[f++].face, hasBackward ? uses[b++].face : kNoFace});
    } else {
      records.push_back({high, low, uses[b++].face, kNoFace});
    }
  }
}
/// Sorts the edges of `part` by the clusters of their faces, makes face numbers those of the whole mesh and
/// counts boundary edges.
void groupEdges(std::span<EdgeRecord> edges, CasterPart& part, std::vector<EdgeGroup>& groups) {
  const auto clusters = [](const EdgeRecord& edge) {
    const std::uint32_t a = edge.face / kClusterFaces;
    const std::uint32_t b = edge.opposite == kNoFace ? kNoFace : edge.opposite / kClusterFaces;
    return std::pair(std::min(a, b), std::max(a, b));
  };
  std::stable_sort(edges.begin(), edges.end(),
                   [&](const EdgeRecord& a, const EdgeRecord& b) { return clusters(a) < clusters(b); });
  for (std::uint32_t first = 0, last; first < edges.size(); first = last) {
    const auto pair = clusters(edges[first]);
    for (last = first; last < edges.size() && clusters(edges[last]) == pair; ++last) {
    }
    const std::uint32_t b = pair.second == kNoFace ? kNoFace : part.firstCluster + pair.second;
    groups.push_back({part.firstCluster + pair.first, b, part.firstEdge + first, last - first});
    if (b == kNoFace) part.boundaryEdges += last - first;
  }
  for (EdgeRecord& edge : edges) {
    edge.face += part.firstFace;
    if (edge.opposite != kNoFace) edge.opposite += part.firstFace;
  }
}
}  // namespace

HalfEdgeMesh HalfEdgeMesh::build(const TriangleMesh& mesh) {
  HalfEdgeMesh result;
  std::vector<std::uint32_t> compact(mesh.positions.size(), kNoFace);
  std::vector<glm::uvec3> faces(mesh.triangleCount());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t source = mesh.weldedVertex[mesh.indices[i]];
    if (compact[source] == kNoFace) {
      compact[source] = static_cast<std::uint32_t>(result.sourceVertex_.size());
      result.sourceVertex_.push_back(source);
    }
    faces[i / 3][i % 3] = compact[source];
  }
  // Parts are told by the windings of the source: what was inward there is remembered.
  for (std::size_t t = 0; t < mesh.turned.size(); ++t) {
    if (mesh.turned[t]) std::swap(faces[t].y, faces[t].z);
  }
  result.copyPositions(mesh);
  for (const RepairedPart& part : repairParts(std::move(faces), result.positions_, result.repairs_)) {
    result.addPart(part.faces, part.facts);
  }
  result.computePlanes();
  return result;
}

void HalfEdgeMesh::addPart(std::span<const glm::uvec3> faces, CasterPart part) {
  part.firstFace = static_cast<std::uint32_t>(faces_.size());
  part.faceCount = static_cast<std::uint32_t>(faces.size());
  std::vector<glm::uvec3> own(faces.size());
  const std::vector<std::uint32_t> order = clusterOrder(faces, positions_);
  std::transform(order.begin(), order.end(), own.begin(), [&](std::uint32_t f) { return faces[f]; });
  faces_.insert(faces_.end(), own.begin(), own.end());

  part.firstCluster = static_cast<std::uint32_t>(clusters_.size());
  part.clusterCount = (part.faceCount + kClusterFaces - 1) / kClusterFaces;
  for (std::uint32_t f = 0; f < part.faceCount; f += kClusterFaces) {
    clusters_.push_back({part.firstFace + f, std::min(kClusterFaces, part.faceCount - f)});
  }

  part.firstEdge = static_cast<std::uint32_t>(edges_.size());
  forEachEdge(edgeUses(own), [&](std::span<const EdgeUse> edge) {
    pairEdge(edge, edges_);
    part.nonManifoldEdges += edge.size() > 2;
  });
  part.edgeCount = static_cast<std::uint32_t>(edges_.size()) - part.firstEdge;
  part.firstGroup = static_cast<std::uint32_t>(groups_.size());
  groupEdges({edges_.data() + part.firstEdge, part.edgeCount}, part, groups_);
  part.groupCount = static_cast<std::uint32_t>(groups_.size()) - part.firstGroup;
  parts_.push_back(part);
}

void HalfEdgeMesh::updatePositions(const TriangleMesh& mesh) {
  copyPositions(mesh);
  computePlanes();
}

void HalfEdgeMesh::copyPositions(const TriangleMesh& mesh) {
  positions_.resize(sourceVertex_.size());
  Bounds all;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    positions_[i] = mesh.positions[sourceVertex_[i]];
    all.include(glm::dvec3(positions_[i]));
  }
  origin_ = all.empty() ? glm::dvec3(0.0) : all.center();
}

void HalfEdgeMesh::computePlanes() {
  planes_.resize(faces_.size());
  for (CasterPart& part : parts_) {
    part.bounds = {};
    for (std::uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
      const glm::dvec3 a(positions_[faces_[f].x]), b(positions_[faces_[f].y]), c(positions_[faces_[f].z]);
      const glm::dvec3 cross = glm::cross(b - a, c - a);
      const double length = glm::length(cross);
      const glm::dvec3 normal = length > 0.0 ? cross / length : glm::dvec3(0.0);
      planes_[f] = glm::vec4(glm::vec3(normal), static_cast<float>(-glm::dot(normal, a - origin_)));
      for (const glm::dvec3& p : {a, b, c}) part.bounds.include(p);
    }
  }
  for (CasterPart& part : parts_) {
    part.convex = isConvex(part);
    part.foldedEdges = foldedEdges(part);
  }
  for (FaceCluster& cluster : clusters_) fitCluster(cluster, faces_, positions_, planes_, origin_);
}

std::uint32_t HalfEdgeMesh::foldedEdges(const CasterPart& part) const {
  if (part.closed) return 0;
  const auto own = edges().subspan(part.firstEdge, part.edgeCount);
  return static_cast<std::uint32_t>(std::ranges::count_if(own, [&](const EdgeRecord& edge) {
    return edge.opposite != kNoFace &&
           glm::dot(glm::vec3(planes_[edge.face]), glm::vec3(planes_[edge.opposite])) < kSharpFold;
  }));
}

bool HalfEdgeMesh::isConvex(const CasterPart& part) const {
  // What rounding to single precision can do to a plane of this part.
  const double flat = 4e-6 * part.bounds.radius() + 4e-7 * glm::length(part.bounds.center() - origin_);
  const auto above = [&](std::uint32_t face, std::uint32_t vertex) {
    return glm::dot(glm::dvec3(planes_[face]), glm::dvec3(positions_[vertex]) - origin_) +
           double(planes_[face].w);
  };
  const auto withinOf = [&](std::uint32_t face, std::uint32_t other, double tolerance) {
    for (int k = 0; k < 3; ++k) {
      const double height = above(face, faces_[other][k]);
      if ((part.closed ? height : std::abs(height)) > tolerance) return false;
    }
    return true;
  };
  const double dent = kShallowDent * part.bounds.radius();
  std::uint32_t concave = 0;
  for (const EdgeRecord& edge : edges().subspan(part.firstEdge, part.edgeCount)) {
    if (edge.opposite == kNoFace ||
        (withinOf(edge.face, edge.opposite, flat) && withinOf(edge.opposite, edge.face, flat)))
      continue;
    // Every dent has concave edges at its bottom, and its rim stands above their faces.
    if (++concave > kMostConcaveEdges) return false;
    for (std::uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
      if (!withinOf(edge.face, f, dent) || !withinOf(edge.opposite, f, dent)) return false;
    }
  }
  return true;
}

std::string describe(const CasterPart& part) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  const auto count = [](std::uint32_t n, const char* one, const char* many) {
    return std::to_string(n) + (n == 1 ? one : many);
  };
  if (part.issue == PartIssue::open)
    add("open: " + count(part.boundaryEdges, " border edge", " border edges"));
  if (part.issue == PartIssue::nonManifold) {
    add("a fin, an inner wall or a junction that no closed shell explains: " +
        count(part.boundaryEdges, " border edge", " border edges"));
  }
  if (part.issue == PartIssue::notOrientable) add("its faces cannot all be wound alike");
  if (part.inward) add("wound inward: taken as outward");
  if (part.flippedFaces > 0 && !part.inward)
    add(count(part.flippedFaces, " face", " faces") + " turned round");
  if (part.repairedTJunctions > 0) {
    add(count(part.repairedTJunctions, " T-junction", " T-junctions") + " split");
  }
  if (part.filledGaps > 0)
    add(count(part.filledGaps, " crack or small hole", " cracks or small holes") + " filled");
  return text;
}

}  // namespace halfshadow::scene
