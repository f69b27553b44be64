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
  /// Working memory: on which side of each facet the receivers of a tile lie, asked for by each sub-light.
  struct Side {
    std::uint64_t tile = 0;
    int side = 0;  ///< 1 all outside, -1 all inside, 0 some on either, kOwnFacet
  };
  mutable std::vector<Side> sides;
  bool closed = true;   ///< else a sheet, whose facets cover from both sides
  bool convex = false;  ///< and closed, or even: cut at any height the boundary of its facets tells all
  bool whole = false;   ///< the caster has no other part
  bool cut = false;     ///< it reaches through the light's plane
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

/// Which facets stand for the caster. Of a closed surface every ray from a receiver to the light leaves as
/// often as it enters: those through which rays leave cover everything once.
enum class FacetChoice {
  asLightSees,     ///< those that look at the sub-light's centre, as its silhouettes have it
  asReceiversSee,  ///< those that receivers are behind of: exact for every point of the light
};

/// Receivers that share a list.
struct ReceiverSet {
  const TangentBox& box;
  const ListSpace& space;
  /// Their facets where they are few and known exactly; else empty.
  std::span<const ReceiverPatch> patches;
  std::uint64_t tile = 0;  ///< a number of its own for each set with patches
};

/// Where a part of the light lies of a facet's plane: 1 all on its outer side, -1 all on the inner, 0 some on
/// either.
int lightSideOf(const NearSurface::Facet& facet, const SubLight& light);

/// Those of a sheet's facets that look towards the light's centre, or those that look away.
std::vector<std::uint32_t> facetsOfSide(const NearSurface& surface, std::span<const std::uint32_t> facets,
                                        const SubLight& light, bool turnedAway);

/// Facets that can cover some of the light for some receiver in the box, or more; stops when there are more
/// than `most`. Replaces `result`.
void facetsInReach(const NearSurface& surface, const TangentBox& receivers,
                   std::vector<std::uint32_t>& result, std::size_t most = ~std::size_t{0});

/// Of `candidates` (facets), those that can cover some of the light's part for some of the receivers.
/// Replaces `result`.
void facetsThatMatter(const NearSurface& surface, std::span<const std::uint32_t> candidates,
                      const SubLight& light, const ReceiverSet& receivers, FacetChoice choice,
                      std::vector<std::uint32_t>& result);

/// Where receivers stand of a closed convex surface; `outside` also of one that is not, or was cut.
enum class Interior { inside, outside, unknown };
Interior interiorOf(const NearSurface& surface, const TangentBox& receivers);
/// Whether all of the light's part lies outside of it.
bool hidesFromInside(const NearSurface& surface, const SubLight& light);

/// What a convex surface hides of a part of the light from receivers on it: what lies behind their own facet.
enum class OwnHorizon {
  unknown,  ///< it is not convex, or not all of its caster
  before,   ///< nothing: the light is before all of them
  behind,   ///< all of it
  across    ///< it is neither for all of them
};
OwnHorizon ownHorizon(const NearSurface& surface, const SubLight& light, const ReceiverSet& receivers);

/// Loops of `facets`: first around those that stand before all receivers (and, of a convex caster, those
/// among them), joined; then around each of the others; then around each of those that cover only for
/// receivers on their inner side, of which there are some on either: a fragment counts them where what they
/// cover is positive.
struct NearLoops {
  std::vector<std::vector<glm::vec3>> joined, among, oneSided;
};
void nearLoops(const NearSurface& surface, std::span<const std::uint32_t> facets, const SubLight& light,
               const ReceiverSet& receivers, FacetChoice choice, NearLoops& result);

}  // namespace halfshadow::outlines
