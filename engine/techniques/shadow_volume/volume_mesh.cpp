// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_volume/volume_mesh.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace halfshadow::techniques {
namespace {
using scene::HalfEdgeMesh;
using scene::kNoFace;
using scene::Silhouette;

/// Share of a direction's length that must point along the axis of the hemisphere: directions nearly square
/// to it have huge tangents.
constexpr double kHemisphereMargin = 1e-3;

int layersOfFace(const Silhouette& silhouette, std::uint32_t face, bool sheet) {
  return silhouette.facing[face] != 0 ? 1 : (sheet ? -1 : 0);
}

/// Boundary of the faces [first, first + count) of a part, each counted as often as it covers.
void appendBoundary(const HalfEdgeMesh& mesh, const scene::CasterPart& part, const Silhouette& silhouette,
                    const VolumeChunk::Group& faces, std::vector<glm::uvec2>& edges) {
  const auto layersOf = [&](std::uint32_t face) {
    if (face == kNoFace || face < faces.firstFace || face >= faces.firstFace + faces.faceCount) return 0;
    return layersOfFace(silhouette, face, faces.sheet);
  };
  for (const scene::EdgeRecord& edge : mesh.edges().subspan(part.firstEdge, part.edgeCount)) {
    int layers = layersOf(edge.face) - layersOf(edge.opposite);
    for (; layers > 0; --layers) edges.emplace_back(edge.from, edge.to);
    for (; layers < 0; ++layers) edges.emplace_back(edge.to, edge.from);
  }
}

void appendLoops(const Silhouette& silhouette, const Silhouette::Part& part, std::vector<glm::uvec2>& edges) {
  for (std::uint32_t l = part.firstLoop; l < part.firstLoop + part.loopCount; ++l) {
    const Silhouette::Loop& loop = silhouette.loops[l];
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      edges.emplace_back(silhouette.vertices[loop.first + i],
                         silhouette.vertices[loop.first + (i + 1 == loop.count ? 0 : i + 1)]);
    }
  }
}

bool withinHemisphere(const scene::Bounds& bounds, const glm::dvec3& light) {
  const glm::dvec3 axis = bounds.center() - light;
  return std::ranges::all_of(bounds.corners(), [&](const glm::dvec3& corner) {
    const glm::dvec3 direction = corner - light;
    return glm::dot(direction, axis) > kHemisphereMargin * glm::length(direction) * glm::length(axis);
  });
}

/// Largest number of edges that rise through one level of a tangent, the smaller of two directions. Seen
/// from the light, the edges wind around a point as often as edges rise past it on one side, less those that
/// fall.
int risingEdges(const HalfEdgeMesh& mesh, const std::vector<glm::uvec2>& edges, const glm::dvec3& light,
                const glm::dvec3& axis) {
  const glm::dvec3 helper = std::abs(axis.x) < std::abs(axis.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 first = glm::cross(axis, helper), second = glm::cross(axis, first);
  int best = std::numeric_limits<int>::max();
  std::vector<std::pair<double, int>> events;
  for (const glm::dvec3& across : {first, second}) {
    const auto tangent = [&](std::uint32_t vertex) {
      const glm::dvec3 direction = glm::dvec3(mesh.positions()[vertex]) - light;
      return glm::dot(direction, across) / glm::dot(direction, axis);
    };
    events.clear();
    for (const glm::uvec2& edge : edges) {
      const double from = tangent(edge.x), to = tangent(edge.y);
      if (from < to) events.insert(events.end(), {{from, 1}, {to, -1}});
    }
    std::ranges::sort(events);  // ends before beginnings
    int rising = 0, most = 0;
    for (const auto& [level, change] : events) most = std::max(most, rising += change);
    best = std::min(best, most);
  }
  return best;
}

class Splitter {
 public:
  Splitter(const HalfEdgeMesh& mesh, const Silhouette& silhouette, const glm::dvec3& light, int maxLayers)
      : mesh_(mesh), silhouette_(silhouette), light_(light), maxLayers_(maxLayers) {}

  /// `found`: the part's entries of the silhouette, perhaps none.
  void addPart(const scene::CasterPart& part, std::span<const Silhouette::Part> found) {
    const bool enclosesLight = std::ranges::any_of(found, &Silhouette::Part::enclosesLight);
    // Seen from inside, a closed caster is a sheet around the light.
    const VolumeChunk::Group group{
        .firstFace = part.firstFace, .faceCount = part.faceCount, .sheet = !part.closed || enclosesLight};
    std::vector<glm::uvec2> edges;
    if (enclosesLight) {
      appendBoundary(mesh_, part, silhouette_, group, edges);
    } else {
      for (const Silhouette::Part& entry : found) appendLoops(silhouette_, entry, edges);
    }
    // Without edges it hides nothing, or surrounds the light.
    if (edges.empty() && covering(group) == 0) return;
    add(part, group, edges, part.bounds);
  }

  std::vector<VolumeChunk> take() { return std::move(chunks_); }

 private:
  void add(const scene::CasterPart& part, VolumeChunk::Group group, const std::vector<glm::uvec2>& edges,
           const scene::Bounds& bounds) {
    group.withinHemisphere = withinHemisphere(bounds, light_);
    const int layers = group.withinHemisphere ? risingEdges(mesh_, edges, light_, bounds.center() - light_)
                                              : covering(group);
    if (layers <= maxLayers_ || group.faceCount <= 1) {
      append(group, edges, layers);
      return;
    }
    VolumeChunk::Group halves[2] = {group, group};
    halves[0].faceCount = group.faceCount / 2;
    halves[1].firstFace += halves[0].faceCount;
    halves[1].faceCount -= halves[0].faceCount;
    for (const VolumeChunk::Group& half : halves) {
      std::vector<glm::uvec2> own;
      appendBoundary(mesh_, part, silhouette_, half, own);
      scene::Bounds ownBounds;
      for (std::uint32_t f = half.firstFace; f < half.firstFace + half.faceCount; ++f) {
        for (int k = 0; k < 3; ++k) ownBounds.include(glm::dvec3(mesh_.positions()[mesh_.faces()[f][k]]));
      }
      add(part, half, own, ownBounds);
    }
  }

  /// A ray meets a face at most once.
  int covering(const VolumeChunk::Group& group) const {
    int count = 0;
    for (std::uint32_t f = group.firstFace; f < group.firstFace + group.faceCount; ++f) {
      count += layersOfFace(silhouette_, f, group.sheet) != 0;
    }
    return count;
  }

  void append(VolumeChunk::Group group, const std::vector<glm::uvec2>& edges, int layers) {
    if (chunks_.empty() || chunks_.back().layers + layers > maxLayers_) chunks_.emplace_back();
    VolumeChunk& chunk = chunks_.back();
    group.firstEdge = static_cast<std::uint32_t>(chunk.edges.size());
    group.edgeCount = static_cast<std::uint32_t>(edges.size());
    chunk.groups.push_back(group);
    chunk.edges.insert(chunk.edges.end(), edges.begin(), edges.end());
    chunk.layers += layers;
  }

  const HalfEdgeMesh& mesh_;
  const Silhouette& silhouette_;
  glm::dvec3 light_;
  int maxLayers_;
  std::vector<VolumeChunk> chunks_;
};

class Builder {
 public:
  Builder(const HalfEdgeMesh& mesh, const glm::dmat4& worldFromObject, const glm::dvec3& lightWorld,
          std::uint32_t maxVertices)
      : mesh_(mesh),
        linear_(worldFromObject),
        offset_(glm::dvec3(worldFromObject[3]) - lightWorld),
        maxVertices_(maxVertices),
        slots_(2 * mesh.positions().size(), kNone) {}

  void beginChunk(std::uint32_t chunk) {
    const std::uint32_t base = result_.ranges.empty() ? 0 : result_.ranges.back().firstVertex;
    result_.ranges.push_back({base, static_cast<std::uint32_t>(result_.indices.size()), 0, chunk});
  }
  std::uint32_t near(std::uint32_t vertex) const { return 2 * vertex; }
  std::uint32_t far(std::uint32_t vertex) const { return 2 * vertex + 1; }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (result_.vertices.size() - result_.ranges.back().firstVertex + 3 > maxVertices_) split();
    for (const std::uint32_t key : {a, b, c}) result_.indices.push_back(slotOf(key));
    result_.ranges.back().indexCount += 3;
  }
  VolumeMesh take() {
    std::erase_if(result_.ranges, [](const VolumeMesh::Range& range) { return range.indexCount == 0; });
    return std::move(result_);
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  void split() {
    const std::uint32_t chunk = result_.ranges.back().chunk;
    result_.ranges.push_back({static_cast<std::uint32_t>(result_.vertices.size()),
                              static_cast<std::uint32_t>(result_.indices.size()), 0, chunk});
    std::ranges::fill(slots_, kNone);
  }
  std::uint32_t slotOf(std::uint32_t key) {
    std::uint32_t& slot = slots_[key];
    if (slot == kNone) {
      slot = static_cast<std::uint32_t>(result_.vertices.size()) - result_.ranges.back().firstVertex;
      const glm::vec3& position = mesh_.positions()[key / 2];
      result_.vertices.push_back(key % 2 == 0
                                     ? glm::vec4(position, 1.0f)
                                     : glm::vec4(glm::vec3(linear_ * glm::dvec3(position) + offset_), 0.0f));
    }
    return slot;
  }

  const HalfEdgeMesh& mesh_;
  glm::dmat3 linear_;
  glm::dvec3 offset_;
  std::uint32_t maxVertices_;
  std::vector<std::uint32_t> slots_;
  VolumeMesh result_;
};

void appendCaps(const HalfEdgeMesh& mesh, const Silhouette& silhouette, const VolumeChunk& chunk,
                const VolumeChunk::Group& group, Builder& builder) {
  for (std::uint32_t f = group.firstFace; f < group.firstFace + group.faceCount; ++f) {
    const int layers = layersOfFace(silhouette, f, group.sheet);
    if (layers == 0) continue;
    const glm::uvec3& face = mesh.faces()[f];
    const std::uint32_t second = layers > 0 ? face.y : face.z, third = layers > 0 ? face.z : face.y;
    builder.triangle(builder.near(face.x), builder.near(second), builder.near(third));
    if (!group.withinHemisphere)
      builder.triangle(builder.far(face.x), builder.far(third), builder.far(second));
  }
  if (!group.withinHemisphere) return;
  // What the fan covers twice with opposite signs cancels in the count.
  for (std::uint32_t e = group.firstEdge; e < group.firstEdge + group.edgeCount; ++e) {
    const std::uint32_t apex = chunk.edges[group.firstEdge].x;
    const glm::uvec2& edge = chunk.edges[e];
    if (edge.x == apex || edge.y == apex) continue;
    builder.triangle(builder.far(apex), builder.far(edge.y), builder.far(edge.x));
  }
}
}  // namespace

std::vector<VolumeChunk> volumeChunks(const HalfEdgeMesh& mesh, const Silhouette& silhouette,
                                      const glm::dvec3& lightObject, int maxLayers) {
  Splitter splitter(mesh, silhouette, lightObject, maxLayers);
  const std::span<const Silhouette::Part> all = silhouette.parts;
  std::size_t first = 0;
  for (std::uint32_t i = 0; i < mesh.parts().size(); ++i) {
    std::size_t last = first;
    while (last < all.size() && all[last].part == i) ++last;
    splitter.addPart(mesh.parts()[i], all.subspan(first, last - first));
    first = last;
  }
  return splitter.take();
}

VolumeMesh buildVolumeMesh(const HalfEdgeMesh& mesh, const Silhouette& silhouette,
                           const std::vector<VolumeChunk>& chunks, const glm::dmat4& worldFromObject,
                           const glm::dvec3& lightWorld, VolumeSurface surface, std::uint32_t maxVertices) {
  Builder builder(mesh, worldFromObject, lightWorld, maxVertices);
  for (std::uint32_t i = 0; i < chunks.size(); ++i) {
    builder.beginChunk(i);
    for (const glm::uvec2& edge : chunks[i].edges) {
      const std::uint32_t from = builder.near(edge.x), to = builder.near(edge.y);
      const std::uint32_t farFrom = builder.far(edge.x), farTo = builder.far(edge.y);
      builder.triangle(to, from, farFrom);
      builder.triangle(to, farFrom, farTo);
    }
    if (surface == VolumeSurface::sides) continue;
    for (const VolumeChunk::Group& group : chunks[i].groups) {
      appendCaps(mesh, silhouette, chunks[i], group, builder);
    }
  }
  return builder.take();
}

}  // namespace halfshadow::techniques
