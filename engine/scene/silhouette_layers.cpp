// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/silhouette_layers.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::scene {
namespace {
double cross2(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// One directed edge of a loop; `flat` is its start projected from the source.
struct Strand {
  glm::dvec3 from{0.0}, to{0.0};  ///< (a, b, h)
  glm::dvec2 flatFrom{0.0}, flatTo{0.0};
  std::uint32_t next = 0;  ///< the strand that continues it
};

/// Strand `on` is left at `t`, where strand `other` crosses it.
struct Crossing {
  std::uint32_t on = 0, other = 0;
  double t = 0.0;
  std::uint32_t pair = 0;
};

class LayerSplitter {
 public:
  LayerSplitter(const LightSilhouettes& source, const glm::dvec2& sourcePoint)
      : source_(source), sourcePoint_(sourcePoint) {}

  /// Appends the layers of `caster` to `out`.
  void split(const LightSilhouettes::Caster& caster, LayerSplit split, LightSilhouettes& out) {
    readStrands(caster);
    findCrossings();
    std::vector<Layer> layers;
    if (caster.loopCount > 1 || !crossings_.empty()) trace(layers);
    if (layers.size() <= 1) {
      copy(caster, out);
      return;
    }
    if (split == LayerSplit::outline) layers.resize(1);
    dropSmallLoops(layers);
    if (split == LayerSplit::alongside) {
      copy(caster, out);
      out.casters.back().layerCount = static_cast<std::uint32_t>(layers.size());
    }
    for (const Layer& layer : layers) emit(caster, layer, out);
  }

 private:
  struct FlatLoop {
    std::vector<glm::dvec3> points;
    double area = 0.0;  ///< of the projection
  };
  struct Layer {
    std::vector<FlatLoop> loops;
    double area = 0.0;
  };

  /// Jagged outlines of fine meshes cover slivers twice: they cost vertices and darken nothing that is seen.
  static void dropSmallLoops(std::vector<Layer>& layers) {
    const double least = 0.01 * layers[0].area;
    for (std::size_t i = 1; i < layers.size(); ++i) {
      std::erase_if(layers[i].loops, [&](const FlatLoop& loop) { return std::abs(loop.area) < least; });
    }
    while (layers.size() > 1 && layers.back().loops.empty()) layers.pop_back();
  }

  glm::dvec2 flat(const glm::dvec3& p) const { return (glm::dvec2(p) - sourcePoint_) / p.z; }

  void readStrands(const LightSilhouettes::Caster& caster) {
    strands_.clear();
    // Loops often meet at a vertex or share an edge. Moved apart by far less than positions are known, every
    // crossing is a proper one.
    const glm::dvec2 size = glm::dvec2(caster.high - caster.low) / static_cast<double>(caster.high.z);
    const double step = 1e-10 * (std::abs(size.x) + std::abs(size.y));
    std::uint32_t state = 1;
    const auto jitter = [&] {
      state = state * 1664525u + 1013904223u;
      return step * (static_cast<double>(state >> 8) / (1u << 24) - 0.5);
    };
    for (std::uint32_t l = caster.firstLoop; l < caster.firstLoop + caster.loopCount; ++l) {
      const LightSilhouettes::Loop& loop = source_.loops[l];
      const auto first = static_cast<std::uint32_t>(strands_.size());
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const glm::dvec3 a = source_.points[loop.first + i];
        const glm::dvec3 b = source_.points[loop.first + (i + 1) % loop.count];
        const double x = jitter(), y = jitter();
        strands_.push_back({a, b, flat(a) + glm::dvec2(x, y), {}, first + (i + 1) % loop.count});
      }
    }
    for (Strand& strand : strands_) strand.flatTo = strands_[strand.next].flatFrom;
  }

  /// All pairs of strands whose projections cross, by sweeping over x.
  void findCrossings() {
    crossings_.clear();
    const auto low = [&](std::uint32_t s) { return std::min(strands_[s].flatFrom.x, strands_[s].flatTo.x); };
    const auto high = [&](std::uint32_t s) { return std::max(strands_[s].flatFrom.x, strands_[s].flatTo.x); };
    order_.resize(strands_.size());
    for (std::uint32_t s = 0; s < order_.size(); ++s) order_[s] = s;
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return low(a) < low(b); });
    active_.clear();
    for (const std::uint32_t s : order_) {
      const double start = low(s);
      std::erase_if(active_, [&](std::uint32_t other) { return high(other) < start; });
      for (const std::uint32_t other : active_) cross(s, other);
      active_.push_back(s);
    }
    // Along each strand in order; each crossing knows its twin on the other strand.
    byStrand_.resize(crossings_.size());
    for (std::uint32_t c = 0; c < byStrand_.size(); ++c) byStrand_[c] = c;
    std::sort(byStrand_.begin(), byStrand_.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Crossing& p = crossings_[a];
      const Crossing& q = crossings_[b];
      return p.on != q.on ? p.on < q.on : p.t < q.t;
    });
    placeOf_.resize(crossings_.size());
    for (std::uint32_t i = 0; i < byStrand_.size(); ++i) placeOf_[byStrand_[i]] = i;
  }

  void cross(std::uint32_t s, std::uint32_t o) {
    const Strand& a = strands_[s];
    const Strand& b = strands_[o];
    if (a.next == o || b.next == s) return;
    if (std::max(a.flatFrom.y, a.flatTo.y) < std::min(b.flatFrom.y, b.flatTo.y) ||
        std::max(b.flatFrom.y, b.flatTo.y) < std::min(a.flatFrom.y, a.flatTo.y)) {
      return;
    }
    const glm::dvec2 da = a.flatTo - a.flatFrom, db = b.flatTo - b.flatFrom;
    const double a0 = cross2(db, a.flatFrom - b.flatFrom), a1 = cross2(db, a.flatTo - b.flatFrom);
    const double b0 = cross2(da, b.flatFrom - a.flatFrom), b1 = cross2(da, b.flatTo - a.flatFrom);
    if ((a0 > 0) == (a1 > 0) || (b0 > 0) == (b1 > 0)) return;
    const auto first = static_cast<std::uint32_t>(crossings_.size());
    crossings_.push_back({s, o, a0 / (a0 - a1), first + 1});
    crossings_.push_back({o, s, b0 / (b0 - b1), first});
  }

  /// The point of the strand whose projection is at `t` of its projection.
  glm::dvec3 pointAt(const Strand& strand, double t) const {
    const double u = t * strand.from.z / (t * strand.from.z + (1.0 - t) * strand.to.z);
    return glm::mix(strand.from, strand.to, u);
  }

  /// Turns of all loops around a point of the projection.
  int winding(const glm::dvec2& at) const {
    int turns = 0;
    for (const Strand& strand : strands_) {
      const glm::dvec2 p = strand.flatFrom - at, q = strand.flatTo - at;
      if ((p.y > 0) == (q.y > 0)) continue;
      const double side = cross2(p, q);
      turns += q.y > 0 ? side > 0 : -(side < 0);
    }
    return turns;
  }

  /// Pieces of strands between crossings, numbered: piece k of strand s ends at its k-th crossing.
  void trace(std::vector<Layer>& layers) {
    firstCrossing_.assign(strands_.size() + 1, 0);
    for (const Crossing& crossing : crossings_) ++firstCrossing_[crossing.on + 1];
    for (std::size_t s = 0; s < strands_.size(); ++s) firstCrossing_[s + 1] += firstCrossing_[s];
    // Piece number of strand s from its i-th crossing on: s + place of that crossing.
    taken_.assign(strands_.size() + crossings_.size(), false);
    for (std::uint32_t s = 0; s < strands_.size(); ++s) {
      for (std::uint32_t c = firstCrossing_[s]; c <= firstCrossing_[s + 1]; ++c) {
        if (!taken_[s + c]) traceFrom(s, c, layers);
      }
    }
  }

  /// `c`: place of the crossing that ends the piece (the strand's end when it is behind its last).
  void traceFrom(std::uint32_t s, std::uint32_t c, std::vector<Layer>& layers) {
    std::vector<glm::dvec3> loop;
    double area = 0.0, longest = -1.0;
    glm::dvec2 probe(0.0), before(0.0), origin(0.0);
    const auto add = [&](const glm::dvec3& p) {
      const glm::dvec2 now = flat(p);
      if (loop.empty()) {
        origin = now;
      } else {
        area += 0.5 * cross2(before - origin, now - origin);
        const glm::dvec2 step = now - before;
        const double length = glm::length(step);
        if (length > longest) {
          longest = length;
          // A millionth of the edge's length to its left, where a loop's inside is.
          probe = 0.5 * (before + now) + 1e-6 * glm::dvec2(-step.y, step.x);
        }
      }
      before = now;
      loop.push_back(p);
    };
    while (!taken_[s + c]) {
      taken_[s + c] = true;
      const Strand& strand = strands_[s];
      const bool fromStart = c == firstCrossing_[s];
      add(fromStart ? strand.from : pointAt(strand, crossings_[byStrand_[c - 1]].t));
      if (c == firstCrossing_[s + 1]) {
        s = strand.next;
        c = firstCrossing_[s];
        continue;
      }
      const Crossing& crossing = crossings_[byStrand_[c]];
      add(pointAt(strand, crossing.t));
      s = crossing.other;
      c = placeOf_[crossing.pair] + 1;
    }
    if (loop.size() < 3) return;
    const auto layer = static_cast<std::size_t>(std::max(1, winding(probe))) - 1;
    if (layers.size() <= layer) layers.resize(layer + 1);
    layers[layer].loops.push_back({std::move(loop), area});
    layers[layer].area += area;
  }

  void emit(const LightSilhouettes::Caster& caster, const Layer& layer, LightSilhouettes& out) const {
    LightSilhouettes::Caster entry = caster;
    entry.firstLoop = static_cast<std::uint32_t>(out.loops.size());
    entry.loopCount = static_cast<std::uint32_t>(layer.loops.size());
    entry.low = glm::vec3(1e30f);
    entry.high = glm::vec3(-1e30f);
    for (const FlatLoop& loop : layer.loops) {
      out.loops.push_back(
          {static_cast<std::uint32_t>(out.points.size()), static_cast<std::uint32_t>(loop.points.size())});
      for (const glm::dvec3& p : loop.points) {
        out.points.push_back(p);
        entry.low = glm::min(entry.low, glm::vec3(p));
        entry.high = glm::max(entry.high, glm::vec3(p));
      }
    }
    out.casters.push_back(entry);
  }

  void copy(LightSilhouettes::Caster caster, LightSilhouettes& out) const {
    const std::uint32_t firstLoop = caster.firstLoop;
    caster.firstLoop = static_cast<std::uint32_t>(out.loops.size());
    for (std::uint32_t l = firstLoop; l < firstLoop + caster.loopCount; ++l) {
      const LightSilhouettes::Loop& loop = source_.loops[l];
      out.loops.push_back({static_cast<std::uint32_t>(out.points.size()), loop.count});
      out.points.insert(out.points.end(), source_.points.begin() + loop.first,
                        source_.points.begin() + loop.first + loop.count);
    }
    out.casters.push_back(caster);
  }

  const LightSilhouettes& source_;
  glm::dvec2 sourcePoint_;
  std::vector<Strand> strands_;
  std::vector<Crossing> crossings_;
  std::vector<std::uint32_t> order_, active_, byStrand_, placeOf_, firstCrossing_;
  std::vector<bool> taken_;
};
}  // namespace

void splitLayers(LightSilhouettes& silhouettes, double sourceA, double sourceB, LayerSplit split) {
  if (split == LayerSplit::none) return;
  LightSilhouettes result;
  LayerSplitter splitter(silhouettes, {sourceA, sourceB});
  for (const LightSilhouettes::Caster& caster : silhouettes.casters) splitter.split(caster, split, result);
  result.counters = silhouettes.counters;
  silhouettes = std::move(result);
}

}  // namespace halfshadow::scene
