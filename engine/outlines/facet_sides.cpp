// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/facet_sides.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::outlines {
namespace {
/// Share of the lift within which rounding may put a fragment on either side of a plane.
constexpr double kUnsure = 0.25;

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
}  // namespace

int lightSideOf(const NearSurface::Facet& facet, const SubLight& light) {
  return sideOf(facet.plane, light);
}

bool sees(const NearSurface::Facet& facet, const SubLight& light) {
  return facet.plane.w + facet.plane.x * light.center.x + facet.plane.y * light.center.y > 0.0;
}

int sideOfReceivers(const NearSurface& surface, std::uint32_t f, const ReceiverSet& receivers) {
  const NearSurface::Facet& facet = surface.facets[f];
  if (receivers.patches.empty()) return sideOf(facet.plane, receivers.box);
  std::vector<SideMemory::Side>& sides = receivers.memory.of[surface.number].sides;
  if (sides.size() < surface.facets.size()) sides.resize(surface.facets.size());
  SideMemory::Side& known = sides[f];
  if (known.tile != receivers.memory.tile) known = {receivers.memory.tile, sideOf(surface, facet, receivers)};
  return known.side;
}

void facetsInReach(const NearSurface& surface, const TangentBox& receivers,
                   std::vector<std::uint32_t>& result, std::size_t most) {
  result.clear();
  const OuterSides outer(kWholeLight, receivers);
  const auto inReach = [&](const auto& what) { return isInReach(what.low, what.high, outer, receivers); };
  if (!inReach(surface)) return;
  for (const NearSurface::Patch& patch : surface.patches) {
    if (!inReach(patch)) continue;
    for (std::uint32_t f = patch.firstFacet; f < patch.firstFacet + patch.facetCount; ++f) {
      if (inReach(surface.facets[f])) result.push_back(f);
    }
    if (result.size() > most) return;
  }
}

std::vector<FacetLight> facetLights(const NearSurface& surface, const SubLight& light) {
  std::vector<FacetLight> lights;
  lights.reserve(surface.facets.size());
  for (const NearSurface::Facet& facet : surface.facets)
    lights.push_back({static_cast<std::int8_t>(sideOf(facet.plane, light)), sees(facet, light)});
  return lights;
}

void facetsThatMatter(const NearSurface& surface, std::span<const std::uint32_t> candidates, SheetSide side,
                      const SubLight& light, std::span<const FacetLight> lights, const ReceiverSet& receivers,
                      const OuterSides& sides, FacetChoice choice, std::vector<std::uint32_t>& result) {
  result.clear();
  const bool lightBefore =
      choice == FacetChoice::asReceiversSee && !receivers.patches.empty() && lightIsBefore(receivers, light);
  const bool towardsOnly =
      side == SheetSide::towards || (surface.closed && choice == FacetChoice::asLightSees);
  for (const std::uint32_t f : candidates) {
    const FacetLight& seen = lights[f];
    const bool byReceivers = surface.closed && (choice == FacetChoice::asReceiversSee || seen.side == 0);
    if (seen.sees ? side == SheetSide::away : towardsOnly && !byReceivers) continue;
    const NearSurface::Facet& facet = surface.facets[f];
    if (!isInReach(facet.low, facet.high, sides, receivers.box)) continue;
    const auto& v = facet.vertex;
    if ((sides.code(surface.points[v[0]]) & sides.code(surface.points[v[1]]) &
         sides.code(surface.points[v[2]])) != 0)
      continue;
    if (lightBefore && behindAll(surface, facet, receivers)) continue;
    const int receiverSide = sideOfReceivers(surface, f, receivers);
    if (receiverSide == kOwnFacet) continue;
    // No ray passes a plane that has both its ends on one side.
    if (seen.side * receiverSide > 0) continue;
    if (byReceivers && receiverSide > 0) continue;
    result.push_back(f);
  }
}

Interior interiorOf(const NearSurface& surface, const TangentBox& receivers, SideMemory& memory) {
  if (!surface.closed || !surface.convex || surface.cut || surface.facets.empty()) return Interior::outside;
  std::uint32_t& separator = memory.of[surface.number].separator;
  if (sideOf(surface.facets[separator].plane, receivers) > 0) return Interior::outside;
  bool inside = true;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    const int side = sideOf(surface.facets[f].plane, receivers);
    if (side > 0) {
      separator = f;
      return Interior::outside;
    }
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

}  // namespace halfshadow::outlines
