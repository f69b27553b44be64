// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/separation.hpp"

#include <algorithm>
#include <cmath>

#include "planner/light_space.hpp"

namespace halfshadow::planner {
namespace {
/// Rounding of a coordinate to float.
constexpr double kFloat = 1.0 / (1 << 23);
/// Of what is computed in double from coordinates relative to the light.
constexpr double kDouble = 1e-13;

scene::SupportingPlane placed(const scene::SupportingPlane& plane, const glm::dmat4& fromObject,
                              const glm::dmat3& normalFromObject) {
  const glm::dvec3 normal = glm::normalize(normalFromObject * plane.normal);
  const glm::dvec3 on(fromObject * glm::dvec4(plane.normal * plane.offset, 1.0));
  return {normal, glm::dot(normal, on)};
}
}  // namespace

Separation::Separation(const FrameInput& input, const scene::AreaLight& light)
    : input_(input),
      light_(light),
      lightCorners_(lightCornersRelative(light)),
      bodies_(input.objects.size()) {}

const Separation::Body& Separation::body(std::uint32_t index) {
  std::optional<Body>& known = bodies_[index];
  if (known) return *known;
  const PlannedObject& object = input_.objects[index];
  Body& made = known.emplace();
  made.fromObject = object.worldFromObject;
  made.fromObject[3] -= glm::dvec4(light_.centerWorld, 0.0);
  made.largestTranslation = glm::abs(glm::dvec3(object.worldFromObject[3]));
  const glm::dmat3 normalFromObject = glm::transpose(glm::inverse(glm::dmat3(made.fromObject)));
  for (const scene::SupportingPlane& plane : object.support->ofFaces) {
    made.planes.push_back(placed(plane, made.fromObject, normalFromObject));
  }
  made.facePlanes = made.planes.size();
  const scene::Bounds& box = object.support->bounds;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    made.planes.push_back(placed({normal, box.high[axis]}, made.fromObject, normalFromObject));
    made.planes.push_back(placed({-normal, -box.low[axis]}, made.fromObject, normalFromObject));
  }
  const auto corners = box.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    made.corners[i] = glm::dvec3(made.fromObject * glm::dvec4(corners[i], 1.0));
  }
  made.center = glm::dvec3(made.fromObject * glm::dvec4(box.center(), 1.0));
  return made;
}

Separation::LightExtent Separation::lightAlong(const glm::dvec3& direction) const {
  LightExtent extent;  // the centre, relative to which all is, is at 0
  for (const glm::dvec3& corner : lightCorners_) {
    const double along = glm::dot(direction, corner);
    extent.low = std::min(extent.low, along), extent.high = std::max(extent.high, along);
  }
  return extent;
}

double Separation::rounding(std::uint32_t index, const glm::dvec3& direction) {
  const Body& shape = body(index);
  const glm::dvec3 inObject = glm::abs(glm::transpose(glm::dmat3(shape.fromObject)) * direction);
  return kFloat * (glm::dot(inObject, input_.objects[index].support->largestCoordinate) +
                   glm::dot(glm::abs(direction), shape.largestTranslation)) +
         kDouble * glm::length(shape.center);
}

/// No vertex lies further back along `direction` than `least`.
bool Separation::reachesOnlyFrom(std::uint32_t index, const glm::dvec3& direction, double least) {
  const Body& shape = body(index);
  if (glm::dot(direction, shape.center) < least) return false;
  if (std::ranges::all_of(shape.corners,
                          [&](const glm::dvec3& corner) { return glm::dot(direction, corner) >= least; })) {
    return true;
  }
  // The box is no help where the shape does not fill its corners: a tilted thing that stands on a ground.
  const scene::TriangleMesh& mesh = *input_.objects[index].mesh;
  const glm::dvec3 inObject = glm::transpose(glm::dmat3(shape.fromObject)) * direction;
  const double leastInObject = least - glm::dot(direction, glm::dvec3(shape.fromObject[3]));
  return std::ranges::all_of(mesh.indices, [&](std::uint32_t vertex) {
    return glm::dot(inObject, glm::dvec3(mesh.positions[vertex])) >= leastInObject;
  });
}

bool Separation::enclosesLight(std::uint32_t index) {
  const Body& shape = body(index);
  for (std::size_t i = 0; i < shape.facePlanes; ++i) {
    const scene::SupportingPlane& plane = shape.planes[i];
    if (lightAlong(plane.normal).high > plane.offset + rounding(index, plane.normal)) return false;
  }
  return true;
}

bool Separation::shadowsItself(std::uint32_t index) {
  const scene::SupportingPlanes& support = *input_.objects[index].support;
  // The part of the light behind a flat receiver's own plane is not its own doing.
  if (support.planar) return false;
  if (!support.convex) return true;
  const Body& shape = body(index);
  for (std::size_t i = 0; i < shape.facePlanes; ++i) {
    const scene::SupportingPlane& plane = shape.planes[i];
    const double slack = rounding(index, plane.normal);
    const LightExtent extent = lightAlong(plane.normal);
    if (extent.low < plane.offset - slack && extent.high > plane.offset + slack) return true;
  }
  return maySeeInside(input_, index) && !enclosesLight(index);
}

bool Separation::cannotShadow(std::uint32_t caster, std::uint32_t receiver) {
  const PlannedObject &c = input_.objects[caster], &r = input_.objects[receiver];
  if (c.support == nullptr || r.support == nullptr || c.mesh == nullptr || r.mesh == nullptr) return false;
  if (caster == receiver) return !shadowsItself(caster);
  for (const scene::SupportingPlane& plane : body(caster).planes) {
    const double slack = rounding(caster, plane.normal) + rounding(receiver, plane.normal);
    if (lightAlong(plane.normal).low >= plane.offset - slack &&
        reachesOnlyFrom(receiver, plane.normal, plane.offset - slack)) {
      return true;
    }
  }
  for (const scene::SupportingPlane& plane : body(receiver).planes) {
    const double slack = rounding(caster, plane.normal) + rounding(receiver, plane.normal);
    if (lightAlong(plane.normal).high <= plane.offset + slack &&
        reachesOnlyFrom(caster, plane.normal, plane.offset - slack)) {
      return true;
    }
  }
  if (!c.support->convex || !enclosesLight(caster)) return false;
  const Body& around = body(caster);
  for (std::size_t i = 0; i < around.facePlanes; ++i) {
    const scene::SupportingPlane& plane = around.planes[i];
    const double slack = rounding(caster, plane.normal) + rounding(receiver, plane.normal);
    if (!reachesOnlyFrom(receiver, -plane.normal, -plane.offset - slack)) return false;
  }
  return true;
}

bool maySeeInside(const FrameInput& input, std::uint32_t object) {
  if (input.camera == nullptr) return true;
  const double reach = scene::nearReach(*input.camera, input.aspectWidthOverHeight);
  const PlannedObject& seen = input.objects[object];
  const scene::Bounds& bounds = seen.boundsWorld;
  const glm::dvec3& eye = input.camera->eyeWorld;
  if (!glm::all(glm::greaterThanEqual(eye, bounds.low - reach)) ||
      !glm::all(glm::lessThanEqual(eye, bounds.high + reach))) {
    return false;
  }
  if (seen.support == nullptr || !seen.support->convex) return true;
  glm::dmat4 fromObject = seen.worldFromObject;
  fromObject[3] -= glm::dvec4(eye, 0.0);
  const glm::dmat3 normalFromObject = glm::transpose(glm::inverse(glm::dmat3(fromObject)));
  return std::ranges::all_of(seen.support->ofFaces, [&](const scene::SupportingPlane& plane) {
    return placed(plane, fromObject, normalFromObject).offset >= -1.001 * reach;
  });
}

}  // namespace halfshadow::planner
