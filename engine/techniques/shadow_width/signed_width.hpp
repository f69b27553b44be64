// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The two-sided width map: distance and direction to the nearest silhouette in the light's map, on both
/// sides of it, with the depth of the caster there.
#pragma once

#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow::techniques {

/// Means over boxes of 2, 4, 8 ... texels of the width map, two sides a tile: what a straight edge is not.
struct WidthBoxes {
  framegraph::ResourceId atlas;
  int tiles = 1;  ///< in columns of two; tile i holds boxes of 2 << i and 4 << i texels
};

/// What corrects the straight edge's profile where silhouettes are not straight.
enum class WidthCorners {
  off,
  stored,    ///< of a split light: what it misses for the farthest receiver, in the map in place of normals
  receivers  ///< the boxes, by a further fetch of each receiver
};

/// Channels: red the signed distance (packed by width_distance.glsl, inside positive), green the component of
/// the edge's normal along t (with WidthCorners::stored what the straight edge misses, 127 for nothing), blue
/// the normalised distance of the caster at the edge from the light (of a split light its depth), alpha the
/// largest of casters within one texel.
struct SignedWidthMap {
  framegraph::ResourceId map;
  /// Along s and t; the texels' shape follows the light's, so that its kernel is a square of them.
  glm::dvec2 depthTexelsPerTexel{4.0};
  int margin = 0;             ///< texels around the depth map, for penumbrae that leave it
  int width = 0, height = 0;  ///< texels of one map, margins included
  int tilesPerSide = 1;       ///< so many maps a side stand in the image, each a sub-light's
  WidthCorners corners = WidthCorners::off;
  double reachTexels = 1.0;         ///< largest distance stored
  double kneeTexels = 1.0;          ///< of the storage: fine steps below it
  framegraph::ResourceId coverage;  ///< what it was made of
  WidthBoxes boxes;                 ///< unless WidthCorners::off
};

/// Texels of the depth map that one texel of the width map covers along s and t, at the finest: at most 4
/// where the light's kernel is a square of the map, 1 on small maps.
glm::dvec2 depthTexelsPerWidthTexel(const MapSpace& space);

/// Adds the passes: coverage, seeds, jump flooding, finish. Their content is kept while light and casters
/// are.
SignedWidthMap planSignedWidth(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                               WidthCorners corners);

/// Adds the map's texture and uniforms to a receiver program that reads it.
void addSignedWidth(const LightScene& scene, ReceiverShading& shading, const LightDepth& depth,
                    const SignedWidthMap& map);
/// The same for the boxes.
void addWidthBoxes(ReceiverShading& shading, const SignedWidthMap& map);

}  // namespace halfshadow::techniques
