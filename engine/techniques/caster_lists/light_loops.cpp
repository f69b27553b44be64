// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/caster_lists/light_loops.hpp"

#include <cmath>

#include "planner/frame_planner.hpp"

namespace halfshadow::techniques {
namespace {
/// A point light counts as a square this wide, in units of height: hard shadows to a fraction of a pixel.
constexpr double kMinHalfLength = 1e-4;

/// About a thousandth of the casters' size, in steps of ten.
double liftDistance(std::span<const DrawItem> casters, double bias) {
  scene::Bounds bounds;
  for (const DrawItem& caster : casters) bounds.include(caster.boundsWorld);
  const double radius = bounds.radius();
  return radius > 0.0 ? bias * 0.002 * std::pow(10.0, std::floor(std::log10(radius))) : 0.0;
}
}  // namespace

bool LightLoops::update(const LightFrame& frame, std::span<const SubLight> subLights) {
  const std::uint64_t key = planner::combineKeys(frame.contentKey, frame.settings.revision());
  if (key_ == key) return false;
  key_ = key;
  // A power of two: casters that move about must not change the coordinates of the others.
  const double unit = std::exp2(std::ceil(std::log2(frame.fit.farDistance)));
  lift_ = liftDistance(frame.casters, frame.settings.real("bias"));
  plane_ = scene::LightPlane(frame.light, unit, kMinHalfLength * unit);
  const std::span<const scene::PlacedCaster> casters = placedCasters(frame);
  subLights_.clear();
  silhouettes_.resize(subLights.size());
  for (std::size_t i = 0; i < subLights.size(); ++i) {
    const SubLight& subLight = subLights[i];
    subLights_.push_back(loopsOf(silhouettes_[i].update(casters, plane_, subLight.center.x, subLight.center.y,
                                                        kMinHeight, scene::LayerSplit::alongside),
                                 casters, subLight));
  }
  return true;
}

}  // namespace halfshadow::techniques
