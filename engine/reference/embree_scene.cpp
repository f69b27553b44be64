// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "reference/embree_scene.hpp"

#include <algorithm>
#include <string>

namespace halfshadow::reference {

TraceSpace traceSpaceOf(const scene::SceneDescription& scene) {
  scene::Bounds bounds = scene::boundsWorld(scene, scene::ObjectFilter::casters);
  if (bounds.empty()) bounds = scene::boundsWorld(scene, scene::ObjectFilter::all);
  TraceSpace space;
  if (bounds.empty()) return space;
  space.centerWorld = bounds.center();
  if (bounds.radius() > 0.0) space.traceFromWorldScale = 1.0 / bounds.radius();
  return space;
}

TraceMesh traceMeshOf(const scene::SceneObject& object, const TraceSpace& space) {
  TraceMesh mesh;
  mesh.indices = object.mesh->indices;
  mesh.positions.reserve(object.mesh->positions.size());
  for (const glm::vec3& position : object.mesh->positions) {
    const glm::dvec3 positionWorld(object.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0));
    mesh.positions.push_back(glm::vec3(space.fromWorld(positionWorld)));
  }
  return mesh;
}

Result<EmbreeScene> EmbreeScene::build(const std::vector<TraceMesh>& meshes) {
  const auto failed = [](RTCDevice device) {
    const RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_OUT_OF_MEMORY) {
      return Error{ErrorCode::outOfMemory,
                   "Embree ran out of memory building the scene; use a smaller scene"};
    }
    return Error{ErrorCode::internal, "Embree cannot build the scene: error " + std::to_string(code) +
                                          " (a number of its RTCError); check its installation"};
  };
  EmbreeScene result;
  result.device_.reset(rtcNewDevice(nullptr));
  if (!result.device_) return failed(nullptr);
  RTCDevice device = result.device_.get();
  result.scene_.reset(rtcNewScene(device));
  rtcSetSceneFlags(result.scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(result.scene_.get(), RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const TraceMesh& mesh = meshes[i];
    if (mesh.indices.empty()) continue;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                              sizeof(glm::vec3), mesh.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
    if (positions && indices) {
      std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(positions));
      std::copy(mesh.indices.begin(), mesh.indices.end(), static_cast<std::uint32_t*>(indices));
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(result.scene_.get(), geometry, static_cast<unsigned>(i));
    }
    rtcReleaseGeometry(geometry);
    if (!positions || !indices) return failed(device);
  }
  rtcCommitScene(result.scene_.get());
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) return failed(device);
  return result;
}

}  // namespace halfshadow::reference
