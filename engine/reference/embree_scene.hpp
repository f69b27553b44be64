// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Private to the reference: scenes in the tracer's own space, and rays against them in double precision.
/// Embree finds the triangles that a ray may meet, in boxes that allow for its floats; whether it does meet
/// them is decided here, in double, from the triangles' own corners.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::reference {

/// Trace space: the casters' bounds lie in the unit sphere at the origin, so that Embree's floats neither
/// overflow nor vanish. The scale is a power of two: it changes no digit.
struct TraceSpace {
  glm::dvec3 centerWorld{0.0};
  double traceFromWorldScale = 1.0;
  glm::dvec3 fromWorld(const glm::dvec3& pointWorld) const {
    return (pointWorld - centerWorld) * traceFromWorldScale;
  }
};

TraceSpace traceSpaceOf(const scene::SceneDescription& scene);

/// Indexed triangles of one object, in trace space.
struct TraceMesh {
  std::vector<glm::dvec3> positions;
  /// How far from where it was meant each position may lie, since the file holds it in single precision.
  std::vector<double> rounding;
  std::vector<std::uint32_t> indices;
  /// Whose alpha cuts holes into it, or null; lives as long as the tracer.
  const scene::SceneObject* cutBy = nullptr;
  /// Of nearest() alone: its back faces are not there; `mirrored`: its transform turned the winding round.
  bool frontOnly = false, mirrored = false;
};

TraceMesh traceMeshOf(const scene::SceneObject& object, const TraceSpace& space);

/// Where rays start: a point of a surface, or in space (no normal).
struct RayOrigin {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0};  ///< unit, of the facet that the point lies on
  double rounding = 0.0;   ///< of the point itself
};

inline constexpr std::size_t kPacketRays = 16;
/// Rays from one origin: each ends at origin + direction.
struct RayPacket {
  alignas(64) std::array<double, kPacketRays> x{}, y{}, z{};
  std::size_t count = 0;
};

/// The nearest triangle on a ray.
struct RayHit {
  std::uint32_t mesh = 0, triangle = 0;
  double distance = 0.0;
  glm::dvec3 normal{0.0};  ///< unit, towards the ray's origin
};

/// A committed Embree scene.
class EmbreeScene {
 public:
  /// `reach`: no ray starts farther than this from the origin of trace space.
  static Result<EmbreeScene> build(std::vector<TraceMesh> meshes, double reach);

  /// Rays pass through the holes that alpha cuts. How many of the packet's rays meet a triangle between their
  /// two ends. A triangle all of whose corners lie in the plane of the origin's facet, but for the rounding
  /// of their coordinates, is met by none: it is that facet, its continuation, or another surface in the same
  /// place.
  std::size_t occluded(const RayOrigin& origin, const RayPacket& rays) const;

  /// The nearest triangle at distances in [nearest, farthest] along a unit vector; false when there is none.
  bool nearest(const glm::dvec3& origin, const glm::dvec3& direction, double nearest, double farthest,
               RayHit& hit) const;

 private:
  struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  /// What Embree's callbacks see of a mesh.
  struct Geometry {
    TraceMesh mesh;
    std::uint32_t index = 0;
    double margin = 0.0;  ///< by which boxes are enlarged for the floats of rays
  };
  static void boundsOf(const RTCBoundsFunctionArguments* arguments);
  static void occludedBy(const RTCOccludedFunctionNArguments* arguments);
  static void intersectWith(const RTCIntersectFunctionNArguments* arguments);
  float exitDistance(const glm::dvec3& origin) const;

  std::vector<std::unique_ptr<Geometry>> geometries_;  // addresses are known to Embree
  double radius_ = 0.0;                                // of all meshes, about the origin of trace space
  std::unique_ptr<RTCDeviceTy, DeviceRelease> device_;
  std::unique_ptr<RTCSceneTy, SceneRelease> scene_;  // after the device: released before it
};

}  // namespace halfshadow::reference
