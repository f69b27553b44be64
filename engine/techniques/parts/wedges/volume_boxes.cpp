// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/volume_boxes.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::techniques {
namespace {
/// Corner bits: 1 = high a, 2 = high b, 4 = the farther rectangle.
constexpr std::array<std::uint16_t, kVolumeIndices> kBox = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6,
                                                            0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                                            0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
/// What rectangles are grown by.
constexpr double kMargin = 1e-4;

/// Near the light's plane penumbrae spread almost sideways, to corners so far away that rasterisers lose
/// their depth. A side that leaves the receivers' reach stands upright at its border instead.
bool leavesReach(const outlines::WedgeExtent& extent, const VolumeReach& reach) {
  const glm::dvec2 low = extent.low(reach.end), high = extent.high(reach.end);
  return std::min(low.x, low.y) < -reach.sideways || std::max(high.x, high.y) > reach.sideways;
}
glm::dvec2 lowWithin(const outlines::WedgeExtent& extent, double h, const VolumeReach& reach) {
  const glm::dvec2 low = extent.low(h), end = extent.low(reach.end), first = extent.low(extent.nearest);
  return {end.x < -reach.sideways ? std::min(-reach.sideways, first.x) : low.x,
          end.y < -reach.sideways ? std::min(-reach.sideways, first.y) : low.y};
}
glm::dvec2 highWithin(const outlines::WedgeExtent& extent, double h, const VolumeReach& reach) {
  const glm::dvec2 high = extent.high(h), end = extent.high(reach.end), first = extent.high(extent.nearest);
  return {end.x > reach.sideways ? std::max(reach.sideways, first.x) : high.x,
          end.y > reach.sideways ? std::max(reach.sideways, first.y) : high.y};
}
}  // namespace

double sidewaysReach(const LightScene& scene, const scene::LightPlane& plane) {
  double farthest = 1.0;
  for (const auto items : {scene.casters, scene.receivers, scene.shadowlessReceivers}) {
    for (const DrawItem& item : items) {
      for (const glm::dvec3& corner : item.boundsWorld.corners()) {
        const glm::dvec3 abh = plane.fromWorld(corner);
        farthest = std::max({farthest, std::abs(abh.x), std::abs(abh.y)});
      }
    }
  }
  return std::exp2(std::ceil(std::log2(farthest)) + 1.0);
}

std::array<glm::dvec3, 4> volumeCorners(const outlines::WedgeExtent& extent, double h,
                                        const VolumeReach& reach) {
  const glm::dvec2 low = lowWithin(extent, h, reach), high = highWithin(extent, h, reach);
  const glm::dvec2 grown = kMargin * (high - low + 1.0);
  std::array<glm::dvec3, 4> corners;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    corners[corner] = {corner & 1 ? high.x + grown.x : low.x - grown.x,
                       corner & 2 ? high.y + grown.y : low.y - grown.y, h};
  }
  return corners;
}

std::array<glm::dvec3, 5> eyeHull(const View& view, const scene::LightPlane& plane) {
  const glm::dmat4 worldFromClip = glm::inverse(view.clipFromWorld);
  std::array<glm::dvec3, 5> hull;
  hull[4] = plane.fromWorld(view.eyeWorld);
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec4 point = worldFromClip * glm::dvec4(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, -1, 1);
    hull[static_cast<std::size_t>(corner)] = plane.fromWorld(glm::dvec3(point) / point.w);
  }
  return hull;
}

bool eyeOutside(const outlines::WedgeExtent& extent, const VolumeReach& reach,
                const std::array<glm::dvec3, 5>& hull) {
  if (leavesReach(extent, reach)) return false;
  bool outside[6] = {true, true, true, true, true, true};
  for (const glm::dvec3& eye : hull) {
    const glm::dvec2 low = extent.low(eye.z) - 0.01, high = extent.high(eye.z) + 0.01;
    outside[0] &= eye.x < low.x;
    outside[1] &= eye.x > high.x;
    outside[2] &= eye.y < low.y;
    outside[3] &= eye.y > high.y;
    outside[4] &= eye.z < 0.99 * extent.nearest;
    outside[5] &= eye.z > reach.end * 1.01;
  }
  return std::ranges::any_of(outside, [](bool side) { return side; });
}

std::uint32_t VolumeIndices::addTo(PassPlan& plan, std::uint64_t id, std::size_t volumes,
                                   int verticesPerVolume) {
  buffer_.id = id;
  volumes = std::min(volumes, volumesPerDraw(verticesPerVolume));
  if (volumes > buffer_.key) {
    std::vector<std::uint16_t> indices;
    for (std::size_t volume = 0; volume < volumes; ++volume) {
      for (const std::uint16_t index : kBox) {
        indices.push_back(
            static_cast<std::uint16_t>(volume * static_cast<std::size_t>(verticesPerVolume) + index));
      }
    }
    buffer_.bytes = streamBytes(indices);
    buffer_.key = volumes;
  }
  return plan.addBuffer(buffer_);
}

}  // namespace halfshadow::techniques
