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

/// A plane of the object, by its normal and offset alone.
scene::SupportingPlane placed(const scene::SupportingPlane& plane, const glm::dmat4& fromObject,
                              const glm::dmat3& normalFromObject) {
  const glm::dvec3 normal = glm::normalize(normalFromObject * plane.normal);
  const glm::dvec3 on(fromObject * glm::dvec4(plane.normal * plane.offset, 1.0));
  return {normal, glm::dot(normal, on), {}};
}

/// Is a point of the plane inside its outline, by at least `margin`?
bool isInside(const glm::dvec3& normal, const std::vector<glm::dvec3>& outline, const glm::dvec3& point,
              double margin) {
  double turn = 0.0;  // of the outline about the normal: a mirroring transform reverses it
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    turn += glm::dot(normal, glm::cross(outline[i] - outline[0], outline[i + 1] - outline[0]));
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3 along = outline[(i + 1) % outline.size()] - outline[i];
    const double inward = glm::dot(normal, glm::cross(along, point - outline[i]));
    if ((turn < 0.0 ? -inward : inward) < margin * glm::length(along)) return false;
  }
  return true;
}
}  // namespace

void Separation::begin(const FrameInput& input, const scene::AreaLight& light, bool anew) {
  input_ = &input;
  light_ = &light;
  lightCorners_ = lightCornersRelative(light);
  if (anew) {
    bodies_.resize(input.objects.size());
    for (Body& known : bodies_) known.forget();
    byCamera_.clear();
  }
  if (input.camera == nullptr) return;
  eye_ = input.camera->eyeWorld - light.centerWorld;
  const glm::dmat3 worldFromView = glm::transpose(glm::dmat3(scene::viewFromWorld(*input.camera)));
  const double tangent = std::tan(0.5 * input.camera->verticalFovRadians);
  for (unsigned corner = 0; corner < 4; ++corner) {
    const glm::dvec3 view((corner & 1 ? 1 : -1) * tangent * input.aspectWidthOverHeight,
                          (corner & 2 ? 1 : -1) * tangent, -1.0);
    nearCorners_[corner] = eye_ + worldFromView * view * (1.001 * input.camera->nearDistance);
  }
}

const Separation::Body& Separation::body(std::uint32_t index) {
  Body& made = bodies_[index];
  if (made.known) return made;
  const PlannedObject& object = input_->objects[index];
  made.known = true;
  made.fromObject = object.worldFromObject;
  made.fromObject[3] -= glm::dvec4(light_->centerWorld, 0.0);
  made.largestTranslation = glm::abs(glm::dvec3(object.worldFromObject[3]));
  const scene::Bounds& box = object.support->bounds;
  const auto corners = box.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    made.corners[i] = glm::dvec3(made.fromObject * glm::dvec4(corners[i], 1.0));
  }
  made.center = glm::dvec3(made.fromObject * glm::dvec4(box.center(), 1.0));
  return made;
}

const std::vector<Separation::Plane>& Separation::planes(std::uint32_t index) {
  body(index);
  Body& shape = bodies_[index];
  if (!shape.planes.empty()) return shape.planes;
  const scene::SupportingPlanes& support = *input_->objects[index].support;
  const glm::dmat3 normalFromObject = glm::transpose(glm::inverse(glm::dmat3(shape.fromObject)));
  shape.planes.reserve(support.ofFaces.size() + 6);
  const auto add = [&](const scene::SupportingPlane& plane) {
    const scene::SupportingPlane there = placed(plane, shape.fromObject, normalFromObject);
    Plane made{there.normal, there.offset, &plane};
    for (const glm::dvec3& corner : lightCorners_) {  // their centre, relative to which all is, is at 0
      made.lightReach = std::max(made.lightReach, glm::dot(made.normal, corner));
    }
    shape.planes.push_back(made);
  };
  for (const scene::SupportingPlane& plane : support.ofFaces) add(plane);
  shape.facePlanes = shape.planes.size();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 normal(0.0);
      normal[axis] = side;
      const bool known = std::ranges::any_of(
          support.ofFaces, [&](const scene::SupportingPlane& plane) { return plane.normal == normal; });
      if (known) continue;
      add({normal, side > 0.0 ? support.bounds.high[axis] : -support.bounds.low[axis], {}});
      shape.planes.back().source = nullptr;
    }
  }
  return shape.planes;
}

double Separation::rounding(std::uint32_t index, const glm::dvec3& direction) {
  const Body& shape = body(index);
  const glm::dvec3 inObject = glm::abs(glm::transpose(glm::dmat3(shape.fromObject)) * direction);
  return kFloat * (glm::dot(inObject, input_->objects[index].support->largestCoordinate) +
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
  const scene::TriangleMesh& mesh = *input_->objects[index].mesh;
  const glm::dvec3 inObject = glm::transpose(glm::dmat3(shape.fromObject)) * direction;
  const double leastInObject = least - glm::dot(direction, glm::dvec3(shape.fromObject[3]));
  if (const scene::EnclosingPoints* enclosing = input_->objects[index].enclosing) {
    const bool all = std::ranges::all_of(enclosing->points, [&](const glm::dvec3& point) {
      return glm::dot(inObject, point) >= leastInObject;
    });
    if (all || enclosing->exact) return all;
  }
  return std::ranges::all_of(mesh.indices, [&](std::uint32_t vertex) {
    return glm::dot(inObject, glm::dvec3(mesh.positions[vertex])) >= leastInObject;
  });
}

bool Separation::enclosesLight(std::uint32_t index) {
  const std::span<const Plane> ofFaces = facePlanes(index);
  return std::ranges::all_of(ofFaces, [&](const Plane& plane) {
    return plane.lightReach <= plane.offset + rounding(index, plane.normal);
  });
}

bool Separation::shadowsItself(std::uint32_t index) {
  const scene::SupportingPlanes& support = *input_->objects[index].support;
  // The part of the light behind a flat receiver's own plane is not its own doing.
  if (support.planar) return false;
  if (!support.convex) return true;
  for (const Plane& plane : facePlanes(index)) {
    const double slack = rounding(index, plane.normal);
    if (-plane.lightReach < plane.offset - slack && plane.lightReach > plane.offset + slack) return true;
  }
  if (enclosesLight(index)) return false;
  askedCamera_ = true;
  return maySeeInside(*input_, index);
}

/// Takes what of the triangle lies behind the plane into `behind_`: the part there is the hull of its corners
/// there and of where its edges pass, and so is its image on the plane, seen from anywhere before it. False
/// when an edge passes outside of the outline, which needs no camera to tell.
bool Separation::takeBehind(const Plane& plane, std::uint32_t receiver, std::size_t triangle, double slack) {
  const scene::TriangleMesh& mesh = *input_->objects[receiver].mesh;
  const glm::dmat4& fromObject = bodies_[receiver].fromObject;
  std::array<glm::dvec3, 3> corners;
  std::array<double, 3> heights;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 position(mesh.positions[mesh.indices[3 * triangle + k]]);
    corners[k] = glm::dvec3(fromObject * glm::dvec4(position, 1.0));
    heights[k] = glm::dot(plane.normal, corners[k]) - plane.offset;
  }
  if (std::ranges::min(heights) >= -slack) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (heights[k] < 0.0) behind_.push_back(corners[k]);
    if ((heights[k] < 0.0) == (heights[next] < 0.0)) continue;
    const double share = heights[k] / (heights[k] - heights[next]);
    const glm::dvec3 passes = corners[k] + (corners[next] - corners[k]) * share;
    if (!isInside(plane.normal, outline_, passes, slack)) return false;
  }
  return true;
}

/// Of the receiver's blocks of triangles those across the plane are taken, and of those behind the numbers.
/// False as with takeBehind().
bool Separation::takeAcross(const Plane& plane, std::uint32_t receiver, double slack) {
  behind_.clear();
  blocksBehind_.clear();
  constexpr std::size_t kBlock = scene::SupportingPlanes::kBlockTriangles;
  const scene::TriangleMesh& mesh = *input_->objects[receiver].mesh;
  const std::vector<scene::Bounds>& blocks = input_->objects[receiver].support->blocks;
  const glm::dmat4& fromObject = body(receiver).fromObject;
  const glm::dvec3 inObject = glm::transpose(glm::dmat3(fromObject)) * plane.normal;
  const double offset = plane.offset - glm::dot(plane.normal, glm::dvec3(fromObject[3]));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double middle = glm::dot(inObject, blocks[i].center()) - offset;
    const double half = 0.5 * glm::dot(glm::abs(inObject), blocks[i].high - blocks[i].low);
    if (middle - half >= 0.0) continue;
    if (middle + half < -slack) {
      blocksBehind_.push_back(i);
      continue;
    }
    const std::size_t end = std::min<std::size_t>((i + 1) * kBlock, mesh.triangleCount());
    for (std::size_t t = i * kBlock; t < end; ++t) {
      if (!takeBehind(plane, receiver, t, slack)) return false;
    }
  }
  return true;
}

/// What of the receiver lies behind the plane is seen only through the plane's outline.
bool Separation::hidesWhatIsBehind(std::uint32_t caster, const Plane& plane, std::uint32_t receiver,
                                   double slack) {
  if (plane.source == nullptr || plane.source->outline.empty() || input_->camera == nullptr) return false;
  const auto heightOf = [&](const glm::dvec3& point) { return glm::dot(plane.normal, point) - plane.offset; };
  // What does not come before the plane at all is another matter: hardly ever is it wholly hidden.
  if (std::ranges::all_of(body(receiver).corners, [&](const glm::dvec3& c) { return heightOf(c) <= slack; }))
    return false;
  outline_.clear();
  for (const glm::dvec3& corner : plane.source->outline) {
    outline_.emplace_back(body(caster).fromObject * glm::dvec4(corner, 1.0));
  }
  if (!takeAcross(plane, receiver, slack)) return false;
  askedCamera_ = true;
  const double eyeHeight = heightOf(eye_);
  // Nor may the near plane open what hides.
  if (eyeHeight <= slack ||
      std::ranges::any_of(nearCorners_, [&](const glm::dvec3& c) { return heightOf(c) <= slack; })) {
    return false;
  }
  const auto allHidden = [&] {
    return std::ranges::all_of(behind_, [&](const glm::dvec3& point) {
      const glm::dvec3 seenAt = eye_ + (point - eye_) * (eyeHeight / (eyeHeight - heightOf(point)));
      return isInside(plane.normal, outline_, seenAt, slack);
    });
  };
  if (!allHidden()) return false;
  constexpr std::size_t kBlock = scene::SupportingPlanes::kBlockTriangles;
  const std::size_t count = input_->objects[receiver].mesh->triangleCount();
  for (const std::size_t block : blocksBehind_) {
    behind_.clear();
    for (std::size_t t = block * kBlock; t < std::min((block + 1) * kBlock, count); ++t)
      takeBehind(plane, receiver, t, slack);
    if (!allHidden()) return false;
  }
  return true;
}

/// With all of the near plane.
bool Separation::eyeIsInside(std::uint32_t index) {
  if (input_->camera == nullptr) return false;
  askedCamera_ = true;
  return std::ranges::all_of(facePlanes(index), [&](const Plane& plane) {
    const double most = plane.offset - rounding(index, plane.normal);
    return glm::dot(plane.normal, eye_) <= most &&
           std::ranges::all_of(nearCorners_,
                               [&](const glm::dvec3& c) { return glm::dot(plane.normal, c) <= most; });
  });
}

bool Separation::cannotShadow(std::uint32_t caster, std::uint32_t receiver) {
  askedCamera_ = false;
  const bool answer = proves(caster, receiver);
  if (askedCamera_) byCamera_.push_back({caster, receiver, answer});
  return answer;
}

bool Separation::proves(std::uint32_t caster, std::uint32_t receiver) {
  const PlannedObject &c = input_->objects[caster], &r = input_->objects[receiver];
  if (c.support == nullptr || r.support == nullptr || c.mesh == nullptr || r.mesh == nullptr) return false;
  if (caster == receiver) return !shadowsItself(caster);
  for (const Plane& plane : planes(caster)) {
    // The light reaches as far to one side of its centre as to the other.
    const double slack = rounding(caster, plane.normal) + rounding(receiver, plane.normal);
    if (-plane.lightReach >= plane.offset - slack &&
        (reachesOnlyFrom(receiver, plane.normal, plane.offset - slack) ||
         hidesWhatIsBehind(caster, plane, receiver, slack))) {
      return true;
    }
  }
  for (const Plane& plane : planes(receiver)) {
    const double slack = rounding(caster, plane.normal) + rounding(receiver, plane.normal);
    if (plane.lightReach <= plane.offset + slack &&
        reachesOnlyFrom(caster, plane.normal, plane.offset - slack)) {
      return true;
    }
  }
  if (!c.support->convex || !enclosesLight(caster)) return false;
  if (c.receives && eyeIsInside(caster)) return true;
  return std::ranges::all_of(facePlanes(caster), [&](const Plane& plane) {
    const double slack = rounding(caster, plane.normal) + rounding(receiver, plane.normal);
    return reachesOnlyFrom(receiver, -plane.normal, -plane.offset - slack);
  });
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
