// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/caster_groups.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "scene/edge_uses.hpp"

namespace halfshadow::scene {
namespace {
/// Steps of single precision by which two places of one vertex may differ: each coordinate and each entry of
/// the matrix was rounded once, and exporters that apply transforms round again.
constexpr double kRoundings = 4.0 / (1 << 24);
/// So many common vertices make a common edge.
constexpr std::uint32_t kCommonVertices = 2;

struct PlacedVertex {
  glm::dvec3 world{0.0};
  double rounding = 0.0;  ///< world length
};

PlacedVertex placedVertex(const SceneCaster& caster, std::uint32_t vertex) {
  const glm::dmat4& m = caster.worldFromObject;
  const glm::dvec3 p(caster.triangles().positions[vertex]), size = glm::abs(p);
  const glm::dvec3 reach = size.x * glm::abs(glm::dvec3(m[0])) + size.y * glm::abs(glm::dvec3(m[1])) +
                           size.z * glm::abs(glm::dvec3(m[2])) + glm::abs(glm::dvec3(m[3]));
  return {glm::dvec3(m * glm::dvec4(p, 1.0)), kRoundings * std::max({reach.x, reach.y, reach.z})};
}

bool coincide(const PlacedVertex& a, const PlacedVertex& b) {
  return glm::length(a.world - b.world) <= a.rounding + b.rounding;
}

/// Finds vertices that coincide with a given one. Cells are powers of two, at least four times as wide as the
/// roundings of what they hold, so that a box of two cells a side holds all candidates.
class VertexGrid {
 public:
  void add(const PlacedVertex& vertex, std::uint32_t id) {
    const int level = levelOf(vertex.rounding);
    levels_.insert(level);
    cells_[keyOf(level, cellAt(vertex.world, level))].push_back({vertex, id});
  }
  /// Calls visit(id) for those with a rounding of the same or a coarser level.
  template <class Visit>
  void forEachAt(const PlacedVertex& vertex, Visit&& visit) const {
    for (auto level = levels_.lower_bound(levelOf(vertex.rounding)); level != levels_.end(); ++level) {
      const double half = 0.5 * std::exp2(*level);
      const glm::i64vec3 first = cellAt(vertex.world - half, *level);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::i64vec3 cell = first + glm::i64vec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const auto found = cells_.find(keyOf(*level, cell));
        if (found == cells_.end()) continue;
        for (const Entry& entry : found->second) {
          if (coincide(vertex, entry.vertex)) visit(entry.id);
        }
      }
    }
  }

 private:
  struct Entry {
    PlacedVertex vertex;
    std::uint32_t id = 0;
  };
  static int levelOf(double rounding) {
    return static_cast<int>(std::ceil(std::log2(std::max(4.0 * rounding, 1e-300))));
  }
  static glm::i64vec3 cellAt(const glm::dvec3& p, int level) {
    return glm::i64vec3(glm::floor(p * std::exp2(-level)));
  }
  static std::uint64_t keyOf(int level, const glm::i64vec3& cell) {
    std::uint64_t key = static_cast<std::uint64_t>(level);
    for (int k = 0; k < 3; ++k) {
      key = (key ^ static_cast<std::uint64_t>(cell[k])) * 0x9e3779b97f4a7c15ull;
      key ^= key >> 29;
    }
    return key;
  }
  std::set<int> levels_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

/// Welded vertices at edges that one face alone uses.
std::vector<std::uint32_t> borderVertices(const TriangleMesh& mesh) {
  std::vector<glm::uvec3> faces(mesh.triangleCount());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    faces[i / 3][static_cast<int>(i % 3)] = mesh.weldedVertex[mesh.indices[i]];
  std::vector<std::uint32_t> vertices;
  forEachEdge(edgeUses(faces), [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 1) vertices.insert(vertices.end(), {edge[0].low(), edge[0].high()});
  });
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

bool same(const SceneCaster& a, const SceneCaster& b) {
  return a.geometry == b.geometry && a.revision == b.revision && a.worldFromObject == b.worldFromObject;
}

std::uint64_t combined(std::uint64_t seed, std::uint64_t value) {
  seed = (seed ^ value) * 0x9e3779b97f4a7c15ull;
  return seed ^ seed >> 32;
}
}  // namespace

struct CasterGroups::Border {
  SceneCaster caster;
  std::vector<PlacedVertex> vertices;
};

struct CasterGroups::Group {
  std::vector<SceneCaster> members;
  TriangleMesh mesh;
  HalfEdgeMesh halfEdges;
  glm::dmat4 worldFromGroup{1.0};
  std::uint64_t revision = 1;

  explicit Group(std::vector<SceneCaster> casters) : members(std::move(casters)) {
    for (const SceneCaster& member : members) revision = combined(revision, member.revision);
    revision |= 1;  // 0 would be "not known"
    placeFrame();
    VertexGrid grid;
    for (const SceneCaster& member : members) append(member, grid);
    halfEdges = HalfEdgeMesh::build(mesh);
  }

 private:
  /// That of the members if they share one; else axes of the world about the middle of all.
  void placeFrame() {
    const auto shared = [&](const SceneCaster& m) { return m.worldFromObject == members[0].worldFromObject; };
    worldFromGroup = members[0].worldFromObject;
    if (std::ranges::all_of(members, shared)) return;
    Bounds bounds;
    for (const SceneCaster& member : members)
      bounds.include(transformed(member.worldFromObject, boundsOf(member.triangles())));
    worldFromGroup = glm::dmat4(1.0);
    worldFromGroup[3] = glm::dvec4(bounds.center(), 1.0);
  }

  void append(const SceneCaster& member, VertexGrid& grid) {
    const bool moved = member.worldFromObject != worldFromGroup;
    const bool turned = moved && glm::determinant(glm::dmat3(member.worldFromObject)) < 0.0;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const TriangleMesh& source = member.triangles();
    for (std::uint32_t v = 0; v < source.positions.size(); ++v) {
      const PlacedVertex vertex = placedVertex(member, v);
      mesh.positions.push_back(moved ? glm::vec3(vertex.world - glm::dvec3(worldFromGroup[3]))
                                     : source.positions[v]);
      mesh.weldedVertex.push_back(first + source.weldedVertex[v]);
      if (source.weldedVertex[v] != v) {
        mesh.weldedVertex.back() = mesh.weldedVertex[first + source.weldedVertex[v]];
        continue;
      }
      // With those of other members only: a mesh may be finer than its place is known.
      std::uint32_t found = ~0u;
      grid.forEachAt(vertex, [&](std::uint32_t id) { found = std::min(found, id); });
      if (found != ~0u) mesh.weldedVertex.back() = mesh.weldedVertex[found];
    }
    for (std::uint32_t v = 0; v < source.positions.size(); ++v) {
      if (source.weldedVertex[v] == v) grid.add(placedVertex(member, v), first + v);
    }
    for (std::size_t t = 0; t + 2 < source.indices.size(); t += 3) {
      std::uint32_t corner[3];
      for (std::size_t k = 0; k < 3; ++k) corner[k] = first + source.indices[t + (turned ? 2 - k : k)];
      const std::uint32_t a = mesh.weldedVertex[corner[0]], b = mesh.weldedVertex[corner[1]],
                          c = mesh.weldedVertex[corner[2]];
      if (a == b || b == c || c == a) continue;
      mesh.indices.insert(mesh.indices.end(), corner, corner + 3);
    }
  }
};

CasterGroups::CasterGroups() = default;
CasterGroups::~CasterGroups() = default;
CasterGroups::CasterGroups(CasterGroups&&) noexcept = default;
CasterGroups& CasterGroups::operator=(CasterGroups&&) noexcept = default;

std::vector<std::vector<std::uint32_t>> CasterGroups::findGroups(std::span<const SceneCaster> casters) {
  std::vector<Border> borders;
  std::vector<std::uint32_t> casterOfBorder, borderOfVertex;
  std::vector<const PlacedVertex*> vertices;
  for (std::uint32_t i = 0; i < casters.size(); ++i) {
    const SceneCaster& caster = casters[i];
    if (caster.triangles().statistics.closed()) continue;
    const auto kept =
        std::ranges::find_if(borders_, [&](const Border& border) { return same(border.caster, caster); });
    if (kept != borders_.end()) {
      borders.push_back(std::move(*kept));
      kept->caster.geometry = nullptr;
    } else {
      borders.push_back({.caster = caster, .vertices = {}});
      for (const std::uint32_t v : borderVertices(caster.triangles()))
        borders.back().vertices.push_back(placedVertex(caster, v));
    }
    casterOfBorder.push_back(i);
  }
  borders_ = std::move(borders);

  VertexGrid grid;
  for (std::uint32_t b = 0; b < borders_.size(); ++b) {
    for (const PlacedVertex& vertex : borders_[b].vertices) {
      grid.add(vertex, static_cast<std::uint32_t>(vertices.size()));
      vertices.push_back(&vertex);
      borderOfVertex.push_back(b);
    }
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> common;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const std::uint32_t own = borderOfVertex[v];
    std::set<std::uint32_t> met;
    grid.forEachAt(*vertices[v], [&](std::uint32_t other) {
      if (borderOfVertex[other] != own) met.insert(borderOfVertex[other]);
    });
    for (const std::uint32_t other : met) ++common[{own, other}];
  }
  DisjointSets sets(casters.size());
  for (const auto& [pair, count] : common) {
    if (count >= kCommonVertices) sets.merge(casterOfBorder[pair.first], casterOfBorder[pair.second]);
  }
  std::vector<std::uint32_t> numberOf;
  std::vector<std::vector<std::uint32_t>> groups(sets.number(numberOf));
  for (std::uint32_t i = 0; i < casters.size(); ++i) groups[numberOf[i]].push_back(i);
  return groups;
}

void CasterGroups::update(std::span<const SceneCaster> casters, std::uint64_t key) {
  weldedCount_ = 0;
  key_ = key;
  if (!placed_.empty() && std::ranges::equal(casters, casters_, same)) return;
  casters_.assign(casters.begin(), casters.end());
  placed_.clear();
  placedOf_.assign(casters.size(), 0);
  std::vector<std::unique_ptr<Group>> groups;
  for (const std::vector<std::uint32_t>& members : findGroups(casters)) {
    PlacedCaster placed{.object = static_cast<std::uint32_t>(placed_.size())};
    for (const std::uint32_t i : members) placedOf_[i] = placed.object;
    const SceneCaster& first = casters[members.front()];
    if (members.size() == 1) {
      placed.mesh = &first.geometry->halfEdges(*first.mesh);
      placed.worldFromObject = first.worldFromObject;
      placed.revision = first.revision;
      placed_.push_back(placed);
      continue;
    }
    std::vector<SceneCaster> together;
    for (const std::uint32_t i : members) together.push_back(casters[i]);
    const auto kept = std::ranges::find_if(groups_, [&](const std::unique_ptr<Group>& group) {
      return group && std::ranges::equal(group->members, together, same);
    });
    if (kept != groups_.end()) {
      groups.push_back(std::move(*kept));
    } else {
      groups.push_back(std::make_unique<Group>(std::move(together)));
      ++weldedCount_;
    }
    placed.mesh = &groups.back()->halfEdges;
    placed.worldFromObject = groups.back()->worldFromGroup;
    placed.revision = groups.back()->revision;
    placed_.push_back(placed);
  }
  groups_ = std::move(groups);
}

}  // namespace halfshadow::scene
