// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/light_silhouettes.hpp"

#include <algorithm>

#include "scene/cut_silhouette.hpp"
#include "scene/silhouette_layers.hpp"

namespace halfshadow::scene {
namespace {
enum class Turn { keep, reverse };

glm::dvec3 atLeast(const glm::dvec3& halfVector, const glm::dvec3& fallback, double length) {
  const double own = glm::length(halfVector);
  return own >= length ? halfVector : (own > 0.0 ? halfVector * (length / own) : fallback * length);
}

/// Appends the scratch's loop to those of the last caster that `result` gets.
void appendLoop(Turn turn, LoopScratch& scratch, LightSilhouettes::Caster& caster, LightSilhouettes& result) {
  if (turn == Turn::reverse) std::ranges::reverse(scratch.loop);
  result.addLoop(scratch.loop);
  caster.include(scratch.loop);
}

/// The greatest height over the light of a part's points, found once for the layers that it is split into:
/// they follow each other.
class DeepestPoint {
 public:
  DeepestPoint(const HalfEdgeMesh& mesh, const AffineMap& lightFromObject)
      : mesh_(mesh), lightFromObject_(lightFromObject) {}
  float of(std::uint32_t part) {
    if (part == part_) return height_;
    part_ = part;
    height_ = -1e30f;
    const CasterPart& own = mesh_.parts()[part];
    for (const glm::uvec3& face : mesh_.faces().subspan(own.firstFace, own.faceCount)) {
      for (int k = 0; k < 3; ++k) {
        const double h = lightFromObject_.height(mesh_.positions()[face[k]]);
        height_ = std::max(height_, static_cast<float>(h));
      }
    }
    return height_;
  }

 private:
  const HalfEdgeMesh& mesh_;
  const AffineMap& lightFromObject_;
  std::uint32_t part_ = ~0u;
  float height_ = -1e30f;
};

/// A caster's silhouette in the light's coordinates, appended.
void appendCaster(const PlacedCaster& caster, const Silhouette& silhouette, const LightPlane& plane,
                  double minHeight, LoopScratch& scratch, LightSilhouettes& result) {
  const glm::dmat3 linear(caster.worldFromObject);
  const glm::dvec3 originWorld(caster.worldFromObject[3]);
  result.counters += silhouette.counters;
  // (a, b, h) = lightFromObject · object + offset; the large translations cancel in double.
  const AffineMap lightFromObject{plane.axes * linear, plane.fromWorld(originWorld)};
  DeepestPoint deepest(*caster.mesh, lightFromObject);
  // Seen from the light counter-clockwise is clockwise in (a, b); a mirrored object turns round once more.
  const Turn turn = glm::determinant(linear) > 0.0 ? Turn::reverse : Turn::keep;
  for (const Silhouette::Part& part : silhouette.parts) {
    LightSilhouettes::Caster placed{
        .object = caster.object,
        .part = part.part,
        .firstLoop = static_cast<std::uint32_t>(result.loops.size()),
        .low = glm::vec3(1e30f),
        .high = glm::vec3(-1e30f),
        .partWorld = transformed(caster.worldFromObject, caster.mesh->parts()[part.part].bounds),
        .closed = caster.mesh->parts()[part.part].closed,
        .turnedAway = part.turnedAway,
        .enclosesLight = part.enclosesLight};
    const HeightRange range = heightRange(caster.mesh->parts()[part.part].bounds, lightFromObject, minHeight);
    if (range == HeightRange::through) {
      scratch.cutLoops.clear();
      cutSilhouette(*caster.mesh, silhouette, part, lightFromObject, minHeight, scratch.cutLoops);
      for (const std::vector<glm::dvec3>& loop : scratch.cutLoops) {
        scratch.loop = loop;
        appendLoop(turn, scratch, placed, result);
      }
    }
    for (std::uint32_t l = 0; range == HeightRange::above && l < part.loopCount; ++l) {
      const Silhouette::Loop& loop = silhouette.loops[part.firstLoop + l];
      scratch.loop.clear();
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const std::uint32_t vertex = silhouette.vertices[loop.first + i];
        scratch.loop.push_back(lightFromObject(caster.mesh->positions()[vertex]));
      }
      appendLoop(turn, scratch, placed, result);
    }
    placed.loopCount = static_cast<std::uint32_t>(result.loops.size()) - placed.firstLoop;
    placed.deepest = placed.high.z;
    if (!placed.closed || placed.enclosesLight || !caster.mesh->parts()[part.part].convex)
      placed.deepest = std::max(placed.deepest, deepest.of(part.part));
    if (placed.loopCount > 0 || placed.enclosesLight) result.casters.push_back(placed);
  }
}
}  // namespace

LightPlane::LightPlane(const AreaLight& light, double heightUnitWorld, double minHalfLength)
    : LightPlane(light, emissionDirection(light) * heightUnitWorld, minHalfLength) {}

LightPlane::LightPlane(const AreaLight& light, const glm::dvec3& toUnitHeightWorld, double minHalfLength)
    : centerWorld(light.centerWorld),
      normal(emissionDirection(light)),
      toUnitHeight(toUnitHeightWorld),
      heightUnit(glm::dot(normal, toUnitHeightWorld)) {
  const glm::dvec3 helper = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = glm::normalize(glm::cross(helper, normal));
  halfU = atLeast(light.halfU, across, minHalfLength);
  const glm::dvec3 besideU = glm::normalize(glm::cross(normal, halfU));
  halfV = atLeast(light.halfV, besideU, minHalfLength);
  axes = glm::inverse(glm::dmat3(halfU, halfV, toUnitHeight));
}

glm::dvec3 LightPlane::toWorld(const glm::dvec3& abh) const {
  return centerWorld + abh.x * halfU + abh.y * halfV + abh.z * toUnitHeight;
}

void LightSilhouettes::Caster::include(std::span<const glm::dvec3> loop) {
  for (const glm::dvec3& p : loop) {
    low = glm::min(low, glm::vec3(p));
    high = glm::max(high, glm::vec3(p));
  }
}

void LightSilhouettes::clear() {
  points.clear();
  loops.clear();
  casters.clear();
  counters = {};
}

void LightSilhouettes::append(const LightSilhouettes& other) {
  const auto firstPoint = static_cast<std::uint32_t>(points.size());
  const auto firstLoop = static_cast<std::uint32_t>(loops.size());
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (const Loop& loop : other.loops) loops.push_back({firstPoint + loop.first, loop.count});
  for (Caster caster : other.casters) {
    caster.firstLoop += firstLoop;
    casters.push_back(caster);
  }
}

void LightSilhouettes::addLoop(std::span<const glm::dvec3> loop) {
  loops.push_back({static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(loop.size())});
  points.insert(points.end(), loop.begin(), loop.end());
}

void LightSilhouettes::addCaster(const LightSilhouettes& other, Caster entry) {
  const auto firstLoop = static_cast<std::uint32_t>(loops.size());
  other.forEachLoop(entry, [&](std::span<const glm::dvec3> loop) { addLoop(loop); });
  entry.firstLoop = firstLoop;
  casters.push_back(entry);
}

void lightSilhouettes(std::span<const PlacedCaster> casters, const LightPlane& plane, double sourceA,
                      double sourceB, double minHeight, LightSilhouettes& result, LayerSplit split) {
  result.clear();
  const glm::dvec3 sourceWorld = plane.toWorld({sourceA, sourceB, 0.0});
  SilhouetteScratch scratch;
  LoopScratch loops;
  Silhouette silhouette;
  for (const PlacedCaster& caster : casters) {
    extractSilhouette(*caster.mesh, caster.objectFromWorld(sourceWorld), scratch, silhouette);
    appendCaster(caster, silhouette, plane, minHeight, loops, result);
  }
  splitLayers(result, sourceA, sourceB, split);
}

bool LightSilhouetteCache::View::operator==(const View& other) const {
  return centerWorld == other.centerWorld && axes == other.axes && sourceA == other.sourceA &&
         sourceB == other.sourceB && minHeight == other.minHeight && split == other.split;
}

const LightSilhouettes& LightSilhouetteCache::update(CasterSilhouettes& extracted,
                                                     std::span<const PlacedCaster> casters,
                                                     const LightPlane& plane, double sourceA, double sourceB,
                                                     double minHeight, LayerSplit split) {
  counters_ = {};
  changedObjects_.clear();
  const View view{plane.centerWorld, plane.axes, sourceA, sourceB, minHeight, split};
  bool changed = casters.size() != order_.size() || generation_ == 0;
  if (!(view == view_)) {
    view_ = view;
    for (auto& [object, entry] : entries_) entry.revision = 0;
  }
  const LightPoint point{{sourceA, sourceB}, plane.toWorld({sourceA, sourceB, 0.0})};
  ++frame_;
  order_.resize(casters.size());
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const PlacedCaster& caster = casters[i];
    // Casters that share a number are told apart by how many came before.
    std::uint64_t key = caster.object;
    while (entries_[key].frame == frame_) key += std::uint64_t{1} << 32;
    Entry& entry = entries_[key];
    entry.frame = frame_;
    if (caster.revision != 0 && entry.revision == caster.revision && entry.mesh == caster.mesh) {
      ++counters_.reused;
    } else {
      entry.silhouettes.clear();
      appendCaster(caster, extracted.of(caster, point), plane, minHeight, scratch_, entry.silhouettes);
      splitLayers(entry.silhouettes, sourceA, sourceB, split);
      entry.revision = caster.revision;
      entry.mesh = caster.mesh;
      ++counters_.placed;
      changedObjects_.push_back(caster.object);
      changed = true;
    }
    changed = changed || order_[i] != key;
    order_[i] = key;
  }
  if (!changed) return result_;
  result_.clear();
  for (const std::uint64_t key : order_) result_.append(entries_[key].silhouettes);
  std::erase_if(entries_, [&](const auto& entry) { return entry.second.frame != frame_; });
  ++generation_;
  return result_;
}

}  // namespace halfshadow::scene
