// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "plan_rig.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "base/keys.hpp"
#include "scene/convex_hull.hpp"

namespace halfshadow::test {
namespace {
constexpr int kWidth = 320, kHeight = 240;
constexpr double kReceiversBehindCasters = 1.3;  // farthest receiver over farthest caster
}  // namespace

device::Capabilities capabilitiesWithout(const std::vector<device::Capability>& missing) {
  device::Capabilities capabilities;
  capabilities.limits.textureSize = capabilities.limits.renderbufferSize = 4096;
  capabilities.probes = {.highpMantissaBits = 23, .mediumpMantissaBits = 10, .varyingMantissaBits = 23};
  for (device::CapabilityState& state : capabilities.states) state.outcome = device::ProbeOutcome::available;
  for (const device::Capability capability : missing) {
    capabilities.states[static_cast<std::size_t>(capability)].outcome = device::ProbeOutcome::forcedOff;
    if (capability == device::Capability::highp) capabilities.probes.highpMantissaBits = 0;
  }
  return capabilities;
}

PlanRig::PlanRig(const scene::SceneDescription& scene, device::Capabilities capabilities,
                 std::vector<techniques::SettingInfo> settings)
    : capabilities_(std::move(capabilities)), settings_(std::move(settings)), light_(scene.lights.front()) {
  for (const scene::SceneObject& source : scene.objects) {
    objects_.push_back(std::make_unique<Object>());
    objects_.back()->source = source;
    objects_.back()->id = objects_.size();
    objects_.back()->revision = ++lastRevision_;
  }
  const scene::Camera& camera = *scene.camera;
  const double aspect = static_cast<double>(kWidth) / kHeight;
  screen_ = {.clipFromWorld = scene::clipFromView(camera, aspect) * scene::viewFromWorld(camera),
             .eyeWorld = camera.eyeWorld,
             .width = kWidth,
             .height = kHeight,
             .nearReach = scene::nearReach(camera, aspect)};
}

void PlanRig::moveCaster() {
  const auto caster =
      std::find_if(objects_.rbegin(), objects_.rend(), [](const auto& o) { return o->source.casts; });
  Object& moved = **caster;
  const double step = 0.1 * itemOf(moved).boundsWorld.radius();
  moved.source.worldFromObject =
      glm::translate(glm::dmat4(1.0), glm::dvec3(step, 0.0, 0.0)) * moved.source.worldFromObject;
  moved.revision = ++lastRevision_;
}

void PlanRig::moveLight() {
  light_.centerWorld += 0.01 * glm::length(light_.centerWorld) * glm::normalize(light_.halfU);
  ++lightRevision_;
}

techniques::DrawItem PlanRig::itemOf(const Object& object) const {
  const scene::TriangleMesh& mesh = *object.source.mesh;
  return {.object = object.id,
          .revision = object.revision,
          .mesh = reinterpret_cast<const techniques::GpuMesh*>(&object),  // its address tells meshes apart
          .casts = object.source.casts,
          .receives = object.source.receives,
          .worldFromObject = object.source.worldFromObject,
          .boundsWorld = scene::transformed(object.source.worldFromObject, scene::boundsOf(mesh)),
          .closed = mesh.statistics.closed() && mesh.statistics.nonManifoldEdges == 0,
          .mirrored = glm::determinant(glm::dmat3(object.source.worldFromObject)) < 0,
          .facetStream = techniques::needsFacetStream(capabilities_),
          .sourceMesh = &mesh,
          .geometry = &object.geometry};
}

const techniques::LightScene& PlanRig::prepare(int channel) {
  casters_.clear(), receivers_.clear(), shadowlessReceivers_.clear(), casterShapes_.clear();
  std::uint64_t contentKey = lightRevision_, sceneKey = lightRevision_;
  for (const auto& object : objects_) {
    const techniques::DrawItem item = itemOf(*object);
    sceneKey = combineKeys(sceneKey, item.revision);
    if (item.receives) receivers_.push_back(item);
    if (!item.casts) {
      shadowlessReceivers_.push_back(item);
      continue;
    }
    casters_.push_back(item);
    contentKey = combineKeys(contentKey, item.revision);
    object->pointsWorld.clear();
    for (const glm::dvec3& point : scene::enclosingPoints(*item.sourceMesh).points)
      object->pointsWorld.emplace_back(item.worldFromObject * glm::dvec4(point, 1.0));
    casterShapes_.push_back({.id = object->id,
                             .revision = object->revision,
                             .pointsWorld = object->pointsWorld,
                             .mesh = item.sourceMesh,
                             .worldFromObject = &object->source.worldFromObject});
  }
  const planner::LightFit fit =
      planner::fitLight(light_, casterShapes_, {.mapSize = settings_.integer("map_size")});
  scene_.reset(new techniques::LightScene{
      .capabilities = capabilities_,
      .settings = settings_,
      .screen = screen_,
      .channel = channel,
      .name = "light " + std::to_string(channel),
      .light = light_,
      .center = {.fit = fit, .casters = casters_, .contentKey = contentKey, .sceneKey = sceneKey},
      .casterShapes = casterShapes_,
      .receiverFarDistance = kReceiversBehindCasters * fit.farthestCaster,
      .casters = casters_,
      .groups = groups_,
      .silhouettes = silhouettes_,
      .receivers = receivers_,
      .shadowlessReceivers = shadowlessReceivers_,
      .contentKey = contentKey,
      .sceneKey = sceneKey});
  return *scene_;
}

Planned PlanRig::plan(techniques::LightPlanner& planner, int channel) {
  Planned planned;
  planned.status = planner.plan(prepare(channel), planned.plan);
  return planned;
}

}  // namespace halfshadow::test
