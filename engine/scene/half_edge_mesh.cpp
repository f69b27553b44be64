// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/half_edge_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "scene/face_clusters.hpp"

namespace halfshadow::scene {
namespace {
struct DirectedEdge {
  std::uint64_t key = 0;  ///< smaller vertex << 32 | larger vertex
  std::uint32_t face = 0;
  bool forward = true;  ///< from the smaller vertex to the larger
  bool operator<(const DirectedEdge& other) const {
    return key != other.key ? key < other.key : face < other.face;
  }
};

std::vector<DirectedEdge> sortedEdges(const std::vector<glm::uvec3>& faces) {
  std::vector<DirectedEdge> edges;
  edges.reserve(faces.size() * 3);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = faces[f][k], b = faces[f][(k + 1) % 3];
      edges.push_back({a < b ? a << 32 | b : b << 32 | a, f, a < b});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Sets of faces that share an edge, as one number per face, counted in order of first face.
std::vector<std::uint32_t> connectedParts(const std::vector<DirectedEdge>& edges, std::size_t faceCount,
                                          std::uint32_t& partCount) {
  std::vector<std::uint32_t> parent(faceCount);
  std::iota(parent.begin(), parent.end(), 0u);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].key != edges[i - 1].key) continue;
    const std::uint32_t a = rootOf(parent, edges[i].face), b = rootOf(parent, edges[i - 1].face);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> partOf(faceCount);
  partCount = 0;
  for (std::uint32_t f = 0; f < faceCount; ++f) {
    const std::uint32_t root = rootOf(parent, f);
    partOf[f] = root == f ? partCount++ : partOf[root];
  }
  return partOf;
}

/// Pairs the two directions of the edge [first, last); what is left over has no opposite.
void pairEdge(std::span<const DirectedEdge> uses, std::vector<EdgeRecord>& records) {
  const auto low = static_cast<std::uint32_t>(uses.front().key >> 32);
  const auto high = static_cast<std::uint32_t>(uses.front().key);
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
  std::uint32_t partCount = 0;
  std::vector<std::uint32_t> partOf = connectedParts(sortedEdges(faces), faces.size(), partCount);
  std::vector<std::uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return partOf[a] < partOf[b]; });
  result.copyPositions(mesh);
  std::vector<glm::uvec3> own;
  for (std::size_t first = 0, last; first < order.size(); first = last) {
    own.clear();
    for (last = first; last < order.size() && partOf[order[last]] == partOf[order[first]]; ++last) {
      own.push_back(faces[order[last]]);
    }
    result.addPart(own, result.parts_.emplace_back());
  }
  result.computePlanes();
  return result;
}

void HalfEdgeMesh::addPart(std::span<const glm::uvec3> faces, CasterPart& part) {
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
  const std::vector<DirectedEdge> uses = sortedEdges(own);
  for (std::size_t first = 0, last; first < uses.size(); first = last) {
    last = first;
    while (last < uses.size() && uses[last].key == uses[first].key) ++last;
    pairEdge({uses.data() + first, last - first}, edges_);
    part.nonManifoldEdges += last - first > 2;
  }
  part.edgeCount = static_cast<std::uint32_t>(edges_.size()) - part.firstEdge;
  part.firstGroup = static_cast<std::uint32_t>(groups_.size());
  groupEdges({edges_.data() + part.firstEdge, part.edgeCount}, part, groups_);
  part.groupCount = static_cast<std::uint32_t>(groups_.size()) - part.firstGroup;
  part.closed = part.boundaryEdges == 0;
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
  for (FaceCluster& cluster : clusters_) fitCluster(cluster, faces_, positions_, planes_, origin_);
}

const HalfEdgeMesh& CasterGeometry::halfEdges(const TriangleMesh& mesh) const {
  if (!built_) {
    halfEdges_ = HalfEdgeMesh::build(mesh);
  } else if (stale_) {
    halfEdges_.updatePositions(mesh);
  }
  built_ = true;
  stale_ = false;
  return halfEdges_;
}

}  // namespace halfshadow::scene
