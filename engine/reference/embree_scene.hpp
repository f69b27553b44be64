// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Private to the reference: scenes in the tracer's own space, and their Embree form.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::reference {

/// Trace space: the casters' bounds become the unit sphere at the origin, so that floats are equally good for
/// scenes of any size and place.
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
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
};

TraceMesh traceMeshOf(const scene::SceneObject& object, const TraceSpace& space);

/// A committed Embree scene in robust mode; geometry ids are positions in the list given to `build`.
class EmbreeScene {
 public:
  static Result<EmbreeScene> build(const std::vector<TraceMesh>& meshes);
  RTCScene handle() const { return scene_.get(); }

 private:
  struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<RTCDeviceTy, DeviceRelease> device_;
  std::unique_ptr<RTCSceneTy, SceneRelease> scene_;  // after the device: released before it
};

}  // namespace halfshadow::reference
