// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/near_loops.hpp"

#include <algorithm>
#include <array>

namespace halfshadow::outlines {
namespace {
/// Radii of a patch from its middle from which on it is listed whole.
constexpr double kFarPatch = 1.25;

/// Closed loops from directed edges between points.
class Chain {
 public:
  Chain(std::size_t points, NearLoopScratch& scratch)
      : first_(scratch.firstLink), links_(scratch.links), starts_(scratch.starts) {
    if (first_.size() < points) first_.resize(points, -1);
  }
  void add(std::uint32_t from, std::uint32_t to) {
    if (first_[from] < 0) starts_.push_back(from);
    links_.push_back({to, first_[from]});
    first_[from] = static_cast<std::int32_t>(links_.size()) - 1;
  }
  /// Appends all loops of three edges and more, and forgets the edges. As many enter a point as leave it, so
  /// that a walk ends where it began.
  void take(const std::vector<glm::vec3>& points, NearLoops::Loops& loops) {
    for (const std::uint32_t start : starts_) {
      while (first_[start] >= 0) {
        const std::size_t before = loops.points.size();
        std::uint32_t at = start;
        do {
          loops.points.push_back(points[at]);
          const NearLoopScratch::Link& taken = links_[static_cast<std::size_t>(first_[at])];
          first_[at] = taken.next;
          at = taken.to;
        } while (at != start);
        if (loops.points.size() < before + 3) {
          loops.points.resize(before);
        } else {
          loops.ends.push_back(loops.points.size());
        }
      }
    }
    starts_.clear();
    links_.clear();
  }

 private:
  std::vector<std::int32_t>& first_;  ///< by point; all -1 between uses
  std::vector<NearLoopScratch::Link>& links_;
  std::vector<std::uint32_t>& starts_;
};

/// Corners of a facet alone, as a chain of its edges has them.
constexpr std::array<std::size_t, 3> kOutward{0, 1, 2}, kTurned{1, 0, 2};

/// How a facet enters the lists.
enum Role : std::uint8_t { kAbsent, kJoined, kJoinedTurned, kAmong, kAmongTurned, kOneSided };

Role roleOf(const NearSurface& surface, std::uint32_t f, const SubLight& light, const ReceiverSet& receivers,
            FacetChoice choice) {
  const NearSurface::Facet& facet = surface.facets[f];
  // Of a light that lies on both sides of a facet some points see it from behind, where it is what rays enter
  // by.
  const bool byReceivers =
      choice == FacetChoice::asReceiversSee || (surface.closed && lightSideOf(facet, light) == 0);
  const int side = byReceivers ? sideOfReceivers(surface, f, receivers) : sees(facet, light) ? -1 : 1;
  if (side == 0) return kOneSided;
  const bool among = !surface.convex && facet.low.z < receivers.box.iHigh;
  return side < 0 ? (among ? kAmong : kJoined) : (among ? kAmongTurned : kJoinedTurned);
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

void nearLoops(const NearSurface& surface, std::span<const std::uint32_t> facets, const SubLight& light,
               const ReceiverSet& receivers, FacetChoice choice, NearLoopScratch& scratch,
               NearLoops& result) {
  result.joined.clear();
  result.among.clear();
  result.oneSided.clear();
  std::vector<std::uint8_t>& roles = scratch.roles;
  if (roles.size() < surface.facets.size()) roles.resize(surface.facets.size(), kAbsent);
  for (const std::uint32_t f : facets) roles[f] = roleOf(surface, f, light, receivers, choice);
  Chain chain(surface.points.size(), scratch);
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
    // A facet alone has the same loop either way.
    const bool whole = end - k > 1 && isFar(surface.patches[patch], receivers);
    const auto takePatch = [&](Role role, Way way, NearLoops::Loops& loops) {
      for (std::size_t m = k; m < end; ++m) {
        if (roles[facets[m]] != role) continue;
        if (whole) {
          link(facets[m], way, [&](std::uint32_t f) { return surface.facets[f].patch == patch; });
          continue;
        }
        const std::array<std::uint32_t, 3>& v = surface.facets[facets[m]].vertex;
        for (const std::size_t corner : way == Way::outward ? kOutward : kTurned)
          loops.points.push_back(surface.points[v[corner]]);
        loops.ends.push_back(loops.points.size());
      }
      if (whole) chain.take(surface.points, loops);
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
