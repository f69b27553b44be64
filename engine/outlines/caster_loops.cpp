// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/caster_loops.hpp"

#include <algorithm>
#include <cmath>

#include "outlines/caster_clusters.hpp"

namespace halfshadow::outlines {
namespace {
/// Beyond this share of the receivers' range of reciprocal heights, and of their rounding, a vertex is
/// farther than every receiver.
constexpr float kFarMargin = 1e-3f, kFarRounding = 1e-5f;

/// Cuts a closed loop at i = iLow, dropping what is farther from the light.
void cutFar(std::span<const glm::vec3> loop, float iLow, std::vector<glm::vec3>& out) {
  out.clear();
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const glm::vec3 &a = loop[k], &b = loop[k + 1 == loop.size() ? 0 : k + 1];
    const bool aIn = a.z >= iLow, bIn = b.z >= iLow;
    if (aIn) out.push_back(a);
    if (aIn != bIn) out.push_back(glm::mix(a, b, (iLow - a.z) / (b.z - a.z)));
  }
}

/// Vertices of a loop that lie outside by more than kFarOutside times the receivers' size and what the light
/// spreads over at their height are cut off, kOutside sizes beyond the side: stored with few bits, they would
/// move the edges that lead to them.
constexpr float kFarOutside = 16.0f, kOutside = 4.0f;

bool isPlanar(std::span<const glm::vec3> loop) {
  const glm::dvec3 origin(loop[0]);
  glm::dvec3 normal(0.0), size(0.0);
  for (std::size_t k = 2; k < loop.size(); ++k) {
    const glm::dvec3 a = glm::dvec3(loop[k - 1]) - origin, b = glm::dvec3(loop[k]) - origin;
    normal += glm::cross(a, b);
    size = glm::max(size, glm::max(glm::abs(a), glm::abs(b)));
  }
  const double reach = kPlaceRounding * glm::dot(glm::abs(normal), size + glm::abs(origin));
  return std::ranges::all_of(
      loop, [&](const glm::vec3& p) { return std::abs(glm::dot(normal, glm::dvec3(p) - origin)) <= reach; });
}

/// One side of the light for a set of receivers: what is outside by more than `margin` has negative `inside`.
struct FarSide {
  glm::dvec3 inward{0.0};
  double bound = 0.0;
  double inside(const glm::vec3& p) const { return glm::dot(inward, glm::dvec3(p)) + bound; }
};

/// Replaces the parts of `loop` outside `side` by chords along it. Of loops that are not planar only where
/// both ends of the chord are before all receivers (see collapseRuns()).
void cutSide(std::vector<glm::vec3>& loop, const FarSide& side, bool planar, float iHigh,
             std::vector<glm::vec3>& out) {
  const std::size_t count = loop.size();
  std::size_t start = 0;
  while (start < count && side.inside(loop[start]) < 0.0) ++start;
  if (start == count) return;
  const auto at = [&](std::size_t k) -> const glm::vec3& { return loop[(start + k) % count]; };
  const auto crossing = [&](const glm::vec3& a, const glm::vec3& b) {
    const double from = side.inside(a), to = side.inside(b);
    return glm::vec3(glm::mix(glm::dvec3(a), glm::dvec3(b), from / (from - to)));
  };
  out.clear();
  for (std::size_t k = 0; k < count;) {
    out.push_back(at(k));
    if (side.inside(at(++k)) >= 0.0) continue;
    std::size_t end = k;
    while (side.inside(at(end)) < 0.0) ++end;
    const glm::vec3 leaves = crossing(at(k - 1), at(k)), returns = crossing(at(end - 1), at(end));
    if (planar || std::min(leaves.z, returns.z) >= iHigh) {
      out.push_back(leaves);
      out.push_back(returns);
    } else {
      for (; k < end; ++k) out.push_back(at(k));
    }
    k = end;
  }
  loop.swap(out);
}

void cutFarOutside(std::vector<glm::vec3>& loop, const SubLight& light, const TangentBox& box,
                   std::vector<glm::vec3>& scratch) {
  const glm::vec2 extent = box.tHigh - box.tLow;
  const float size = std::max({extent.x, extent.y, box.iHigh - box.iLow});
  const glm::vec2 low = light.center - light.half, high = light.center + light.half;
  const auto isFar = [&](const glm::vec3& p) {
    const float above = p.z - box.iLow, reach = kFarOutside * (size + std::abs(above));
    const glm::vec2 beyond =
        glm::max(glm::vec2(p) - box.tHigh - above * high, box.tLow + above * low - glm::vec2(p));
    return std::max(beyond.x, beyond.y) > reach;
  };
  if (std::ranges::none_of(loop, isFar)) return;
  const bool planar = isPlanar(loop);
  const double margin = kOutside * size;
  for (int axis = 0; axis < 2 && loop.size() >= 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      // sign (t - X i) <= the largest of it over the box, and the margin.
      const double edge = sign > 0.0 ? high[axis] : low[axis];
      const double t = sign > 0.0 ? box.tHigh[axis] : -box.tLow[axis];
      const double i = sign * edge > 0.0 ? box.iLow : box.iHigh;
      FarSide side{.inward = {0.0, 0.0, sign * edge}, .bound = t - sign * edge * i + margin};
      side.inward[axis] = -sign;
      cutSide(loop, side, planar, box.iHigh, scratch);
    }
  }
}

using Judged = SimplifyScratch::Judged;

/// Drops what lies between two vertices of a run beyond one side. Both must be before every receiver: then,
/// for each receiver, the dropped path and the edge that replaces it lie in one convex region that holds no
/// part of the light, with the same ends, wherever the receiver's height cuts the path between. True when
/// some edge may cover part of the light for some receiver.
bool collapseRuns(const std::vector<Judged>& loop, std::vector<Judged>& out) {
  constexpr std::size_t kNone = ~std::size_t{0};
  out.clear();
  const std::size_t count = loop.size();
  // Starting inside, where no run passes, no run is split.
  std::size_t start = 0;
  while (start < count && (loop[start].code != 0 || !loop[start].sure)) ++start;
  start = start == count ? 0 : start;
  out.push_back(loop[start]);
  std::size_t anchor =
      loop[start].sure && loop[start].code != 0 ? 0 : kNone;  // in `out`: where the run began
  unsigned run = loop[start].code;
  for (std::size_t k = 1; k <= count; ++k) {
    const Judged& v = loop[(start + k) % count];
    if (anchor != kNone && (run & v.code) != 0) {
      run &= v.code;
      if (v.sure) out.resize(anchor + 1);
      out.push_back(v);
      continue;
    }
    // The run may go on from the last vertex alone, beyond another side.
    if (out.back().sure && (out.back().code & v.code) != 0) {
      anchor = out.size() - 1;
      run = out.back().code & v.code;
    } else {
      anchor = v.sure && v.code != 0 ? out.size() : kNone;
      run = v.code;
    }
    out.push_back(v);
  }
  // The walk ended where it began: the first vertex is there twice.
  out.pop_back();
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Judged& next = out[k + 1 == out.size() ? 0 : k + 1];
    if (!out[k].sure || (out[k].code & next.code) == 0) return true;
  }
  return false;
}

/// Winding number of a loop that never crosses the sub-light, around the sub-light's centre.
int windingNumber(const std::vector<glm::vec3>& loop, const SubLight& light, const glm::vec3& receiver) {
  const glm::dvec2 origin(glm::vec2(receiver) + light.center * -receiver.z);
  double angle = 0.0;
  const auto at = [&](const glm::vec3& v) {
    const glm::dvec2 q(glm::dvec2(v.x - light.center.x * double(v.z), v.y - light.center.y * double(v.z)) -
                       origin);
    return q;
  };
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const glm::dvec2 a = at(loop[k]), b = at(loop[k + 1 == loop.size() ? 0 : k + 1]);
    angle += std::atan2(a.x * b.y - b.x * a.y, glm::dot(a, b));
  }
  return static_cast<int>(std::lround(angle / (2.0 * 3.14159265358979323846)));
}

float farEnd(const TangentBox& receivers) {
  return receivers.iLow - kFarMargin * (receivers.iHigh - receivers.iLow) -
         kFarRounding * std::max(std::abs(receivers.iLow), std::abs(receivers.iHigh));
}

enum class LoopKind { whole, oneSided };

/// Collects the loops of one caster, simplified for the receivers.
class Simplifier {
 public:
  Simplifier(const SubLight& light, const TangentBox& receivers, SimplifyScratch& scratch,
             CasterLoops& result)
      : light_(light), receivers_(receivers), sides_(light, receivers), scratch_(scratch), result_(result) {}

  void add(std::span<const glm::vec3> loop, LoopKind kind = LoopKind::whole) {
    std::vector<glm::vec3>&cut = scratch_.cut, &kept = scratch_.kept;
    std::vector<Judged>&judged = scratch_.judged, &collapsed = scratch_.collapsed;
    cutFar(loop, farEnd(receivers_), cut);
    if (cut.size() < 3) return;
    cutFarOutside(cut, light_, receivers_, kept);
    judged.clear();
    unsigned common = ~0u;
    for (const glm::vec3& v : cut) {
      judged.push_back({v, sides_.code(v), v.z >= receivers_.iHigh});
      common &= judged.back().code;
    }
    // What is left of it lies beyond one side, wherever receivers cut it.
    if (common != 0) return;
    const bool oneSided = kind == LoopKind::oneSided;
    const bool crosses = collapseRuns(judged, collapsed) || oneSided;
    if (collapsed.size() < 3) return;
    kept.clear();
    for (const Judged& v : collapsed) kept.push_back(v.ti);
    const int winding = crosses ? 0 : windingNumber(cut, light_, receivers_.center());
    if (!crosses && winding == 0) return;
    result_.addLoop(kept);
    result_.loops.back().oneSided = oneSided;
    partial_ = partial_ || crosses;
    constant_ += winding;
  }

  /// Of all loops so far; anything but `partial` empties the result.
  Coverage coverage() {
    if (partial_) return Coverage::partial;
    if (constant_ == 0) result_.clear();
    return constant_ > 0 ? Coverage::full : Coverage::none;
  }

 private:
  const SubLight& light_;
  const TangentBox& receivers_;
  OuterSides sides_;
  SimplifyScratch& scratch_;
  CasterLoops& result_;
  int constant_ = 0;
  bool partial_ = false;
};
}  // namespace

void CasterLoops::clear() {
  points.clear();
  loops.clear();
  low = glm::vec3(1e30f);
  high = glm::vec3(-1e30f);
  partLow = glm::vec3(-1e30f);
  partHigh = glm::vec3(1e30f);
  enclosesLight = isRoom = seenInside = false;
  deepest = 0.0f;
  firstLayer = layerCount = 0;
  layersBefore = false;
  object = part = 0;
  turnedAway = false;
  convex = true;
}

void CasterLoops::addLoop(std::span<const glm::vec3> loop) {
  loops.push_back({static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(loop.size())});
  points.insert(points.end(), loop.begin(), loop.end());
  for (const glm::vec3& p : loop) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
}

namespace {
/// Of single precision, and of what the loops' points were rounded to.
constexpr double kBoundsRounding = 1e-6;

/// The default where it is not wholly before the light's plane.
void boundPart(const scene::Bounds& partWorld, const ListSpace& space, CasterLoops& caster) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& corner : partWorld.corners()) {
    const glm::dvec3 abh = space.plane.fromWorld(corner);
    if (abh.z <= kBoundsRounding) return;
    const glm::dvec3 ti = space.tangentPoint(abh);
    low = glm::min(low, ti);
    high = glm::max(high, ti);
  }
  const glm::dvec3 rounding = kBoundsRounding * glm::max(glm::abs(low), glm::abs(high));
  caster.partLow = glm::vec3(low - rounding);
  caster.partHigh = glm::vec3(high + rounding);
}

/// Entries that share layers are near receivers, or behind none of them, together.
void boundTogether(std::span<CasterLoops> casters) {
  for (std::size_t first = 0, end = 0; first < casters.size(); first = end) {
    for (end = first + 1; end < casters.size() && casters[end].layersBefore;) ++end;
    const std::span<CasterLoops> entries = casters.subspan(first, end - first);
    CasterLoops& all = entries.front();
    for (const CasterLoops& entry : entries) {
      all.low = glm::min(all.low, entry.low);
      all.high = glm::max(all.high, entry.high);
      all.deepest = std::min(all.deepest, entry.deepest);
    }
    for (CasterLoops& entry : entries)
      entry.low = all.low, entry.high = all.high, entry.deepest = all.deepest;
  }
}
}  // namespace

const CasterCluster::Stage* CasterCluster::stageFor(float receiversHighestI) const {
  const Stage* last = nullptr;
  for (const Stage& stage : stages) {
    if (stage.behindI >= receiversHighestI) last = &stage;
  }
  return last;
}

SubLightLoops loopsOf(const scene::LightSilhouettes& silhouettes,
                      std::span<const scene::PlacedCaster> casters, const SubLight& light,
                      const ListSpace& space, std::span<const RoomPart> seenInside) {
  SubLightLoops result{.light = light};
  std::vector<glm::vec3> loop;
  std::uint32_t layersLeft = 0;
  for (const scene::LightSilhouettes::Caster& source : silhouettes.casters) {
    const bool isLayer = layersLeft > 0;
    layersLeft = isLayer ? layersLeft - 1 : source.layerCount;
    CasterLoops& caster = (isLayer ? result.layers : result.casters).emplace_back();
    caster.firstLayer = static_cast<std::uint32_t>(result.layers.size());
    caster.layerCount = source.layerCount;
    caster.layersBefore = source.layersBefore;
    caster.enclosesLight = source.enclosesLight;
    for (std::uint32_t l = source.firstLoop; l < source.firstLoop + source.loopCount; ++l) {
      loop.clear();
      for (std::uint32_t k = 0; k < silhouettes.loops[l].count; ++k) {
        loop.emplace_back(space.tangentPoint(silhouettes.points[silhouettes.loops[l].first + k]));
      }
      caster.addLoop(loop);
    }
    boundPart(source.partWorld, space, caster);
    caster.deepest = static_cast<float>(1.0 / static_cast<double>(source.deepest) - space.originI);
    caster.object = source.object;
    caster.part = source.part;
    caster.turnedAway = source.turnedAway;
    caster.convex = casters[source.object].mesh->parts()[source.part].convex;
    if (std::ranges::find(seenInside, RoomPart{source.object, source.part}) != seenInside.end()) {
      caster.isRoom = source.enclosesLight;
      caster.seenInside = !source.enclosesLight;
      caster.convex = caster.convex && !caster.isRoom;
      caster.enclosesLight = false;
    }
  }
  boundTogether(result.casters);
  result.clusters = casterClusters(silhouettes, result, space);
  return result;
}

OuterSides::OuterSides(const SubLight& light, const TangentBox& box)
    : left_(light.center.x - light.half),
      right_(light.center.x + light.half),
      lower_(light.center.y - light.half),
      upper_(light.center.y + light.half) {
  // Largest and smallest t - X i over the box.
  const auto largest = [&](float t, float side) { return t - side * (side > 0.0f ? box.iLow : box.iHigh); };
  const auto smallest = [&](float t, float side) { return t - side * (side > 0.0f ? box.iHigh : box.iLow); };
  rightBound_ = largest(box.tHigh.x, right_);
  leftBound_ = smallest(box.tLow.x, left_);
  upperBound_ = largest(box.tHigh.y, upper_);
  lowerBound_ = smallest(box.tLow.y, lower_);
}

unsigned OuterSides::code(const glm::vec3& low, const glm::vec3& high) const {
  const auto smallest = [&](float t, float side) { return t - side * (side > 0.0f ? high.z : low.z); };
  const auto largest = [&](float t, float side) { return t - side * (side > 0.0f ? low.z : high.z); };
  return (smallest(low.x, right_) > rightBound_ ? 1u : 0u) | (largest(high.x, left_) < leftBound_ ? 2u : 0u) |
         (smallest(low.y, upper_) > upperBound_ ? 4u : 0u) |
         (largest(high.y, lower_) < lowerBound_ ? 8u : 0u);
}

Coverage simplify(const CasterLoops& caster, const SubLight& light, const TangentBox& receivers,
                  SimplifyScratch& scratch, CasterLoops& result) {
  result.clear();
  if (caster.enclosesLight) return Coverage::full;
  if (caster.high.z <= farEnd(receivers)) return Coverage::none;
  if (OuterSides(light, receivers).code(caster.low, caster.high) != 0) return Coverage::none;
  Simplifier simplifier(light, receivers, scratch, result);
  for (const CasterLoops::Loop& loop : caster.loops) {
    simplifier.add({caster.points.data() + loop.first, loop.count});
  }
  return simplifier.coverage();
}

Coverage simplify(const NearSurface& surface, std::span<const std::uint32_t> facets, const SubLight& light,
                  const ReceiverSet& receivers, FacetChoice choice, SimplifyScratch& scratch,
                  CasterLoops& result) {
  result.clear();
  NearLoops& loops = scratch.loops;
  facetsThatMatter(surface, facets, light, receivers, choice, scratch.mattering);
  nearLoops(surface, scratch.mattering, light, receivers, choice, scratch.near, loops);
  Simplifier simplifier(light, receivers.box, scratch, result);
  for (const std::vector<glm::vec3>& loop : loops.joined) simplifier.add(loop);
  // What stands before all receivers may cover all of the light.
  if (simplifier.coverage() == Coverage::full) return Coverage::full;
  for (const std::vector<glm::vec3>& loop : loops.among) simplifier.add(loop);
  for (const std::vector<glm::vec3>& loop : loops.oneSided) simplifier.add(loop, LoopKind::oneSided);
  return simplifier.coverage();
}

}  // namespace halfshadow::outlines
