// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Proofs that one object cannot come between another and a light (internal to engine/planner).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planner/frame_planner.hpp"

namespace halfshadow::planner {

/// For one light. A receiver is not shadowed by a caster
/// - where a plane has the caster on one side and the receiver with the whole light on the other: one of the
///   few planes that support either (a ground under what stands on it, a box under a floor);
/// - where both it and the whole light are inside the caster and that is a closed convex body (a room);
/// - by itself, when it is flat; or when it is a closed convex body, no face's plane cuts the light, and it
/// is
///   seen from outside or holds the light: its faces then see all of the light or do not face it.
/// - where parts of the receiver reach through such a plane but are seen by no one: the camera is on the
///   light's side, too, and looks at them through a face of the caster that lies in the plane (what is sunk
///   into a ground).
/// Touching is allowed, within the rounding of the coordinates to float. Objects without shape are never
/// proved anything of.
class Separation {
 public:
  Separation(const FrameInput& input, const scene::AreaLight& light);
  /// Proved: no ray from a point of the receiver that can be seen to the light meets the caster.
  bool cannotShadow(std::uint32_t caster, std::uint32_t receiver);
  /// A proof depended on where the camera is, or would with another.
  bool dependsOnCamera() const { return dependsOnCamera_; }

 private:
  /// An object as the proofs need it, in world axes, relative to the light's centre.
  struct Body {
    std::vector<scene::SupportingPlane> planes;  ///< of faces first, then of the box
    std::size_t facePlanes = 0;
    std::array<glm::dvec3, 8> corners;  ///< of the box in object space
    glm::dvec3 center{0.0};
    glm::dmat4 fromObject{1.0};
    glm::dvec3 largestTranslation{0.0};
  };
  struct LightExtent {
    double low = 0.0, high = 0.0;
  };
  const Body& body(std::uint32_t object);
  LightExtent lightAlong(const glm::dvec3& direction) const;
  double rounding(std::uint32_t object, const glm::dvec3& direction);
  bool reachesOnlyFrom(std::uint32_t object, const glm::dvec3& direction, double least);
  bool shadowsItself(std::uint32_t object);
  bool hidesWhatIsBehind(const scene::SupportingPlane& plane, std::uint32_t receiver, double slack);
  bool enclosesLight(std::uint32_t object);

  const FrameInput& input_;
  const scene::AreaLight& light_;
  std::array<glm::dvec3, 4> lightCorners_;
  std::vector<std::optional<Body>> bodies_;
  bool dependsOnCamera_ = false;
};

/// The eye, or a part of the near plane, may be inside the object: then it may be seen from within.
bool maySeeInside(const FrameInput& input, std::uint32_t object);

}  // namespace halfshadow::planner
