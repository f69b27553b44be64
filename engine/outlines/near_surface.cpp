// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/near_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "outlines/caster_loops.hpp"

namespace halfshadow::outlines {
namespace {
/// Share of the lift within which rounding may put a fragment on either side of a plane.
constexpr double kUnsure = 0.25;
/// Clusters whose normals lie within 18 degrees of their mean count as even: a chord across one is its
/// contour to a twentieth of its size.
constexpr float kEven = 0.95f;
/// Radii of a patch from its middle from which on it is listed whole.
constexpr double kFarPatch = 1.25;

/// In place of a point: the vertex lies below the least height.
constexpr std::uint32_t kBelow = kNoFacet - 1;

int judge(double value, double reach) {
  return value > reach ? 1 : value < -reach ? -1 : 0;
}

/// Where a part of the light lies of a facet's plane: 1 all on its outer side, -1 all on the inner, 0 some on
/// either. At the light's point (x, y, 0) the plane is that of the tangent (x, y) at i = 0, all but its
/// scale.
int sideOf(const glm::dvec4& plane, const SubLight& light) {
  return judge(plane.w + plane.x * light.center.x + plane.y * light.center.y,
               light.half * (std::abs(plane.x) + std::abs(plane.y)));
}

/// Whether its centre is on the outer side.
bool sees(const glm::dvec4& plane, const SubLight& light) {
  return plane.w + plane.x * light.center.x + plane.y * light.center.y > 0.0;
}

int sideOf(const glm::dvec4& plane, const TangentBox& box) {
  const glm::dvec3 reach(0.5 * glm::dvec2(box.tHigh - box.tLow), 0.5 * (box.iHigh - box.iLow));
  const glm::dvec3 linear(plane.x, plane.y, plane.w);
  return judge(glm::dot(linear, glm::dvec3(box.center())) + plane.z, glm::dot(glm::abs(linear), reach));
}

glm::dvec3 linearOf(const glm::dvec4& plane) {
  return {plane.x, plane.y, plane.w};
}
double valueAt(const glm::dvec4& plane, const glm::dvec3& ti) {
  return glm::dot(linearOf(plane), ti) + plane.z;
}

/// Whether the facet lies in the patch's plane, to what single precision tells.
bool isCoplanar(const NearSurface& surface, const NearSurface::Facet& facet, const ReceiverPatch& patch) {
  const glm::dvec3 linear = glm::abs(linearOf(patch.plane));
  const double patchRounding = glm::dot(linear, glm::abs(patch.lift));
  return std::ranges::all_of(facet.vertex, [&](std::uint32_t v) {
    const glm::dvec3 point(surface.points[v]);
    const double rounding = patchRounding + kPlaceRounding * glm::dot(linear, glm::abs(point));
    return std::abs(valueAt(patch.plane, point)) <= kUnsure * rounding;
  });
}

/// The same for lifted fragments of patches, one by one.
int sideOf(const NearSurface& surface, const NearSurface::Facet& facet, const ReceiverSet& receivers) {
  const glm::dvec4& plane = facet.plane;
  const glm::dvec3 linear = linearOf(plane);
  int side = kOwnFacet;
  for (const ReceiverPatch& patch : receivers.patches) {
    const double lifted = glm::dot(linear, patch.lift);
    const double unsure = kUnsure * glm::dot(glm::abs(linear), glm::abs(patch.lift));
    const double least = patch.eitherSide ? -std::abs(lifted) - unsure : lifted - unsure;
    const double most = patch.eitherSide ? std::abs(lifted) + unsure : lifted + unsure;
    const auto vote = [&](int here) {
      const bool agrees = here != 0 && (side == kOwnFacet || side == here);
      side = agrees ? here : 0;
      return agrees;
    };
    if (isCoplanar(surface, facet, patch)) {
      if (!patch.eitherSide && !vote(lifted > 0.0 ? 1 : -1)) return 0;
      continue;
    }
    for (int corner = 0; corner < 4; ++corner) {
      const glm::dvec2 t(corner & 1 ? patch.high.x : patch.low.x, corner & 2 ? patch.high.y : patch.low.y);
      const double i = std::clamp(patch.base + glm::dot(patch.gradient, t), patch.iLow, patch.iHigh);
      const double value = valueAt(plane, {t, i});
      if (!vote(value + least > 0.0 ? 1 : value + most < 0.0 ? -1 : 0)) return 0;
    }
  }
  return side;
}

int sideOfReceivers(const NearSurface& surface, std::uint32_t f, const ReceiverSet& receivers) {
  const NearSurface::Facet& facet = surface.facets[f];
  if (receivers.patches.empty()) return sideOf(facet.plane, receivers.box);
  if (surface.sides.size() < surface.facets.size()) surface.sides.resize(surface.facets.size());
  NearSurface::Side& known = surface.sides[f];
  if (known.tile != receivers.tile) known = {receivers.tile, sideOf(surface, facet, receivers)};
  return known.side;
}

/// Whether all of the light's part lies in front of every patch: then what is behind all of them hides
/// nothing of it from any.
bool lightIsBefore(const ReceiverSet& receivers, const SubLight& light) {
  return std::ranges::all_of(receivers.patches, [&](const ReceiverPatch& patch) {
    return !patch.eitherSide && sideOf(patch.plane, light) > 0;
  });
}

bool behindAll(const NearSurface& surface, const NearSurface::Facet& facet, const ReceiverSet& receivers) {
  return std::ranges::all_of(receivers.patches, [&](const ReceiverPatch& patch) {
    const glm::dvec3 linear = glm::abs(linearOf(patch.plane));
    const double highest = (1.0 - kUnsure) * glm::dot(linear, glm::abs(patch.lift));
    return std::ranges::all_of(facet.vertex, [&](std::uint32_t v) {
      return valueAt(patch.plane, glm::dvec3(surface.points[v])) < highest;
    });
  });
}

/// Closed loops from directed edges between points.
class Chain {
 public:
  explicit Chain(std::size_t points) {
    if (first_.size() < points) first_.resize(points, -1);
  }
  void add(std::uint32_t from, std::uint32_t to) {
    if (first_[from] < 0) starts_.push_back(from);
    links_.push_back({to, first_[from]});
    first_[from] = static_cast<std::int32_t>(links_.size()) - 1;
  }
  /// Appends all loops of three edges and more, and forgets the edges. As many enter a point as leave it, so
  /// that a walk ends where it began.
  void take(const std::vector<glm::vec3>& points, std::vector<std::vector<glm::vec3>>& loops) {
    for (const std::uint32_t start : starts_) {
      while (first_[start] >= 0) {
        std::vector<glm::vec3>& loop = loops.emplace_back();
        std::uint32_t at = start;
        do {
          loop.push_back(points[at]);
          const Link& taken = links_[static_cast<std::size_t>(first_[at])];
          first_[at] = taken.next;
          at = taken.to;
        } while (at != start);
        if (loop.size() < 3) loops.pop_back();
      }
    }
    starts_.clear();
    links_.clear();
  }

 private:
  struct Link {
    std::uint32_t to = 0;
    std::int32_t next = -1;
  };
  // All -1 between uses.
  static thread_local std::vector<std::int32_t> first_;
  std::vector<Link> links_;
  std::vector<std::uint32_t> starts_;
};
thread_local std::vector<std::int32_t> Chain::first_;

/// How a facet enters the lists.
enum Role : std::uint8_t { kAbsent, kJoined, kJoinedTurned, kAmong, kAmongTurned, kOneSided };

Role roleOf(const NearSurface& surface, std::uint32_t f, const SubLight& light, const ReceiverSet& receivers,
            FacetChoice choice) {
  const NearSurface::Facet& facet = surface.facets[f];
  const int side = choice == FacetChoice::asReceiversSee ? sideOfReceivers(surface, f, receivers)
                   : sees(facet.plane, light)            ? -1
                                                         : 1;
  if (side == 0) return kOneSided;
  const bool among = !surface.convex && facet.low.z < receivers.box.iHigh;
  return side < 0 ? (among ? kAmong : kJoined) : (among ? kAmongTurned : kJoinedTurned);
}
void measurePatches(NearSurface& surface) {
  std::vector<scene::Bounds> bounds(surface.patches.size());
  for (const NearSurface::Facet& facet : surface.facets) {
    for (const std::uint32_t v : facet.vertex) bounds[facet.patch].include(surface.pointsWorld[v]);
  }
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    surface.patches[k].centerWorld = bounds[k].center();
    surface.patches[k].radius = bounds[k].radius();
  }
}

/// A chord stands for a patch's contour where no receiver is near enough to tell them apart.
bool isFar(const NearSurface::Patch& patch, const ReceiverSet& receivers) {
  const auto toWorld = [&](const glm::dvec3& ti) {
    const scene::LightPlane& plane = receivers.space.plane;
    return plane.toWorld(receivers.space.lightPoint(ti)) - plane.centerWorld;
  };
  const TangentBox& box = receivers.box;
  const glm::dvec3 middle = toWorld(glm::dvec3(box.center()));
  const double reach = glm::length(toWorld(glm::dvec3(box.tHigh, box.iLow)) - middle);
  return glm::length(patch.centerWorld - middle) > reach + kFarPatch * patch.radius;
}
}  // namespace

NearSurface nearSurface(const scene::PlacedCaster& caster, std::uint32_t part, const ListSpace& space,
                        double minHeight, Solid solid) {
  const scene::LightPlane& plane = space.plane;
  const scene::HalfEdgeMesh& mesh = *caster.mesh;
  const scene::CasterPart& own = mesh.parts()[part];
  const glm::dmat3 linear(caster.worldFromObject);
  const glm::dmat3 lightFromObject = plane.axes * linear;
  const glm::dvec3 offset = plane.fromWorld(glm::dvec3(caster.worldFromObject[3]));
  // Faces that look towards the light run clockwise in (a, b), unless the object is mirrored.
  const bool turned = (glm::determinant(linear) > 0.0) == (solid != Solid::around);

  NearSurface surface{.closed = own.closed,
                      .convex = own.convex && solid == Solid::within,
                      .whole = mesh.parts().size() == 1};
  std::vector<glm::dvec3> abh(mesh.positions().size());
  std::vector<std::uint32_t> pointOf(mesh.positions().size(), kNoFacet);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cutOf;  // of edges, by their vertices
  const auto addPoint = [&](const glm::dvec3& p) {
    surface.points.emplace_back(space.tangentPoint(p));
    surface.pointsWorld.push_back(plane.toWorld(p) - plane.centerWorld);
    return static_cast<std::uint32_t>(surface.points.size() - 1);
  };
  const auto isAbove = [&](std::uint32_t v) { return abh[v].z >= minHeight; };
  const auto cutPoint = [&](std::uint32_t v, std::uint32_t w) {
    const auto [found, isNew] = cutOf.try_emplace(std::minmax(v, w));
    const glm::dvec3 &from = abh[found->first.first], &to = abh[found->first.second];
    if (isNew) found->second = addPoint(glm::mix(from, to, (minHeight - from.z) / (to.z - from.z)));
    return found->second;
  };
  // What reaches through the plane h = minHeight is cut: of such a face one or two facets are left.
  std::vector<std::uint32_t> firstFacet(own.faceCount + 1, 0), corners;
  surface.facets.reserve(own.faceCount);
  for (std::uint32_t face = 0; face < own.faceCount; ++face) {
    const glm::uvec3& vertices = mesh.faces()[own.firstFace + face];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = vertices[k];
      if (pointOf[v] != kNoFacet) continue;
      abh[v] = lightFromObject * glm::dvec3(mesh.positions()[v]) + offset;
      pointOf[v] = isAbove(v) ? addPoint(abh[v]) : kBelow;
      surface.cut |= !isAbove(v);
    }
    corners.clear();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = vertices[turned ? 2 - k : k], w = vertices[turned ? (4 - k) % 3 : (k + 1) % 3];
      if (isAbove(v)) corners.push_back(pointOf[v]);
      if (isAbove(v) != isAbove(w)) corners.push_back(cutPoint(v, w));
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      NearSurface::Facet facet{.vertex = {corners[0], corners[k - 1], corners[k]},
                               .beyond = {kNoFacet, kNoFacet, kNoFacet},
                               .low = glm::vec3(1e30f),
                               .high = glm::vec3(-1e30f)};
      for (const std::uint32_t v : facet.vertex) {
        facet.low = glm::min(facet.low, surface.points[v]);
        facet.high = glm::max(facet.high, surface.points[v]);
      }
      const auto at = [&](std::size_t c) { return surface.pointsWorld[facet.vertex[c]]; };
      // Outward: the vertices run counter-clockwise in (a, b), which is clockwise for the light that looks at
      // them.
      const glm::dvec3 cross = glm::cross(at(2) - at(0), at(1) - at(0));
      facet.plane = space.planeThrough(cross / std::max(glm::length(cross), 1e-300), at(0));
      // The two halves of a cut face meet along its diagonal.
      const auto number = static_cast<std::uint32_t>(surface.facets.size());
      if (k == 3) facet.beyond[0] = number - 1, surface.facets.back().beyond[2] = number;
      surface.facets.push_back(facet);
    }
    firstFacet[face + 1] = static_cast<std::uint32_t>(surface.facets.size());
  }
  for (const scene::FaceCluster& cluster : mesh.clusters().subspan(own.firstCluster, own.clusterCount)) {
    const std::uint32_t first = cluster.firstFace - own.firstFace;
    const std::uint32_t end = firstFacet[first + cluster.faceCount];
    for (std::uint32_t f = firstFacet[first]; f < end; ++f) {
      if (f == firstFacet[first] || cluster.cosAngle < kEven) surface.patches.push_back({.firstFacet = f});
      NearSurface::Patch& patch = surface.patches.back();
      ++patch.facetCount;
      patch.low = glm::min(patch.low, surface.facets[f].low);
      patch.high = glm::max(patch.high, surface.facets[f].high);
      surface.facets[f].patch = static_cast<std::uint32_t>(surface.patches.size()) - 1;
    }
  }
  measurePatches(surface);
  /// The facet of a face that has this edge, and the edge's place there.
  const auto facetWith = [&](std::uint32_t face, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t f = firstFacet[face]; f < firstFacet[face + 1]; ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = surface.facets[f].vertex[k], q = surface.facets[f].vertex[(k + 1) % 3];
        if ((p == from && q == to) || (p == to && q == from)) return std::pair(f, k);
      }
    }
    return std::pair(kNoFacet, std::size_t{0});
  };
  for (const scene::EdgeRecord& edge : mesh.edges().subspan(own.firstEdge, own.edgeCount)) {
    if (edge.opposite == scene::kNoFace || (!isAbove(edge.from) && !isAbove(edge.to))) continue;
    const std::uint32_t from = isAbove(edge.from) ? pointOf[edge.from] : cutPoint(edge.from, edge.to);
    const std::uint32_t to = isAbove(edge.to) ? pointOf[edge.to] : cutPoint(edge.from, edge.to);
    const auto [a, placeA] = facetWith(edge.face - own.firstFace, from, to);
    const auto [b, placeB] = facetWith(edge.opposite - own.firstFace, from, to);
    if (a == kNoFacet || b == kNoFacet) continue;
    surface.facets[a].beyond[placeA] = b;
    surface.facets[b].beyond[placeB] = a;
  }
  return surface;
}

NearSurfaces::NearSurfaces(std::span<const scene::PlacedCaster> casters, const ListSpace& space,
                           double minHeight)
    : casters_(casters.begin(), casters.end()), space_(space), minHeight_(minHeight) {
  std::size_t parts = 0;
  for (const scene::PlacedCaster& caster : casters_) {
    firstPart_.push_back(parts);
    parts += caster.mesh->parts().size();
  }
  made_.resize(kSolids * parts);
}

const NearSurface& NearSurfaces::of(std::uint32_t object, std::uint32_t part, Solid solid) {
  std::unique_ptr<NearSurface>& made =
      made_[kSolids * (firstPart_[object] + part) + static_cast<std::size_t>(solid)];
  if (!made)
    made = std::make_unique<NearSurface>(nearSurface(casters_[object], part, space_, minHeight_, solid));
  return *made;
}

const FacetTrees& NearSurfaces::treesOf(const NearSurface& surface) {
  const auto [found, isNew] = trees_.try_emplace(&surface);
  if (isNew) found->second = facetTrees(surface);
  return found->second;
}

int lightSideOf(const NearSurface::Facet& facet, const SubLight& light) {
  return sideOf(facet.plane, light);
}

std::vector<std::uint32_t> facetsOfSide(const NearSurface& surface, std::span<const std::uint32_t> facets,
                                        const SubLight& light, bool turnedAway) {
  std::vector<std::uint32_t> side;
  std::ranges::copy_if(facets, std::back_inserter(side),
                       [&](std::uint32_t f) { return sees(surface.facets[f].plane, light) != turnedAway; });
  return side;
}

void facetsInReach(const NearSurface& surface, const TangentBox& receivers,
                   std::vector<std::uint32_t>& result, std::size_t most) {
  result.clear();
  const OuterSides outer(kWholeLight, receivers);
  const auto inReach = [&](const auto& what) {
    return what.high.z > receivers.iLow && outer.code(what.low, what.high) == 0;
  };
  for (const NearSurface::Patch& patch : surface.patches) {
    if (!inReach(patch)) continue;
    for (std::uint32_t f = patch.firstFacet; f < patch.firstFacet + patch.facetCount; ++f) {
      if (inReach(surface.facets[f])) result.push_back(f);
    }
    if (result.size() > most) return;
  }
}

void facetsThatMatter(const NearSurface& surface, std::span<const std::uint32_t> candidates,
                      const SubLight& light, const ReceiverSet& receivers, FacetChoice choice,
                      std::vector<std::uint32_t>& result) {
  result.clear();
  const OuterSides outer(light, receivers.box);
  const bool lightBefore =
      choice == FacetChoice::asReceiversSee && !receivers.patches.empty() && lightIsBefore(receivers, light);
  for (const std::uint32_t f : candidates) {
    const NearSurface::Facet& facet = surface.facets[f];
    if (facet.high.z <= receivers.box.iLow || outer.code(facet.low, facet.high) != 0) continue;
    const auto& v = facet.vertex;
    if ((outer.code(surface.points[v[0]]) & outer.code(surface.points[v[1]]) &
         outer.code(surface.points[v[2]])) != 0)
      continue;
    const int lightSide = sideOf(facet.plane, light);
    if (surface.closed && choice == FacetChoice::asLightSees && !sees(facet.plane, light)) continue;
    if (lightBefore && behindAll(surface, facet, receivers)) continue;
    const int receiverSide = sideOfReceivers(surface, f, receivers);
    if (receiverSide == kOwnFacet) continue;
    // No ray passes a plane that has both its ends on one side.
    if (lightSide * receiverSide > 0) continue;
    if (surface.closed && choice == FacetChoice::asReceiversSee && receiverSide > 0) continue;
    result.push_back(f);
  }
}

Interior interiorOf(const NearSurface& surface, const TangentBox& receivers) {
  if (!surface.closed || !surface.convex || surface.cut || surface.facets.empty()) return Interior::outside;
  bool inside = true;
  for (const NearSurface::Facet& facet : surface.facets) {
    const int side = sideOf(facet.plane, receivers);
    if (side > 0) return Interior::outside;
    inside &= side < 0;
  }
  return inside ? Interior::inside : Interior::unknown;
}

bool hidesFromInside(const NearSurface& surface, const SubLight& light) {
  return std::ranges::any_of(surface.facets,
                             [&](const NearSurface::Facet& facet) { return sideOf(facet.plane, light) > 0; });
}

OwnHorizon ownHorizon(const NearSurface& surface, const SubLight& light, const ReceiverSet& receivers) {
  if (!surface.closed || !surface.convex || !surface.whole || receivers.patches.empty())
    return OwnHorizon::unknown;
  bool before = true, behind = true;
  for (const ReceiverPatch& patch : receivers.patches) {
    const int side = sideOf(patch.plane, light);
    // Seen from within, a convex surface hides everything.
    if (patch.eitherSide || patch.turned) return OwnHorizon::unknown;
    before &= side > 0;
    behind &= side < 0;
  }
  return before ? OwnHorizon::before : behind ? OwnHorizon::behind : OwnHorizon::across;
}

void nearLoops(const NearSurface& surface, std::span<const std::uint32_t> facets, const SubLight& light,
               const ReceiverSet& receivers, FacetChoice choice, NearLoops& result) {
  result.joined.clear();
  result.among.clear();
  result.oneSided.clear();
  thread_local std::vector<std::uint8_t> roles;
  // All absent between uses.
  if (roles.size() < surface.facets.size()) roles.resize(surface.facets.size(), kAbsent);
  for (const std::uint32_t f : facets) roles[f] = roleOf(surface, f, light, receivers, choice);
  Chain chain(surface.points.size());
  enum class Way { outward, turned };
  /// The edges of facet f where no facet of the same kind goes on.
  const auto link = [&](std::uint32_t f, Way way, auto goesOn) {
    const NearSurface::Facet& facet = surface.facets[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t beyond = facet.beyond[k];
      if (beyond != kNoFacet && roles[beyond] == roles[f] && goesOn(beyond)) continue;
      std::uint32_t from = facet.vertex[k], to = facet.vertex[(k + 1) % 3];
      if (way == Way::turned) std::swap(from, to);
      chain.add(from, to);
    }
  };
  for (const std::uint32_t f : facets) {
    if (roles[f] == kJoined) link(f, Way::outward, [](std::uint32_t) { return true; });
    if (roles[f] == kJoinedTurned) link(f, Way::turned, [](std::uint32_t) { return true; });
  }
  chain.take(surface.points, result.joined);
  for (std::size_t k = 0; k < facets.size();) {
    const std::uint32_t patch = surface.facets[facets[k]].patch;
    std::size_t end = k;
    while (end < facets.size() && surface.facets[facets[end]].patch == patch) ++end;
    const bool whole = isFar(surface.patches[patch], receivers);
    const auto takePatch = [&](Role role, Way way, std::vector<std::vector<glm::vec3>>& loops) {
      for (std::size_t m = k; m < end; ++m) {
        if (roles[facets[m]] != role) continue;
        link(facets[m], way, [&](std::uint32_t f) { return whole && surface.facets[f].patch == patch; });
        if (!whole) chain.take(surface.points, loops);
      }
      chain.take(surface.points, loops);
    };
    takePatch(kAmong, Way::outward, result.among);
    takePatch(kAmongTurned, Way::turned, result.among);
    takePatch(kOneSided, Way::outward, result.oneSided);
    if (!surface.closed) takePatch(kOneSided, Way::turned, result.oneSided);
    k = end;
  }
  for (const std::uint32_t f : facets) roles[f] = kAbsent;
}

}  // namespace halfshadow::outlines
