// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/near_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace halfshadow::outlines {
namespace {
/// Clusters whose normals lie within 18 degrees of their mean count as even: a chord across one is its
/// contour to a twentieth of its size.
constexpr float kEven = 0.95f;
/// Height of the farthest point over that of the nearest, from which on a surface is spread: trees count
/// places in 1/32000 of its reach, of which the far half, as wide as a sixteenth of it, still has 2000.
constexpr float kSpread = 16.0f;
/// In place of a point: the vertex lies below the least height.
constexpr std::uint32_t kBelow = kNoFacet - 1;

/// Makes the surface of one part.
class SurfaceMaker {
 public:
  SurfaceMaker(const scene::PlacedCaster& caster, std::uint32_t part, const ListSpace& space,
               double minHeight, Solid solid)
      : mesh_(*caster.mesh),
        own_(mesh_.parts()[part]),
        space_(space),
        minHeight_(minHeight),
        lightFromObject_(space.plane.axes * glm::dmat3(caster.worldFromObject)),
        offset_(space.plane.fromWorld(glm::dvec3(caster.worldFromObject[3]))),
        // Faces that look towards the light run clockwise in (a, b), unless the object is mirrored.
        turned_((glm::determinant(glm::dmat3(caster.worldFromObject)) > 0.0) == (solid != Solid::around)),
        abh_(mesh_.positions().size()),
        pointOf_(mesh_.positions().size(), kNoFacet),
        firstFacet_(own_.faceCount + 1, 0) {
    surface_.closed = own_.closed;
    surface_.convex = own_.convex && solid == Solid::within;
    surface_.whole = mesh_.parts().size() == 1;
  }

  NearSurface make() {
    surface_.facets.reserve(own_.faceCount);
    for (std::uint32_t face = 0; face < own_.faceCount; ++face) {
      addFace(mesh_.faces()[own_.firstFace + face]);
      firstFacet_[face + 1] = static_cast<std::uint32_t>(surface_.facets.size());
    }
    addPatches();
    measurePatches();
    linkFacets();
    const auto [far, near] = std::ranges::minmax_element(surface_.points, {}, &glm::vec3::z);
    surface_.spread =
        far != surface_.points.end() && near->z + space_.originI > kSpread * (far->z + space_.originI);
    return std::move(surface_);
  }

 private:
  bool isAbove(std::uint32_t v) const { return abh_[v].z >= minHeight_; }

  std::uint32_t addPoint(const glm::dvec3& p) {
    surface_.points.emplace_back(space_.tangentPoint(p));
    surface_.pointsWorld.push_back(space_.plane.toWorld(p) - space_.plane.centerWorld);
    return static_cast<std::uint32_t>(surface_.points.size() - 1);
  }

  std::uint32_t cutPoint(std::uint32_t v, std::uint32_t w) {
    const auto [found, isNew] = cutOf_.try_emplace(std::minmax(v, w));
    const glm::dvec3 &from = abh_[found->first.first], &to = abh_[found->first.second];
    if (isNew) found->second = addPoint(glm::mix(from, to, (minHeight_ - from.z) / (to.z - from.z)));
    return found->second;
  }

  /// What reaches through the plane h = minHeight is cut: of such a face one or two facets are left.
  void addFace(const glm::uvec3& vertices) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = vertices[k];
      if (pointOf_[v] != kNoFacet) continue;
      abh_[v] = lightFromObject_ * glm::dvec3(mesh_.positions()[v]) + offset_;
      pointOf_[v] = isAbove(v) ? addPoint(abh_[v]) : kBelow;
      surface_.cut |= !isAbove(v);
    }
    corners_.clear();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = vertices[turned_ ? 2 - k : k],
                          w = vertices[turned_ ? (4 - k) % 3 : (k + 1) % 3];
      if (isAbove(v)) corners_.push_back(pointOf_[v]);
      if (isAbove(v) != isAbove(w)) corners_.push_back(cutPoint(v, w));
    }
    for (std::size_t k = 2; k < corners_.size(); ++k) {
      addFacet({corners_[0], corners_[k - 1], corners_[k]});
      // The two halves of a cut face meet along its diagonal.
      const auto last = static_cast<std::uint32_t>(surface_.facets.size() - 1);
      if (k == 3) surface_.facets[last].beyond[0] = last - 1, surface_.facets[last - 1].beyond[2] = last;
    }
  }

  void addFacet(const std::array<std::uint32_t, 3>& vertex) {
    NearSurface::Facet facet{.vertex = vertex,
                             .beyond = {kNoFacet, kNoFacet, kNoFacet},
                             .low = glm::vec3(1e30f),
                             .high = glm::vec3(-1e30f)};
    for (const std::uint32_t v : vertex) {
      facet.low = glm::min(facet.low, surface_.points[v]);
      facet.high = glm::max(facet.high, surface_.points[v]);
    }
    const auto at = [&](std::size_t c) { return surface_.pointsWorld[vertex[c]]; };
    // Outward: the vertices run counter-clockwise in (a, b), which is clockwise for the light that looks at
    // them.
    const glm::dvec3 cross = glm::cross(at(2) - at(0), at(1) - at(0));
    facet.plane = space_.planeThrough(cross / std::max(glm::length(cross), 1e-300), at(0));
    surface_.facets.push_back(facet);
    surface_.low = glm::min(surface_.low, facet.low);
    surface_.high = glm::max(surface_.high, facet.high);
  }

  void addPatches() {
    for (const scene::FaceCluster& cluster : mesh_.clusters().subspan(own_.firstCluster, own_.clusterCount)) {
      const std::uint32_t first = firstFacet_[cluster.firstFace - own_.firstFace];
      const std::uint32_t end = firstFacet_[cluster.firstFace - own_.firstFace + cluster.faceCount];
      for (std::uint32_t f = first; f < end; ++f) {
        if (f == first || cluster.cosAngle < kEven) surface_.patches.push_back({.firstFacet = f});
        NearSurface::Patch& patch = surface_.patches.back();
        ++patch.facetCount;
        patch.low = glm::min(patch.low, surface_.facets[f].low);
        patch.high = glm::max(patch.high, surface_.facets[f].high);
        surface_.facets[f].patch = static_cast<std::uint32_t>(surface_.patches.size()) - 1;
      }
    }
  }

  void measurePatches() {
    std::vector<scene::Bounds> bounds(surface_.patches.size());
    for (const NearSurface::Facet& facet : surface_.facets) {
      for (const std::uint32_t v : facet.vertex) bounds[facet.patch].include(surface_.pointsWorld[v]);
    }
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      surface_.patches[k].centerWorld = bounds[k].center();
      surface_.patches[k].radius = bounds[k].radius();
    }
  }

  /// The facet of a face that has this edge, and the edge's place there.
  std::pair<std::uint32_t, std::size_t> facetWith(std::uint32_t face, std::uint32_t from,
                                                  std::uint32_t to) const {
    for (std::uint32_t f = firstFacet_[face]; f < firstFacet_[face + 1]; ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = surface_.facets[f].vertex[k], q = surface_.facets[f].vertex[(k + 1) % 3];
        if ((p == from && q == to) || (p == to && q == from)) return {f, k};
      }
    }
    return {kNoFacet, 0};
  }

  void linkFacets() {
    for (const scene::EdgeRecord& edge : mesh_.edges().subspan(own_.firstEdge, own_.edgeCount)) {
      if (edge.opposite == scene::kNoFace || (!isAbove(edge.from) && !isAbove(edge.to))) continue;
      const std::uint32_t from = isAbove(edge.from) ? pointOf_[edge.from] : cutPoint(edge.from, edge.to);
      const std::uint32_t to = isAbove(edge.to) ? pointOf_[edge.to] : cutPoint(edge.from, edge.to);
      const auto [a, placeA] = facetWith(edge.face - own_.firstFace, from, to);
      const auto [b, placeB] = facetWith(edge.opposite - own_.firstFace, from, to);
      if (a == kNoFacet || b == kNoFacet) continue;
      surface_.facets[a].beyond[placeA] = b;
      surface_.facets[b].beyond[placeB] = a;
    }
  }

  const scene::HalfEdgeMesh& mesh_;
  const scene::CasterPart& own_;
  const ListSpace& space_;
  double minHeight_;
  glm::dmat3 lightFromObject_;
  glm::dvec3 offset_;
  bool turned_;
  NearSurface surface_;
  std::vector<glm::dvec3> abh_;         ///< by the mesh's vertices
  std::vector<std::uint32_t> pointOf_;  ///< the same; kNoFacet: not yet, or kBelow
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cutOf_;  ///< of edges, by their vertices
  std::vector<std::uint32_t> firstFacet_;                                   ///< of each face
  std::vector<std::uint32_t> corners_;
};
}  // namespace

NearSurface nearSurface(const scene::PlacedCaster& caster, std::uint32_t part, const ListSpace& space,
                        double minHeight, Solid solid) {
  return SurfaceMaker(caster, part, space, minHeight, solid).make();
}

NearSurfaces::NearSurfaces(std::span<const scene::PlacedCaster> casters, const ListSpace& space,
                           double minHeight)
    : casters_(casters.begin(), casters.end()), space_(space), minHeight_(minHeight) {
  std::size_t parts = 0;
  for (const scene::PlacedCaster& caster : casters_) {
    firstPart_.push_back(parts);
    parts += caster.mesh->parts().size();
  }
  count_ = kSolids * parts;
  slots_ = std::make_unique<Slot[]>(count_);
}

const NearSurface& NearSurfaces::of(std::uint32_t object, std::uint32_t part, Solid solid) {
  const std::size_t number = kSolids * (firstPart_[object] + part) + static_cast<std::size_t>(solid);
  return slots_[number].surface.get([&] {
    NearSurface made = nearSurface(casters_[object], part, space_, minHeight_, solid);
    made.number = number;
    return made;
  });
}

const FacetTrees& NearSurfaces::treesOf(const NearSurface& surface) {
  return slots_[surface.number].trees.get([&] { return facetTrees(surface); });
}

}  // namespace halfshadow::outlines
