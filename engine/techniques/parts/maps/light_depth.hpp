// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The shadow map itself: its storage rung, its space, its pass, and what readers of it need.
#pragma once

#include <string>
#include <vector>

#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

/// How light-space depth is stored, best first. The first that the device has is used; forcing capabilities
/// off selects the others.
enum class DepthStorage {
  texture24,  ///< depth texture of 24 bits
  texture16,  ///< depth texture of 16 bits
  packed24,   ///< RGBA8, integer split into three bytes, exact on rounding and on truncating targets
  packed16    ///< RGBA8, two bytes looked up in a ramp: for fragment shaders without highp
};
DepthStorage depthStorageFor(const device::Capabilities& capabilities);
const char* depthStorageName(DepthStorage storage);

/// The map's space. Stored depth d = 1 - near/z: affine in reciprocal distance, so that planes stay planes
/// over the map; 0 at the near distance, 1 infinitely far, where empty texels are: a receiver is never beyond
/// them.
struct MapSpace {
  glm::dmat4 mapFromWorld{
      1.0};  ///< world -> (s·z, t·z, d·z, z), s and t in [0, 1] over the map, z in near distances
  glm::dmat4 mapClipFromWorld{1.0};  ///< the same as OpenGL clip coordinates
  glm::dvec3 originWorld{0.0};       ///< the point that the map is seen from
  double nearDistance = 1.0;
  double depthUnit = 1.0;  ///< 1, or 256 without highp: shaders count depth in 1/depthUnit of the range
  double quantum = 0.0;    ///< storage step plus rasterisation error, share of the range
  double nearestCasterDepth = 0.0, farthestCasterDepth = 1.0;  ///< share of the range
  glm::dvec2 texelsPerTangent{1.0};                            ///< along both axes
  glm::dvec2 kernelTexelsPerDepth{0.0};  ///< light side in texels per unit of depth difference, both axes
  int mapSize = 1;
};
MapSpace makeMapSpace(const planner::LightFit& fit, DepthStorage storage);

enum class MapContent {
  casters,              ///< all that techniques need
  castersFarthest,      ///< back faces of casters, the farthest; empty texels are at depth 0
  castersAndReceivers,  ///< what the papers' scenes hold; receivers then shadow themselves
  lastReceivers  ///< the farthest light-facing receivers, see last_receivers.hpp; empty texels are at depth 0
};

struct LightDepth {
  framegraph::ResourceId map;
  DepthStorage storage = DepthStorage::texture24;
  MapSpace space;  ///< of the view, or what all views of a split light share, see planner::SubLights
  std::uint64_t contentKey = 0;
  MapContent content = MapContent::casters;
  const planner::SubLights* subLights = nullptr;  ///< that `map` holds the maps of; null: it holds one
  int atlasSize = 1;                              ///< texels of `map` a side
  int tilesPerSide() const { return subLights == nullptr ? 1 : subLights->grid.tilesPerSide(); }
};
/// Declares the depth pass (skipped by the plan while its content key is unchanged).
LightDepth planLightDepth(const LightScene& scene, const LightView& view, PassPlan& plan, MapContent content);
/// The same for all that the light is seen through: one pass over an atlas of its sub-lights' maps, or the
/// map from its centre.
LightDepth planLightDepths(const LightScene& scene, PassPlan& plan, MapContent content);

/// Defines of every shader that reads the map on this rung.
std::vector<std::string> depthDefines(DepthStorage storage);

/// Of shaders that read the maps of all sub-lights from their atlas: empty for one map.
std::vector<std::string> tileDefines(const LightDepth& depth);

/// A receiver program that samples the map: defines, textures and uniforms common to all map techniques.
/// `fragmentFile` and technique defines are the caller's.
ReceiverShading mapReceiverShading(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                                   std::string fragmentFile);

/// Adds to a receiver program what horizon.glsl needs.
void addHorizon(const LightDepth& depth, ReceiverShading& shading);

/// Texels per unit of depth between the places in the maps of neighbours: xy along u, zw along v.
glm::dvec4 subLightSteps(const LightDepth& depth);
/// Adds to a receiver program what receiver_inputs.glsl needs of a split light; mapReceiverShading() does.
void addSubLights(const LightDepth& depth, ReceiverShading& shading);
/// Adds to a receiver program what horizon.glsl needs.
void addHorizon(const LightScene& scene, const LightDepth& depth, ReceiverShading& shading);

}  // namespace halfshadow::techniques
