// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Proofs that one object cannot come between another and a light (internal to engine/planner).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner/frame_planner.hpp"

namespace halfshadow::planner {

/// For one light. A receiver is not shadowed by a caster
/// - where a plane has the caster on one side and the receiver with the whole light on the other: one of the
///   few planes that support either (a ground under what stands on it, a box under a floor);
/// - where both it and the whole light are inside the caster and that is a closed convex body (a room), or
/// the
///   eye and the light are, and the room is drawn: then nothing outside is seen;
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
  /// For the questions of one frame. What is known of bodies stays, unless `anew`: the light or the list of
  /// objects is another.
  void begin(const FrameInput& input, const scene::AreaLight& light, bool anew);
  void forget(std::uint32_t object) { bodies_[object].forget(); }
  /// Proved: no ray from a point of the receiver that can be seen to the light meets the caster.
  bool cannotShadow(std::uint32_t caster, std::uint32_t receiver);
  /// What the answers so far would have to be asked again for when the camera moves.
  struct ByCamera {
    std::uint32_t caster = 0, receiver = 0;
    bool cannotShadow = false;
  };
  std::vector<ByCamera> takeByCamera() { return std::exchange(byCamera_, {}); }
  void keepByCamera(const ByCamera& answer) { byCamera_.push_back(answer); }

 private:
  struct Plane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;
    const scene::SupportingPlane* source = nullptr;  ///< of faces; null for sides of the box
    double lightReach = 0.0;  ///< of the light along the normal, from its centre, either way
  };
  /// An object as the proofs need it, in world axes, relative to the light's centre.
  struct Body {
    std::array<glm::dvec3, 8> corners;  ///< of the box in object space
    glm::dvec3 center{0.0};
    glm::dmat4 fromObject{1.0};
    glm::dvec3 largestTranslation{0.0};
    std::vector<Plane> planes;  ///< of faces first, then of the box; made when first asked for
    std::size_t facePlanes = 0;
    bool known = false;
    void forget() {  // but the memory
      known = false;
      planes.clear();
    }
  };
  const Body& body(std::uint32_t object);
  const std::vector<Plane>& planes(std::uint32_t object);
  std::span<const Plane> facePlanes(std::uint32_t object) {
    const std::vector<Plane>& all = planes(object);
    return {all.data(), bodies_[object].facePlanes};
  }
  double rounding(std::uint32_t object, const glm::dvec3& direction);
  bool proves(std::uint32_t caster, std::uint32_t receiver);
  bool reachesOnlyFrom(std::uint32_t object, const glm::dvec3& direction, double least);
  bool shadowsItself(std::uint32_t object);
  bool takeBehind(const Plane& plane, std::uint32_t receiver, std::size_t triangle, double slack);
  bool takeAcross(const Plane& plane, std::uint32_t receiver, double slack);
  bool hidesWhatIsBehind(std::uint32_t caster, const Plane& plane, std::uint32_t receiver, double slack);
  bool enclosesLight(std::uint32_t object);
  bool eyeIsInside(std::uint32_t object);

  const FrameInput* input_ = nullptr;  ///< of this frame, as the light
  const scene::AreaLight* light_ = nullptr;
  std::array<glm::dvec3, 4> lightCorners_{};
  glm::dvec3 eye_{0.0};  ///< relative to the light's centre, as are the near plane's corners
  std::array<glm::dvec3, 4> nearCorners_{};
  std::vector<Body> bodies_;
  std::vector<ByCamera> byCamera_;
  bool askedCamera_ = false;
  // Working memory.
  std::vector<glm::dvec3> outline_, behind_;
  std::vector<std::size_t> blocksBehind_;
};

/// The eye, or a part of the near plane, may be inside the object: then it may be seen from within.
bool maySeeInside(const FrameInput& input, std::uint32_t object);

}  // namespace halfshadow::planner
