// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a caster covers for receivers among its own surfaces. There its silhouette does not tell: the part of
/// it that is nearer to the light than a receiver ends in a contour across its faces, which no chord between
/// silhouette vertices replaces unless it is convex. Near such receivers the faces themselves are listed, and
/// only those in front of all of them are summed up in their boundary.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "outlines/facet_tree.hpp"
#include "outlines/receiver_tiles.hpp"
#include "outlines/tangent_space.hpp"
#include "scene/light_silhouettes.hpp"

namespace halfshadow::outlines {

inline constexpr std::uint32_t kNoFacet = ~0u;
/// In place of a side: all receivers lie in the facet's plane and may be seen from both sides.
inline constexpr int kOwnFacet = 2;

/// The faces of one part of a caster in (t, i). Where the light is on a facet's outer side its vertices run
/// counter-clockwise around what it covers for receivers on the inner side.
struct NearSurface {
  struct Facet {
    std::array<std::uint32_t, 3> vertex{};  ///< in `points`
    std::array<std::uint32_t, 3> beyond{};  ///< the facet across the edge from vertex k, or kNoFacet
    /// Signed distance from its plane, outward positive, times the reciprocal height of a point (t, i):
    /// dot(plane, (t.x, t.y, 1, i)), world units.
    glm::dvec4 plane{0.0};
    glm::vec3 low{0.0f}, high{0.0f};  ///< bounds in (t, i)
    std::uint32_t patch = 0;          ///< facets of one patch follow each other and are about even
  };
  /// Neighbouring facets that are about even.
  struct Patch {
    std::uint32_t firstFacet = 0, facetCount = 0;
    glm::vec3 low{1e30f}, high{-1e30f};  ///< bounds in (t, i)
    glm::dvec3 centerWorld{0.0};         ///< relative to the light's centre
    double radius = 0.0;                 ///< world units
  };
  std::vector<glm::vec3> points;
  std::vector<Patch> patches;
  std::vector<glm::dvec3> pointsWorld;  ///< the same, relative to the light's centre
  std::vector<Facet> facets;
  glm::vec3 low{1e30f}, high{-1e30f};  ///< bounds of all, in (t, i)
  std::size_t number = 0;              ///< among those that one NearSurfaces made or will make
  /// Working memory: on which side of each facet the receivers of a tile lie, asked for by each sub-light.
  struct Side {
    std::uint64_t tile = 0;
    int side = 0;  ///< 1 all outside, -1 all inside, 0 some on either, kOwnFacet
  };
  mutable std::vector<Side> sides;
  /// Working memory: a facet that some receivers were all outside of. Their neighbours mostly are, too.
  mutable std::uint32_t separator = 0;
  bool closed = true;   ///< else a sheet, whose facets cover from both sides
  bool convex = false;  ///< and closed, or even: cut at any height the boundary of its facets tells all
  bool whole = false;   ///< the caster has no other part
  bool cut = false;     ///< it reaches through the light's plane
  /// So near to the light, compared with its farthest point, that one unit of (t, i) for all of its points
  /// would be coarse for most: fragments walk no trees of it.
  bool spread = false;
};

/// What a closed part stands for.
enum class Solid {
  within,  ///< the solid that it bounds
  faces,   ///< the same, never told by its outline, also where it is convex
  around   ///< with the light inside: the solid around a room, whose faces look into it
};

/// What reaches through the plane h = minHeight is cut there.
NearSurface nearSurface(const scene::PlacedCaster& caster, std::uint32_t part, const ListSpace& space,
                        double minHeight, Solid solid = Solid::within);

/// Surfaces of one light's casters, each made when first asked for.
class NearSurfaces {
 public:
  NearSurfaces() = default;
  NearSurfaces(std::span<const scene::PlacedCaster> casters, const ListSpace& space, double minHeight);
  /// `object`: index of the caster. The reference lasts as long as this object.
  const NearSurface& of(std::uint32_t object, std::uint32_t part, Solid solid = Solid::within);
  /// Of a surface that of() gave; made when first asked for. The reference lasts as long as this object.
  const FacetTrees& treesOf(const NearSurface& surface);
  const ListSpace& space() const { return space_; }
  std::size_t count() const { return made_.size(); }  ///< NearSurface::number is less
  /// For ReceiverSet::tile.
  std::uint64_t nextTile() { return ++tile_; }

 private:
  std::vector<scene::PlacedCaster> casters_;
  ListSpace space_;
  double minHeight_ = 0.0;
  std::uint64_t tile_ = 0;
  static constexpr std::size_t kSolids = 3;
  std::vector<std::size_t> firstPart_;              ///< of each caster, among the parts of all
  std::vector<std::unique_ptr<NearSurface>> made_;  ///< by part and Solid; asked for in each tile
  std::map<const NearSurface*, FacetTrees> trees_;
};

}  // namespace halfshadow::outlines
