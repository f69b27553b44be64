// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "reference/embree_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "scene/cutout.hpp"

namespace halfshadow::reference {
namespace {
/// Half a unit in the last place of a float and of a double near 1, times four: positions pass through a few
/// roundings on their way (an exporter's, a matrix product's).
constexpr double kFloatRounding = 4.0 * 0x1p-24, kDoubleRounding = 4.0 * 0x1p-52;

struct Corners {
  glm::dvec3 a, b, c;
};

Corners cornersOf(const TraceMesh& mesh, std::uint32_t triangle) {
  const std::uint32_t* index = &mesh.indices[3 * std::size_t{triangle}];
  return {mesh.positions[index[0]], mesh.positions[index[1]], mesh.positions[index[2]]};
}

/// A triangle seen from a point: which directions meet it, and how far away.
/// Based on: Plücker tests as in Kensler and Shirley, "Optimizing ray-triangle intersection via automated
/// search", 2006; neighbours share an edge's term, so that nothing passes between them.
struct SeenTriangle {
  glm::dvec3 normal, sideA, sideB, sideC;
  double offset;

  SeenTriangle(const Corners& corners, const glm::dvec3& from) {
    const glm::dvec3 a = corners.a - from, b = corners.b - from, c = corners.c - from;
    normal = glm::cross(b - a, c - a);
    offset = glm::dot(normal, a);
    sideA = glm::cross(b, c), sideB = glm::cross(c, a), sideC = glm::cross(a, b);
  }
  /// Whether the whole line in this direction passes through.
  bool pierced(double x, double y, double z) const {
    const double u = sideA.x * x + sideA.y * y + sideA.z * z, v = sideB.x * x + sideB.y * y + sideB.z * z,
                 w = sideC.x * x + sideC.y * y + sideC.z * z;
    return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  }
  /// Weights of the corners where the line in this direction passes through; of what is pierced.
  glm::dvec3 weights(double x, double y, double z) const {
    const glm::dvec3 d(x, y, z);
    const glm::dvec3 shares(glm::dot(sideA, d), glm::dot(sideB, d), glm::dot(sideC, d));
    return shares / (shares.x + shares.y + shares.z);
  }
  /// Whether the plane is met between the point and point + direction, both excluded.
  bool between(double x, double y, double z) const {
    const double slope = normal.x * x + normal.y * y + normal.z * z;
    return slope * offset > 0.0 && std::abs(offset) < std::abs(slope);
  }
};

/// Whether something is left of the triangle where the line in this direction meets it.
bool isThere(const TraceMesh& mesh, std::uint32_t triangle, const SeenTriangle& seen, double x, double y,
             double z) {
  if (mesh.cutBy == nullptr) return true;
  return scene::alphaAt(*mesh.cutBy, triangle, seen.weights(x, y, z)) >= mesh.cutBy->material.alphaCutoff;
}

/// What callbacks need to know of the rays; Embree hands its context through.
struct OcclusionContext {
  RTCIntersectContext embree;
  const RayOrigin* origin;
  const RayPacket* rays;
};

struct NearestContext {
  RTCIntersectContext embree;
  glm::dvec3 origin, direction;
  double nearest;
  RayHit best;
  bool found;
};

bool inPlane(const RayOrigin& origin, const TraceMesh& mesh, std::uint32_t triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t corner = mesh.indices[3 * std::size_t{triangle} + k];
    const double height = glm::dot(origin.normal, mesh.positions[corner] - origin.point);
    if (!(std::abs(height) <= origin.rounding + mesh.rounding[corner])) return false;
  }
  return true;
}

Error embreeError(RTCDevice device) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_OUT_OF_MEMORY) {
    return {ErrorCode::outOfMemory, "Embree ran out of memory building the scene; use a smaller scene"};
  }
  return {ErrorCode::internal, "Embree cannot build the scene: error " + std::to_string(code) +
                                   " (a number of its RTCError); check its installation"};
}

float roundedDown(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

float roundedUp(double value) {
  return -roundedDown(-value);
}
}  // namespace

TraceSpace traceSpaceOf(const scene::SceneDescription& scene) {
  scene::Bounds bounds = scene::boundsWorld(scene, scene::ObjectFilter::casters);
  if (bounds.empty()) bounds = scene::boundsWorld(scene, scene::ObjectFilter::all);
  TraceSpace space;
  if (bounds.empty()) return space;
  space.centerWorld = bounds.center();
  if (bounds.radius() > 0.0) {
    space.traceFromWorldScale = std::exp2(-std::ceil(std::log2(bounds.radius())));
  }
  return space;
}

TraceMesh traceMeshOf(const scene::SceneObject& object, const TraceSpace& space) {
  TraceMesh mesh;
  if (object.material.alphaCutoff > 0.0f) mesh.cutBy = &object;
  mesh.indices = object.mesh->indices;
  mesh.positions.reserve(object.mesh->positions.size());
  mesh.rounding.reserve(object.mesh->positions.size());
  const glm::dmat3 linear(object.worldFromObject);
  const glm::dmat3 lengths(glm::abs(linear[0]), glm::abs(linear[1]), glm::abs(linear[2]));
  for (const glm::vec3& position : object.mesh->positions) {
    const glm::dvec3 positionWorld(object.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0));
    mesh.positions.push_back(space.fromWorld(positionWorld));
    const double inFile = glm::length(lengths * glm::abs(glm::dvec3(position)));
    const double inWorld = glm::length(positionWorld) + glm::length(space.centerWorld);
    mesh.rounding.push_back((kFloatRounding * inFile + kDoubleRounding * inWorld) *
                            space.traceFromWorldScale);
  }
  return mesh;
}

void EmbreeScene::boundsOf(const RTCBoundsFunctionArguments* arguments) {
  const auto& geometry = *static_cast<const Geometry*>(arguments->geometryUserPtr);
  const Corners corners = cornersOf(geometry.mesh, arguments->primID);
  const glm::dvec3 low = glm::min(corners.a, glm::min(corners.b, corners.c)) - geometry.margin;
  const glm::dvec3 high = glm::max(corners.a, glm::max(corners.b, corners.c)) + geometry.margin;
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = roundedDown(low.x), bounds.lower_y = roundedDown(low.y);
  bounds.lower_z = roundedDown(low.z);
  bounds.upper_x = roundedUp(high.x), bounds.upper_y = roundedUp(high.y), bounds.upper_z = roundedUp(high.z);
}

void EmbreeScene::occludedBy(const RTCOccludedFunctionNArguments* arguments) {
  const auto& context = *reinterpret_cast<const OcclusionContext*>(arguments->context);
  const TraceMesh& mesh = static_cast<const Geometry*>(arguments->geometryUserPtr)->mesh;
  const RayPacket& rays = *context.rays;
  const SeenTriangle seen(cornersOf(mesh, arguments->primID), context.origin->point);
  bool met[kPacketRays];
  bool any = false;
  const auto meets = [&](std::size_t ray) {
    return seen.pierced(rays.x[ray], rays.y[ray], rays.z[ray]) &&
           seen.between(rays.x[ray], rays.y[ray], rays.z[ray]) &&
           isThere(mesh, arguments->primID, seen, rays.x[ray], rays.y[ray], rays.z[ray]);
  };
  for (unsigned i = 0; i < arguments->N; ++i) {
    met[i] = arguments->valid[i] != 0 && meets(RTCRayN_id(arguments->ray, arguments->N, i));
    any = any || met[i];
  }
  if (!any || inPlane(*context.origin, mesh, arguments->primID)) return;
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (met[i]) RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
  }
}

void EmbreeScene::intersectWith(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& context = *reinterpret_cast<NearestContext*>(arguments->context);
  const auto& geometry = *static_cast<const Geometry*>(arguments->geometryUserPtr);
  const glm::dvec3& d = context.direction;
  const SeenTriangle seen(cornersOf(geometry.mesh, arguments->primID), context.origin);
  const double slope = glm::dot(seen.normal, d);
  if (slope == 0.0 || !seen.pierced(d.x, d.y, d.z)) return;
  if (geometry.mesh.frontOnly && (slope > 0.0) != geometry.mesh.mirrored) return;
  if (!isThere(geometry.mesh, arguments->primID, seen, d.x, d.y, d.z)) return;
  const double distance = seen.offset / slope;
  if (distance < context.nearest || distance > context.best.distance) return;
  // Of two surfaces in one place the first in the scene is seen, as it is where depth tests keep the first.
  if (context.found && distance == context.best.distance && geometry.index >= context.best.mesh) return;
  const glm::dvec3 unit = seen.normal / glm::length(seen.normal);
  context.found = true;
  context.best = {geometry.index, arguments->primID, distance, slope > 0.0 ? -unit : unit};
  RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  // Boxes that begin where this triangle lies are still looked into.
  RTCRayN_tfar(ray, arguments->N, 0) =
      std::min(RTCRayN_tfar(ray, arguments->N, 0), roundedUp(distance * (1.0 + 0x1p-20)));
  RTCHitN_geomID(RTCRayHitN_HitN(arguments->rayhit, arguments->N), arguments->N, 0) = arguments->geomID;
}

Result<EmbreeScene> EmbreeScene::build(std::vector<TraceMesh> meshes, double reach) {
  EmbreeScene result;
  for (const TraceMesh& mesh : meshes) {
    for (const std::uint32_t index : mesh.indices) {
      result.radius_ = std::max(result.radius_, glm::length(mesh.positions[index]));
    }
  }
  // A ray's float origin, direction and distances are off by 2^-24 of what they hold; traversal adds a few
  // operations.
  const double margin = 0x1p-20 * (reach + result.radius_);
  result.device_.reset(rtcNewDevice(nullptr));
  if (!result.device_) return embreeError(nullptr);
  RTCDevice device = result.device_.get();
  result.scene_.reset(rtcNewScene(device));
  rtcSetSceneFlags(result.scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(result.scene_.get(), RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].indices.empty()) continue;
    auto own = std::make_unique<Geometry>();
    own->mesh = std::move(meshes[i]);
    own->index = static_cast<std::uint32_t>(i);
    own->margin = margin;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    if (!geometry) return embreeError(device);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(own->mesh.indices.size() / 3));
    rtcSetGeometryUserData(geometry, own.get());
    rtcSetGeometryBoundsFunction(
        geometry, [](const RTCBoundsFunctionArguments* a) { boundsOf(a); }, nullptr);
    rtcSetGeometryOccludedFunction(geometry, occludedBy);
    rtcSetGeometryIntersectFunction(geometry, intersectWith);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(result.scene_.get(), geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
    result.geometries_.push_back(std::move(own));
  }
  rtcCommitScene(result.scene_.get());
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) return embreeError(device);
  return result;
}

float EmbreeScene::exitDistance(const glm::dvec3& origin) const {
  return roundedUp(1.001 * (glm::length(origin) + radius_) + std::numeric_limits<float>::min());
}

std::size_t EmbreeScene::occluded(const RayOrigin& origin, const RayPacket& rays) const {
  OcclusionContext context{{}, &origin, &rays};
  rtcInitIntersectContext(&context.embree);
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) RTCRay16 packet{};
  alignas(64) int valid[kPacketRays];
  const float exit = exitDistance(origin.point);
  const glm::vec3 start(origin.point);
  for (std::size_t i = 0; i < kPacketRays; ++i) {
    const std::size_t ray = std::min(i, rays.count - 1);
    const glm::dvec3 direction(rays.x[ray], rays.y[ray], rays.z[ray]);
    const double length = glm::length(direction);
    const glm::vec3 unit(direction / std::max(length, std::numeric_limits<double>::min()));
    packet.org_x[i] = start.x, packet.org_y[i] = start.y, packet.org_z[i] = start.z;
    packet.dir_x[i] = unit.x, packet.dir_y[i] = unit.y, packet.dir_z[i] = unit.z;
    packet.tnear[i] = 0.0f;
    // A light far beyond the scene would cost the boxes' tests their digits.
    packet.tfar[i] = length < exit ? roundedUp(length * (1.0 + 0x1p-20)) : exit;
    packet.mask[i] = ~0u;
    packet.id[i] = static_cast<unsigned>(ray);
    valid[i] = i < rays.count ? -1 : 0;
  }
  rtcOccluded16(valid, scene_.get(), &context.embree, &packet);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < rays.count; ++i) hidden += packet.tfar[i] < 0.0f ? 1u : 0u;
  return hidden;
}

bool EmbreeScene::nearest(const glm::dvec3& origin, const glm::dvec3& direction, double nearest,
                          double farthest, RayHit& hit) const {
  NearestContext context{{}, origin, direction, nearest, {.distance = farthest}, false};
  rtcInitIntersectContext(&context.embree);
  const glm::vec3 start(origin), unit(direction);
  RTCRayHit ray{};
  ray.ray.org_x = start.x, ray.ray.org_y = start.y, ray.ray.org_z = start.z;
  ray.ray.dir_x = unit.x, ray.ray.dir_y = unit.y, ray.ray.dir_z = unit.z;
  ray.ray.tnear = 0.0f;
  ray.ray.tfar = exitDistance(origin);
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_.get(), &context.embree, &ray);
  if (context.found) hit = context.best;
  return context.found;
}

}  // namespace halfshadow::reference
