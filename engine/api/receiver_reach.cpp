// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/receiver_reach.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace halfshadow::api {
namespace {
/// Side of a point to the view's four planes and the near plane; inside = all >= 0.
std::array<double, 5> planeDistances(const planner::LightFit& fit, const glm::dvec3& p) {
  return {p.x - fit.tangentLow.x * p.z, fit.tangentHigh.x * p.z - p.x, p.y - fit.tangentLow.y * p.z,
          fit.tangentHigh.y * p.z - p.y, p.z - fit.nearDistance};
}

/// Parameters of the part of segment a-b inside the planes; false when none is.
bool clip(const std::array<double, 5>& a, const std::array<double, 5>& b, double& enter, double& leave) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] < 0 && b[i] < 0) return false;
    if (a[i] < 0) enter = std::max(enter, a[i] / (a[i] - b[i]));
    if (b[i] < 0) leave = std::min(leave, a[i] / (a[i] - b[i]));
  }
  return enter <= leave;
}
/// The same of a triangle, exactly.
double triangleFarDistance(const planner::LightFit& fit, const std::array<glm::dvec3, 3>& cornersLight,
                           std::vector<glm::dvec3>& polygon, std::vector<glm::dvec3>& kept) {
  polygon.assign(cornersLight.begin(), cornersLight.end());
  for (std::size_t plane = 0; plane < 5 && !polygon.empty(); ++plane) {
    kept.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
      const double a = planeDistances(fit, from)[plane], b = planeDistances(fit, to)[plane];
      if (a >= 0.0) kept.push_back(from);
      if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) kept.push_back(from + (to - from) * (a / (a - b)));
    }
    std::swap(polygon, kept);
  }
  double farthest = 0.0;
  for (const glm::dvec3& point : polygon) farthest = std::max(farthest, point.z);
  return farthest;
}

/// Larger meshes are not looked at in each frame: their boxes are.
constexpr std::size_t kMostTriangles = 4096;
/// Of distances to boxes, found in two ways.
constexpr double kRounding = 1e-12;

/// In which the same receiver reaches as far.
bool sameWindow(const planner::LightFit& a, const planner::LightFit& b) {
  return a.empty == b.empty && a.lightFromWorld == b.lightFromWorld && a.tangentLow == b.tangentLow &&
         a.tangentHigh == b.tangentHigh && a.nearDistance == b.nearDistance;
}

/// Of a receiver whose box reaches beyond what was found so far; else less than that.
double reachBeyond(double found, const planner::LightFit& fit, const planner::PlannedObject& receiver) {
  const double box = receiverFarDistance(fit, receiver.boundsWorld);
  if (box <= found || receiver.mesh->triangleCount() > kMostTriangles) return box;
  // Rounding may not make the exact answer the larger one.
  return std::min(box, receiverFarDistance(fit, *receiver.mesh, receiver.worldFromObject));
}

struct Farthest {
  double distance = 0.0;
  std::uint32_t id = 0;  ///< of the object
};
Farthest farthestReceiver(const planner::LightFit& fit, std::span<const planner::PlannedObject> objects);
}  // namespace

double receiverFarDistance(const planner::LightFit& fit, const scene::TriangleMesh& mesh,
                           const glm::dmat4& worldFromObject) {
  const glm::dmat4 lightFromObject = fit.lightFromWorld * worldFromObject;
  double farthest = 0.0;
  std::vector<glm::dvec3> polygon, kept;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 position(mesh.positions[mesh.indices[3 * t + k]]);
      corners[k] = glm::dvec3(lightFromObject * glm::dvec4(position, 1.0));
    }
    if (std::max({corners[0].z, corners[1].z, corners[2].z}) <= farthest) continue;
    farthest = std::max(farthest, triangleFarDistance(fit, corners, polygon, kept));
  }
  return farthest;
}

double receiverFarDistance(const planner::LightFit& fit, std::span<const planner::PlannedObject> objects) {
  return farthestReceiver(fit, objects).distance;
}

double ReceiverReach::update(const planner::LightFit& fit, std::span<const planner::PlannedObject> objects,
                             const ListChanges& changes) {
  const auto isFarthest = [&](std::uint32_t i) { return objects[i].id == farthestId_; };
  const auto changed = changes.since(seen_);
  const bool follows = changed && sameWindow(fit, fit_) && std::ranges::none_of(changed.places, isFarthest);
  if (follows) {
    for (const std::uint32_t i : changed.places) {
      const planner::PlannedObject& object = objects[i];
      if (!object.receives || object.boundsWorld.empty() || fit.empty) continue;
      const double reach = reachBeyond(farthest_, fit, object);
      if (reach > farthest_) farthest_ = reach, farthestId_ = object.id;
    }
  } else {
    const Farthest found = farthestReceiver(fit, objects);
    farthest_ = found.distance, farthestId_ = found.id;
  }
  fit_ = fit;
  seen_ = changes.revision;
  return farthest_;
}

namespace {
Farthest farthestReceiver(const planner::LightFit& fit, std::span<const planner::PlannedObject> objects) {
  if (fit.empty) return {};
  struct Reach {
    double atMost = 0.0;
    const planner::PlannedObject* receiver = nullptr;
  };
  const glm::dvec3 axis(fit.lightFromWorld[0].z, fit.lightFromWorld[1].z, fit.lightFromWorld[2].z);
  std::vector<Reach> reaches;
  for (const planner::PlannedObject& object : objects) {
    if (!object.receives || object.boundsWorld.empty()) continue;
    const scene::Bounds& box = object.boundsWorld;
    const double middle = glm::dot(axis, box.center()) + fit.lightFromWorld[3].z;
    const double half = 0.5 * glm::dot(glm::abs(axis), box.high - box.low);
    reaches.push_back({middle + half + kRounding * (std::abs(middle) + half), &object});
  }
  std::ranges::make_heap(reaches, {}, &Reach::atMost);
  Farthest farthest;
  while (!reaches.empty() && reaches.front().atMost > farthest.distance) {
    const planner::PlannedObject& receiver = *reaches.front().receiver;
    std::ranges::pop_heap(reaches, {}, &Reach::atMost);
    reaches.pop_back();
    const double reach = reachBeyond(farthest.distance, fit, receiver);
    if (reach > farthest.distance) farthest = {reach, receiver.id};
  }
  return farthest;
}
}  // namespace

double receiverFarDistance(const planner::LightFit& fit, const scene::Bounds& receiverWorld) {
  if (fit.empty || receiverWorld.empty()) return 0.0;
  const auto toLight = [&](const glm::dvec3& world) {
    return glm::dvec3(fit.lightFromWorld * glm::dvec4(world, 1.0));
  };
  double farthest = 0.0;
  // z is linear, so over box ∩ pyramid it is largest on an edge of the box inside the pyramid …
  const auto corners = receiverWorld.corners();
  for (unsigned from = 0; from < 8; ++from) {
    for (unsigned axis = 1; axis < 8; axis *= 2) {
      if (from & axis) continue;
      const glm::dvec3 a = toLight(corners[from]), b = toLight(corners[from | axis]);
      double enter = 0.0, leave = 1.0;
      if (!clip(planeDistances(fit, a), planeDistances(fit, b), enter, leave)) continue;
      farthest = std::max({farthest, a.z + (b.z - a.z) * enter, a.z + (b.z - a.z) * leave});
    }
  }
  // … or where an edge of the pyramid leaves the box.
  const glm::dmat4 worldFromLight = glm::inverse(fit.lightFromWorld);
  const glm::dvec3 origin = glm::dvec3(worldFromLight[3]);
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec3 tangent(corner & 1 ? fit.tangentHigh.x : fit.tangentLow.x,
                             corner & 2 ? fit.tangentHigh.y : fit.tangentLow.y, 1.0);
    const glm::dvec3 direction = glm::dvec3(worldFromLight * glm::dvec4(tangent, 0.0));
    double enter = 0.0, leave = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0.0) {
        if (origin[axis] < receiverWorld.low[axis] || origin[axis] > receiverWorld.high[axis]) leave = -1.0;
        continue;
      }
      const double t0 = (receiverWorld.low[axis] - origin[axis]) / direction[axis];
      const double t1 = (receiverWorld.high[axis] - origin[axis]) / direction[axis];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    // Flat boxes (a ground plane) are met in a single point: allow rounding.
    if (leave > 0 && enter <= leave * (1 + 1e-12)) farthest = std::max(farthest, leave);
  }
  return farthest;
}

}  // namespace halfshadow::api
