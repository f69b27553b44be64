// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/light_handles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halfshadow::viewer {
namespace {
/// Length of the aim's handle: the light's distance to where it counts fully, or what is seen of its size.
double aimLength(const scene::AreaLight& light) {
  const double size = glm::length(light.halfU) + glm::length(light.halfV);
  if (light.referenceDistance > 0.0) return std::max(0.4 * light.referenceDistance, size);
  return size > 0.0 ? 2.0 * size : 1.0;
}

/// From one unit direction to another, the shortest way round.
glm::dvec3 turnedAlong(const glm::dvec3& vector, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis), cosine = glm::dot(from, to);
  if (!(sine > 1e-12)) return vector;
  const glm::dvec3 unit = axis / sine;
  return vector * cosine + glm::cross(unit, vector) * sine + unit * (glm::dot(unit, vector) * (1.0 - cosine));
}

/// How far along `axis` from `origin` the point of that line lies that is nearest to the ray.
std::optional<double> alongLine(const glm::dvec3& origin, const glm::dvec3& axis, const glm::dvec3& eye,
                                const glm::dvec3& ray) {
  const double along = glm::dot(axis, ray), denominator = 1.0 - along * along;
  if (denominator < 1e-6) return std::nullopt;  // seen end on
  const glm::dvec3 offset = eye - origin;
  return (glm::dot(offset, axis) - along * glm::dot(offset, ray)) / denominator;
}
}  // namespace

std::vector<Handle> handlesOf(const std::vector<scene::AreaLight>& lights, const ScreenSpace& screen) {
  std::vector<Handle> handles;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const scene::AreaLight& light = lights[i];
    const auto add = [&](HandleKind kind, const glm::dvec3& place) {
      if (const auto pixel = screen.fromWorld(place)) handles.push_back({i, kind, place, *pixel});
    };
    add(HandleKind::center, light.centerWorld);
    add(HandleKind::aim, light.centerWorld + aimLength(light) * scene::emissionDirection(light));
    if (light.halfU == glm::dvec3(0.0)) continue;
    add(HandleKind::sizeU, light.centerWorld + light.halfU);
    add(HandleKind::sizeV, light.centerWorld + light.halfV);
  }
  return handles;
}

std::optional<Handle> handleAt(const std::vector<Handle>& handles, const glm::dvec2& pixel, double reach) {
  std::optional<Handle> nearest;
  double best = reach;
  for (const Handle& handle : handles) {
    const double distance = glm::distance(handle.pixel, pixel);
    if (distance <= best) best = distance, nearest = handle;
  }
  return nearest;
}

scene::AreaLight dragged(const scene::AreaLight& start, const Handle& handle, const ScreenSpace& screen,
                         const glm::dvec2& pixel) {
  scene::AreaLight light = start;
  if (handle.kind == HandleKind::center || handle.kind == HandleKind::aim) {
    const auto place = screen.atDepthOf(pixel, handle.placeWorld);
    if (!place) return start;
    if (handle.kind == HandleKind::center) {
      light.centerWorld = *place;
      return light;
    }
    const glm::dvec3 aim = *place - start.centerWorld;
    if (!(glm::length(aim) > 0.0)) return start;
    const glm::dvec3 from = scene::emissionDirection(start), to = glm::normalize(aim);
    light.halfU = turnedAlong(start.halfU, from, to);
    light.halfV = turnedAlong(start.halfV, from, to);
    light.emission = to;
    return light;
  }
  glm::dvec3& side = handle.kind == HandleKind::sizeU ? light.halfU : light.halfV;
  const double length = glm::length(side);
  const auto wanted = alongLine(start.centerWorld, side / length, screen.eyeWorld(), screen.rayWorld(pixel));
  // A hundredth of what it was: a side must not vanish, nor turn the light round.
  if (wanted) side *= std::max(*wanted / length, 0.01);
  return light;
}

std::array<glm::dvec3, 4> cornersOf(const scene::AreaLight& light) {
  const glm::dvec3 &c = light.centerWorld, &u = light.halfU, &v = light.halfV;
  return {c - u - v, c + u - v, c + u + v, c - u + v};
}

namespace {
/// Based on: Rodrigues' rotation formula; `axis` is unit.
scene::AreaLight turnedAbout(const scene::AreaLight& light, const glm::dvec3& pivot, const glm::dvec3& axis,
                             double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const glm::dvec3& v) {
    return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1.0 - c));
  };
  scene::AreaLight result = light;
  result.centerWorld = pivot + turned(light.centerWorld - pivot);
  result.halfU = turned(light.halfU);
  result.halfV = turned(light.halfV);
  result.emission = turned(light.emission);
  return result;
}
}  // namespace

scene::AreaLight turnedLight(const scene::AreaLight& light, const glm::dvec3& pivot, double share) {
  return turnedAbout(light, pivot, {0, 1, 0}, 2.0 * std::numbers::pi * share);
}

scene::AreaLight swung(const scene::AreaLight& light, const glm::dvec3& pivot, const glm::dvec3& right,
                       const glm::dvec2& pixels, double height) {
  const double perPixel = std::numbers::pi / height;
  const scene::AreaLight sideways = turnedAbout(light, pivot, {0, 1, 0}, pixels.x * perPixel);
  return turnedAbout(sideways, pivot, right, pixels.y * perPixel);
}

scene::AreaLight anotherLight(const scene::AreaLight& first, const glm::dvec3& pivot) {
  return turnedLight(first, pivot, 0.25);
}

}  // namespace halfshadow::viewer
