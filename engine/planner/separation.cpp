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
  scene::SupportingPlane result{normal, glm::dot(normal, on), {}};
  for (const glm::dvec3& corner : plane.outline) {
    result.outline.emplace_back(fromObject * glm::dvec4(corner, 1.0));
  }
  return result;
}

/// Is a point of the plane inside its outline, by at least `margin`?
bool isInside(const scene::SupportingPlane& plane, const glm::dvec3& point, double margin) {
  const std::vector<glm::dvec3>& outline = plane.outline;
  double turn = 0.0;  // of the outline about the normal: a mirroring transform reverses it
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    turn += glm::dot(plane.normal, glm::cross(outline[i] - outline[0], outline[i + 1] - outline[0]));
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3 along = outline[(i + 1) % outline.size()] - outline[i];
    const double inward = glm::dot(plane.normal, glm::cross(along, point - outline[i]));
    if ((turn < 0.0 ? -inward : inward) < margin * glm::length(along)) return false;
  }
  return true;
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
    made.planes.push_back(placed({normal, box.high[axis], {}}, made.fromObject, normalFromObject));
    made.planes.push_back(placed({-normal, -box.low[axis], {}}, made.fromObject, normalFromObject));
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
  if (enclosesLight(index)) return false;
  dependsOnCamera_ = true;
  return maySeeInside(input_, index);
}

/// What of the receiver lies behind the plane is seen only through the plane's outline.
bool Separation::hidesWhatIsBehind(const scene::SupportingPlane& plane, std::uint32_t receiver,
                                   double slack) {
  if (plane.outline.empty() || input_.camera == nullptr) return false;
  const Body& shape = body(receiver);
  // What does not come before the plane at all is another matter: hardly ever is it wholly hidden.
  if (std::ranges::all_of(shape.corners, [&](const glm::dvec3& corner) {
        return glm::dot(plane.normal, corner) <= plane.offset + slack;
      })) {
    return false;
  }
  dependsOnCamera_ = true;
  const glm::dvec3 eye = input_.camera->eyeWorld - light_.centerWorld;
  const double eyeHeight = glm::dot(plane.normal, eye) - plane.offset;
  if (eyeHeight <= slack) return false;
  // The near plane must not open what hides.
  const glm::dmat3 worldFromView = glm::transpose(glm::dmat3(scene::viewFromWorld(*input_.camera)));
  const double tangent = std::tan(0.5 * input_.camera->verticalFovRadians);
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec3 view((corner & 1 ? 1 : -1) * tangent * input_.aspectWidthOverHeight,
                          (corner & 2 ? 1 : -1) * tangent, -1.0);
    const glm::dvec3 toCorner = worldFromView * view * (1.001 * input_.camera->nearDistance);
    if (eyeHeight + glm::dot(plane.normal, toCorner) <= slack) return false;
  }
  const scene::TriangleMesh& mesh = *input_.objects[receiver].mesh;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<glm::dvec3, 3> corners;
    std::array<double, 3> heights;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 position(mesh.positions[mesh.indices[3 * t + k]]);
      corners[k] = glm::dvec3(shape.fromObject * glm::dvec4(position, 1.0));
      heights[k] = glm::dot(plane.normal, corners[k]) - plane.offset;
    }
    if (std::ranges::min(heights) >= -slack) continue;
    // The part behind is the hull of the corners there and of where edges pass: so is its image on the plane.
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (heights[k] < 0.0) {
        const glm::dvec3 seenAt = eye + (corners[k] - eye) * (eyeHeight / (eyeHeight - heights[k]));
        if (!isInside(plane, seenAt, slack)) return false;
      }
      if ((heights[k] < 0.0) == (heights[next] < 0.0)) continue;
      const double share = heights[k] / (heights[k] - heights[next]);
      if (!isInside(plane, corners[k] + (corners[next] - corners[k]) * share, slack)) return false;
    }
  }
  return true;
}

bool Separation::cannotShadow(std::uint32_t caster, std::uint32_t receiver) {
  const PlannedObject &c = input_.objects[caster], &r = input_.objects[receiver];
  if (c.support == nullptr || r.support == nullptr || c.mesh == nullptr || r.mesh == nullptr) return false;
  if (caster == receiver) return !shadowsItself(caster);
  for (const scene::SupportingPlane& plane : body(caster).planes) {
    const double slack = rounding(caster, plane.normal) + rounding(receiver, plane.normal);
    if (lightAlong(plane.normal).low >= plane.offset - slack &&
        (reachesOnlyFrom(receiver, plane.normal, plane.offset - slack) ||
         hidesWhatIsBehind(plane, receiver, slack))) {
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
