// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "outlines/caster_loops.hpp"

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

/// Receivers as vertices are judged by: which are far outside of a sub-light.
class FarOutside {
 public:
  FarOutside(const SubLight& light, const TangentBox& box)
      : box_(box), low_(light.center - light.half), high_(light.center + light.half) {
    const glm::vec2 extent = box.tHigh - box.tLow;
    size_ = std::max({extent.x, extent.y, box.iHigh - box.iLow});
  }

  /// Such a vertex lies beyond a side for all receivers: OuterSides::code() is not 0.
  bool has(const glm::vec3& p) const {
    const float above = p.z - box_.iLow, reach = kFarOutside * (size_ + std::abs(above));
    const glm::vec2 beyond =
        glm::max(glm::vec2(p) - box_.tHigh - above * high_, box_.tLow + above * low_ - glm::vec2(p));
    return std::max(beyond.x, beyond.y) > reach;
  }

  /// Of a loop with such vertices.
  void cut(std::vector<glm::vec3>& loop, std::vector<glm::vec3>& scratch) const {
    const bool planar = isPlanar(loop);
    const double margin = kOutside * size_;
    for (int axis = 0; axis < 2 && loop.size() >= 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        // sign (t - X i) <= the largest of it over the box, and the margin.
        const double edge = sign > 0.0 ? high_[axis] : low_[axis];
        const double t = sign > 0.0 ? box_.tHigh[axis] : -box_.tLow[axis];
        const double i = sign * edge > 0.0 ? box_.iLow : box_.iHigh;
        FarSide side{.inward = {0.0, 0.0, sign * edge}, .bound = t - sign * edge * i + margin};
        side.inward[axis] = -sign;
        cutSide(loop, side, planar, box_.iHigh, scratch);
      }
    }
  }

 private:
  const TangentBox& box_;
  glm::vec2 low_, high_;
  float size_ = 0.0f;
};

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
  for (std::size_t k = 1, at = start; k <= count; ++k) {
    at = at + 1 == count ? 0 : at + 1;
    const Judged& v = loop[at];
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

/// Winding number of a loop that never crosses the sub-light, around the sub-light's centre: how often it
/// crosses the ray to the right of it upwards, less how often downwards.
int windingNumber(std::span<const glm::vec3> loop, const SubLight& light, const glm::vec3& receiver) {
  const glm::dvec2 origin(glm::vec2(receiver) + light.center * -receiver.z);
  const auto at = [&](const glm::vec3& v) {
    return glm::dvec2(v.x - light.center.x * double(v.z), v.y - light.center.y * double(v.z)) - origin;
  };
  int turns = 0;
  glm::dvec2 a = at(loop.back());
  for (const glm::vec3& v : loop) {
    const glm::dvec2 b = at(v);
    const bool upwards = b.y >= 0.0;
    if ((a.y >= 0.0) != upwards && (a.x * b.y - b.x * a.y > 0.0) == upwards) turns += upwards ? 1 : -1;
    a = b;
  }
  return turns;
}

float farEnd(const TangentBox& receivers) {
  return receivers.iLow - kFarMargin * (receivers.iHigh - receivers.iLow) -
         kFarRounding * std::max(std::abs(receivers.iLow), std::abs(receivers.iHigh));
}

enum class LoopKind { whole, oneSided };

/// Collects the loops of one caster, simplified for the receivers.
class Simplifier {
 public:
  /// `sides`: of the light and the receivers.
  Simplifier(const SubLight& light, const TangentBox& receivers, const OuterSides& sides,
             SimplifyScratch& scratch, CasterLoops& result)
      : light_(light),
        receivers_(receivers),
        sides_(sides),
        farOutside_(light, receivers),
        farEnd_(farEnd(receivers)),
        scratch_(scratch),
        result_(result) {}

  void add(std::span<const glm::vec3> loop, LoopKind kind = LoopKind::whole) {
    // Most loops of a block lie beyond one side for most of its tiles, wherever they are cut.
    if (!judge(loop)) return;
    std::vector<glm::vec3>& cut = scratch_.cut;
    if (reachesFar_) {
      cutFar(loop, farEnd_, cut);
      loop = cut;
      if (cut.size() < 3 || !judge(loop)) return;
    }
    if (reachesOut_) {
      if (loop.data() != cut.data()) cut.assign(loop.begin(), loop.end());
      farOutside_.cut(cut, scratch_.kept);
      loop = cut;
      if (!judge(loop)) return;
    }
    if (loop.size() < 3) return;
    std::vector<Judged>& collapsed = scratch_.collapsed;
    const bool oneSided = kind == LoopKind::oneSided;
    const bool crosses = collapseRuns(scratch_.judged, collapsed) || oneSided;
    if (collapsed.size() < 3) return;
    const int winding = crosses ? 0 : windingNumber(loop, light_, receivers_.center());
    if (!crosses && winding == 0) return;
    std::vector<glm::vec3>& kept = scratch_.kept;
    kept.clear();
    for (const Judged& v : collapsed) kept.push_back(v.ti);
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
  /// False where all of the loop lies beyond one side.
  bool judge(std::span<const glm::vec3> loop) {
    std::vector<Judged>& judged = scratch_.judged;
    judged.resize(loop.size());
    unsigned common = ~0u;
    reachesFar_ = reachesOut_ = false;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const glm::vec3& v = loop[k];
      judged[k] = {v, sides_.code(v), v.z >= receivers_.iHigh};
      common &= judged[k].code;
      reachesFar_ |= !(v.z >= farEnd_);
      if (judged[k].code != 0 && !reachesOut_) reachesOut_ = farOutside_.has(v);
    }
    return common == 0;
  }

  const SubLight& light_;
  const TangentBox& receivers_;
  const OuterSides& sides_;
  FarOutside farOutside_;
  float farEnd_;
  SimplifyScratch& scratch_;
  CasterLoops& result_;
  bool reachesFar_ = false, reachesOut_ = false;  ///< of the loop judged last
  int constant_ = 0;
  bool partial_ = false;
};
}  // namespace

Coverage simplify(const CasterLoops& caster, const SubLight& light, const TangentBox& receivers,
                  SimplifyScratch& scratch, CasterLoops& result) {
  return simplify(caster, light, receivers, OuterSides(light, receivers), scratch, result);
}

Coverage simplify(const CasterLoops& caster, const SubLight& light, const TangentBox& receivers,
                  const OuterSides& sides, SimplifyScratch& scratch, CasterLoops& result) {
  result.clear();
  if (caster.enclosesLight) return Coverage::full;
  if (caster.high.z <= farEnd(receivers)) return Coverage::none;
  if (sides.code(caster.low, caster.high) != 0) return Coverage::none;
  Simplifier simplifier(light, receivers, sides, scratch, result);
  for (const CasterLoops::Loop& loop : caster.loops) {
    simplifier.add({caster.points.data() + loop.first, loop.count});
  }
  return simplifier.coverage();
}

Coverage simplify(const NearSurface& surface, std::span<const std::uint32_t> facets, SheetSide side,
                  const SubLight& light, std::span<const FacetLight> lights, const ReceiverSet& receivers,
                  const OuterSides& sides, FacetChoice choice, SimplifyScratch& scratch,
                  CasterLoops& result) {
  result.clear();
  facetsThatMatter(surface, facets, side, light, lights, receivers, sides, choice, scratch.mattering);
  if (scratch.mattering.empty()) return Coverage::none;
  NearLoops& loops = scratch.loops;
  nearLoops(surface, scratch.mattering, light, receivers, choice, scratch.near, loops);
  Simplifier simplifier(light, receivers.box, sides, scratch, result);
  loops.joined.forEach([&](std::span<const glm::vec3> loop) { simplifier.add(loop); });
  // What stands before all receivers may cover all of the light.
  if (simplifier.coverage() == Coverage::full) return Coverage::full;
  loops.among.forEach([&](std::span<const glm::vec3> loop) { simplifier.add(loop); });
  loops.oneSided.forEach([&](std::span<const glm::vec3> loop) { simplifier.add(loop, LoopKind::oneSided); });
  return simplifier.coverage();
}

}  // namespace halfshadow::outlines
