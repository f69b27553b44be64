// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>

#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow::techniques {

DepthStorage depthStorageFor(const device::Capabilities& capabilities) {
  // Without highp a depth texture would be read as fp16: 11 bits, 59 % wrong comparisons at a gap of 1e-4.
  if (!capabilities.has(device::Capability::highp)) return DepthStorage::packed16;
  if (!capabilities.has(device::Capability::depthTexture)) return DepthStorage::packed24;
  return capabilities.has(device::Capability::depth24) ? DepthStorage::texture24 : DepthStorage::texture16;
}

const char* depthStorageName(DepthStorage storage) {
  switch (storage) {
    case DepthStorage::texture24:
      return "depth texture, 24 bits";
    case DepthStorage::texture16:
      return "depth texture, 16 bits";
    case DepthStorage::packed24:
      return "RGBA8, 24 bits packed";
    case DepthStorage::packed16:
      return "RGBA8, 16 bits by ramp (no fragment highp)";
  }
  return "";
}

std::vector<std::string> depthDefines(DepthStorage storage) {
  if (storage == DepthStorage::packed24) return {"HS_DEPTH_PACKED24"};
  if (storage == DepthStorage::packed16) return {"HS_DEPTH_PACKED16"};
  return {};
}

MapSpace makeMapSpace(const planner::LightFit& fit, DepthStorage storage) {
  MapSpace space;
  space.mapSize = fit.mapSize;
  space.originWorld = glm::dvec3(glm::inverse(fit.lightFromWorld)[3]);
  space.nearDistance = fit.nearDistance;
  space.depthUnit = storage == DepthStorage::packed16 ? 256.0 : 1.0;
  const bool sixteenBits = storage == DepthStorage::texture16 || storage == DepthStorage::packed16;
  // 5e-7: what single-precision interpolation and division of 1 - near/z differ between two rasterisations.
  space.quantum = 1.5 * std::exp2(sixteenBits ? -16.0 : -24.0) + 5e-7;
  // Not where the map begins, which moves in steps: results do not change with the units that a scene is in.
  space.nearestCasterDepth = 1.0 - fit.nearDistance / fit.nearestCaster;
  space.farthestCasterDepth = 1.0 - fit.nearDistance / fit.farDistance;

  const glm::dvec2 extent = fit.tangentHigh - fit.tangentLow;
  const glm::dvec2 low = fit.tangentLow;
  // Columns of (x, y, z, 1) -> (s·z, t·z, d·z, z).
  glm::dmat4 mapFromLight(0.0);
  mapFromLight[0][0] = 1.0 / extent.x;
  mapFromLight[1][1] = 1.0 / extent.y;
  mapFromLight[2] = glm::dvec4(-low.x / extent.x, -low.y / extent.y, 1.0, 1.0);
  mapFromLight[3] = glm::dvec4(0.0, 0.0, -fit.nearDistance, 0.0);
  glm::dmat4 clipFromMap(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    clipFromMap[axis][axis] = 2.0;
    clipFromMap[3][axis] = -1.0;
  }
  clipFromMap[3][3] = 1.0;
  // In units of the near distance: z begins at 1 however large the world is, and fp16 fragments keep their
  // digits.
  space.mapFromWorld = (mapFromLight / fit.nearDistance) * fit.lightFromWorld;
  space.mapClipFromWorld = clipFromMap * space.mapFromWorld;
  // 1/zb - 1/zr = (dr - db) / near; the light's side L spans f·L·(1/zb - 1/zr) texels.
  space.texelsPerTangent = fit.texelsPerTangent();
  space.kernelTexelsPerDepth = space.texelsPerTangent * (2.0 * fit.halfSize) / fit.nearDistance;
  // A point light still has receivers behind casters: techniques take a width of 0 for "nothing in front".
  // Depths differ by less than 1, so this stays below a texel, the width of every technique's narrowest
  // kernel.
  space.kernelTexelsPerDepth = glm::max(space.kernelTexelsPerDepth, glm::dvec2(1.0));
  return space;
}

}  // namespace halfshadow::techniques
