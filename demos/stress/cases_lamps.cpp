// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Casters beside the light, at its plane, around it, and the light inside them.
#include <cmath>
#include <numbers>

#include "stress/stages.hpp"

namespace halfshadow::stress {
namespace {
using scenes::boxShape;
using scenes::Shape;

std::vector<Variant> lampPosts(std::uint64_t) {
  std::vector<Variant> all;
  // The light of `box` is at (3, 12, 2): the post ends below, at and above it.
  for (const double height : {9.0, 11.0, 12.0, 14.0})
    all.push_back({"height-" + std::to_string(static_cast<int>(height)),
                   with(baseScene("box"), "post", boxShape({4.5, height / 2, 0}, {0.15, height / 2, 0.15})),
                   "box"});
  return all;
}

/// A tube about the y axis through `center`, open at both ends, `thick` or a sheet.
Shape tube(const glm::dvec3& center, double lowRadius, double highRadius, double height, double thick) {
  constexpr std::uint32_t kSides = 24;
  Shape shape;
  const auto ring = [&](double y, double radius) {
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / kSides;
      shape.addVertex(center + glm::dvec3(radius * std::cos(turn), y, radius * std::sin(turn)));
    }
  };
  const auto band = [&](std::uint32_t upper, std::uint32_t lower) {
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t next = (k + 1) % kSides;
      shape.addTriangle(upper * kSides + k, upper * kSides + next, lower * kSides + k);
      shape.addTriangle(upper * kSides + next, lower * kSides + next, lower * kSides + k);
    }
  };
  ring(height / 2, highRadius);
  ring(-height / 2, lowRadius);
  band(0, 1);
  if (thick > 0.0) {
    ring(-height / 2, lowRadius - thick);
    ring(height / 2, highRadius - thick);
    band(1, 2), band(2, 3), band(3, 0);
  }
  return shape;
}

std::vector<Variant> lampShades(std::uint64_t) {
  const SceneDescription& lamp = baseScene("lamp");  // the light at height 2.7, half size .2
  return {{"cone", with(lamp, "shade", tube({0, 2.65, 0}, 0.5, 0.32, 0.5, 0.0)), "lamp"},
          {"thick", with(lamp, "shade", tube({0, 2.65, 0}, 0.5, 0.35, 0.5, 0.02)), "lamp"},
          {"long", with(lamp, "shade", tube({0, 2.4, 0}, 0.45, 0.45, 1.2, 0.01)), "lamp"}};
}

std::vector<Variant> lightPlane(std::uint64_t) {
  const SceneDescription& tower = baseScene("tower");  // the light at height 3
  return {{"tower", with(tower, "tower", boxShape({1.2, 2.5, 0}, {0.3, 1.5, 0.3})), "tower"},
          {"near-tower", with(tower, "tower", boxShape({0.5, 2.5, 0.1}, {0.2, 0.9, 0.3})), "tower"},
          {"beam", with(tower, "beam", boxShape({0.0, 3.0, -0.6}, {3.0, 0.1, 0.1})), "tower"},
          {"wall", with(tower, "wall", boxShape({-1.0, 2.5, 0.0}, {0.05, 2.5, 3.0})), "tower"}};
}

std::vector<Variant> touching(std::uint64_t) {
  const SceneDescription& lamp = baseScene("lamp");
  return {{"underside", with(lamp, "housing", boxShape({0, 2.8, 0}, {0.3, 0.1, 0.3})), "lamp"},
          {"side", with(lamp, "housing", boxShape({0.3, 2.7, 0}, {0.1, 0.2, 0.3})), "lamp"},
          {"rim", with(lamp, "housing", boxShape({0.35, 2.65, 0}, {0.15, 0.3, 0.15})), "lamp"}};
}

std::vector<Variant> enclosed(std::uint64_t) {
  const SceneDescription& lamp = baseScene("lamp");
  return {{"box", with(lamp, "housing", boxShape({0, 2.7, 0}, {0.5, 0.3, 0.4}))},
          {"ball", with(lamp, "housing", scenes::icosphereShape({0, 2.7, 0}, 0.6, 2))},
          {"inward", flipped(with(lamp, "housing", boxShape({0, 2.7, 0}, {0.5, 0.3, 0.4})), FlipRule::all)},
          {"tight", with(lamp, "housing", boxShape({0, 2.7, 0}, {0.21, 0.01, 0.21}))}};
}

/// A chip so near to the light, and so small, that it hides a millionth of it.
std::vector<Variant> depthRange(std::uint64_t) {
  const SceneDescription& box = baseScene("box");
  const scene::AreaLight& light = box.lights.front();
  const glm::dvec3 aim = scene::emissionDirection(light), u = glm::normalize(light.halfU);
  const auto chip = [&](double distance) {
    const double half = distance / 3.0;
    return with(box, "chip", boxShape(light.centerWorld + distance * aim + 0.4 * u, glm::dvec3(half)));
  };
  std::vector<Variant> all{
      {"chip-1e-2", chip(1e-2), "box"}, {"chip-1e-3", chip(1e-3), "box"}, {"chip-1e-4", chip(1.2e-4), "box"}};
  SceneDescription camera = box;
  camera.camera->nearDistance = 1e-3;
  camera.camera->farDistance = 100.0;
  all.push_back({"camera", camera, "box"});
  return all;
}

std::vector<Variant> behindLight(std::uint64_t) {
  // A wall that receives, from the floor to high above the light's plane.
  SceneDescription scene = stage({boxObject("plate", {0, 4.8, 0}, {1.2, 0.05, 1.2}), floorObject(20)},
                                 lightDown({0, 6, 0}, 0.5, 0.5), {0, 6, 12}, {0, 6, -2.4}, 0.7);
  scene = withReceiver(std::move(scene), "wall", boxShape({0, 6, -2.5}, {6, 6, 0.1}));
  // The same with the light in a housing, outside of which it is dark below that plane only.
  SceneDescription housing = baseScene("lamp");
  housing = with(std::move(housing), "housing", boxShape({0, 2.7, 0}, {0.5, 0.3, 0.4}));
  housing = withReceiver(std::move(housing), "wall", boxShape({0, 6, -2.5}, {6, 6, 0.1}));
  return {{"wall", scene, "box", {}, true}, {"housing", housing, "lamp", {}, true}};
}
}  // namespace

std::vector<Case> lampCases() {
  return {
      {"lamp-post", "a post beside the light, ending below, at and above its plane", Rule::own, lampPosts},
      {"lamp-shade", "a shade around the light", Rule::own, lampShades},
      {"light-plane", "casters across the light's plane", Rule::own, lightPlane},
      {"touching", "a caster that touches the light", Rule::own, touching},
      {"enclosed", "the light inside a closed caster", Rule::dark, enclosed},
      {"depth-range", "depths from the light, or from the camera, of 1 : 100,000", Rule::own, depthRange},
      {"behind-light", "receivers beside and behind the light's plane", Rule::own, behindLight},
  };
}

}  // namespace halfshadow::stress
