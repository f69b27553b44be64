// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/added_lamp.hpp"

#include <cmath>
#include <vector>

namespace halfshadow::scenes {
namespace {
/// Rays across and down the camera's view.
constexpr int kAcross = 12, kDown = 9;
/// Of the view: what a lamp must light to stay where it is.
constexpr double kEnough = 0.2;
/// Half a lamp's side over its distance.
constexpr double kHalfOfDistance = 0.1;

/// Surfaces in the camera's view, a little on its side of them.
std::vector<glm::dvec3> seenFrom(const scene::Camera& camera, const TriangleTree& tree, double farthest) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < kAcross * kDown; ++i) {
    const glm::dvec3 ray =
        scene::pixelRayWorld(camera, kAcross, kDown, i % kAcross, static_cast<double>(i / kAcross));
    const glm::dvec3 end = camera.eyeWorld + ray * farthest;
    const glm::dvec3 begin = scene::sightBegin(camera, end).value_or(camera.eyeWorld);
    const auto hit = tree.firstOn(begin, end - begin);
    if (hit.triangle == nullptr) continue;
    // Of the way in the scene: one that came from far away says nothing of it.
    points.push_back(glm::mix(begin, end, hit.share * (1.0 - 1e-4)));
  }
  return points;
}

double litShare(const std::vector<glm::dvec3>& points, const TriangleTree& tree, const glm::dvec3& lamp) {
  std::size_t lit = 0;
  for (const glm::dvec3& point : points) lit += !tree.isBetween(point, lamp);
  return points.empty() ? 1.0 : static_cast<double>(lit) / static_cast<double>(points.size());
}

glm::dvec3 middleOf(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Over a place, at shares of the way to whatever is above it.
void addAbove(const TriangleTree& tree, const glm::dvec3& place, double farthest,
              std::vector<glm::dvec3>& candidates) {
  const auto above = tree.firstOn(place, glm::dvec3(0, farthest, 0));
  const double room = above.triangle != nullptr ? above.share * farthest : farthest;
  for (const double share : {0.9, 0.75, 0.5}) candidates.push_back(place + glm::dvec3(0, share * room, 0));
}

Result<scene::AreaLight> lampAt(const glm::dvec3& center, const glm::dvec3& target) {
  const double size = 2.0 * kHalfOfDistance * glm::length(target - center);
  return scene::areaLightAimed(center, target, size, size, {0.2, 0.1, 1.0});
}
}  // namespace

Result<LampPlace> lampPlaceFor(const scene::SceneDescription& description, const TriangleTree& tree,
                               const scene::Bounds& subject) {
  const glm::dvec3 outside =
      subject.center() + 3.0 * subject.radius() * glm::normalize(glm::dvec3(0.35, 1.0, 0.3));
  glm::dvec3 best = outside, target = subject.center();
  std::string note = "the scene has no light: one was placed three radii above and beside its centre";
  if (description.camera) {
    const scene::Camera& camera = *description.camera;
    const scene::Bounds all = scene::boundsWorld(description, scene::ObjectFilter::all);
    const double reach = glm::length(camera.eyeWorld - all.center()) + 2.0 * all.radius();
    const std::vector<glm::dvec3> seen = seenFrom(camera, tree, reach);
    double share = litShare(seen, tree, outside);
    if (share < kEnough) {
      const glm::dvec3 middle = middleOf(seen);
      std::vector<glm::dvec3> candidates;
      addAbove(tree, middle, 2.0 * all.radius(), candidates);
      addAbove(tree, glm::mix(middle, camera.eyeWorld, 0.5), 2.0 * all.radius(), candidates);
      addAbove(tree, camera.eyeWorld, 2.0 * all.radius(), candidates);
      for (const glm::dvec3& candidate : candidates) {
        const double lit = litShare(seen, tree, candidate);
        if (lit <= share || glm::length(candidate - middle) < 1e-9 * all.radius()) continue;
        share = lit, best = candidate, target = middle;
        note =
            "the scene has no light, and one above it would not reach what the camera sees: one was "
            "placed over that";
      }
    }
  }
  const auto light = lampAt(best, target);
  if (!light) return light.error();
  return LampPlace{*light, std::move(note)};
}

}  // namespace halfshadow::scenes
