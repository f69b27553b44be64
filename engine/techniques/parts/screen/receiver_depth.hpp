// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where the receivers are, per pixel: one pass a frame, shared by all lights and read by every technique
/// that works on the screen.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

struct ReceiverDepth {
  /// RGB: distance along the view axis less `nearest`, over `farthest`, a number of 5 bits of exponent and 19
  /// of mantissa: near surfaces are as exact before a wide ground as without it. A: ReceiverAlpha, 0 where
  /// there is no receiver.
  framegraph::ResourceId packed;
  /// Renderbuffer for depth tests against receivers: attach with InitialContent::keep.
  framegraph::ResourceId depthTest;
  /// What `depthTest` was drawn with: the view's, with the far plane at infinity so that volumes are never
  /// cut.
  glm::dmat4 clipFromWorld{1.0};
  double farthest = 1.0;  ///< world length of the stored 1
  double nearest = 0.0;   ///< and of the stored 0: no receiver is nearer
};

/// What alpha holds.
enum class ReceiverAlpha {
  one,     ///< 1, or 1/2 where the receiver has few triangles
  facets,  ///< of receivers that cast, where their facets face: hs_facetOf(). Places are those of facets'
           ///< planes
  numbers  ///< of receivers that cast, their numbers. Places as above, of them alone
};

/// A receiver that casts, and what is seen of it at most.
struct NumberedReceiver {
  const DrawItem* item = nullptr;
  std::optional<Rect> rect;  ///< pixels; nothing where it is out of view
  int number = 0;            ///< of no other whose rectangle overlaps; 0 where it is out of view
};
/// All of the frame that cast, in its order. Nothing where numbers do not suffice: alpha tells 254 of them.
std::optional<std::vector<NumberedReceiver>> numberReceivers(const LightScene& scene);

/// Adds the pass, which all lights of a frame share. `numbered`: with ReceiverAlpha::numbers.
ReceiverDepth planReceiverDepth(const LightScene& scene, PassPlan& plan,
                                ReceiverAlpha alpha = ReceiverAlpha::one,
                                std::span<const NumberedReceiver> numbered = {});

/// Of receivers that cast, where their facets face, as exactly as 2 x 16 bits tell: receiver_facets.frag.
/// Adds the pass, which all lights of a frame share. `depth`: of the same frame.
framegraph::ResourceId planReceiverFacets(const LightScene& scene, PassPlan& plan,
                                          const ReceiverDepth& depth);

/// A pixel's place in the coordinates (a, b, h) of a light is
/// eye + distance · (rayOrigin + x · rayX + y · rayY), x and y its window coordinates, distance what is
/// stored and ReceiverDepth::nearest.
struct ReceiverRays {
  glm::dvec3 eye{0.0}, rayOrigin{0.0}, rayX{0.0}, rayY{0.0};
};
/// `lightFromWorld`: linear part and the light's centre, which is subtracted first, in double.
ReceiverRays receiverRays(const View& view, const ReceiverDepth& depth, const glm::dmat3& lightFromWorld,
                          const glm::dvec3& lightCenterWorld);
/// Uniforms and texture of receiver_position.glsl; the program is current.
void addReceiverPosition(PlannedDraw& draw, const View& view, const ReceiverDepth& depth,
                         const ReceiverRays& rays);

}  // namespace halfshadow::techniques
