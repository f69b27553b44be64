// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lights of any size, shape and distance, and lights that turn.
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "stress/stages.hpp"

namespace halfshadow::stress {
namespace {
std::vector<Variant> sizes(std::uint64_t) {
  std::vector<Variant> all;
  for (const double half : {0.0, 1e-4, 1e-2, 0.1, 3.0, 6.0})
    all.push_back({"figure-" + numberText(half), withLight(baseScene("figure"), half, half), "figure"});
  for (const double half : {0.0, 6.0, 40.0})
    all.push_back({"box-" + numberText(half), withLight(baseScene("box"), half, half), "box"});
  return all;
}

std::vector<Variant> shapes(std::uint64_t) {
  std::vector<Variant> all;
  for (const double aspect : {4.0, 10.0, 20.0}) {
    const double longer = std::sqrt(aspect), shorter = 1.0 / longer;
    const std::string name = numberText(aspect);
    all.push_back({"figure-" + name + ":1", withLight(baseScene("figure"), longer, shorter), "figure"});
    all.push_back({"figure-1:" + name, withLight(baseScene("figure"), shorter, longer), "figure"});
  }
  all.push_back({"box-2:.002", withLight(baseScene("box"), 2.0, 0.002), "box"});
  all.push_back({"box-.002:2", withLight(baseScene("box"), 0.002, 2.0), "box"});
  return all;
}

/// The light farther away along its direction, larger by as much.
std::vector<Variant> suns(std::uint64_t) {
  std::vector<Variant> all;
  for (const double distance : {1e3, 1e4, 1e5, 1e6, 1e7}) {
    for (const char* base : {"box", "figure"}) {
      SceneDescription scene = baseScene(base);
      scene::AreaLight& light = scene.lights.front();
      const glm::dvec3 aim(0, 1, 0);
      const double factor = distance / glm::length(light.centerWorld - aim);
      light.centerWorld = aim + (light.centerWorld - aim) * factor;
      light.halfU *= factor, light.halfV *= factor;
      all.push_back({base + std::string("-") + numberText(distance), scene, base});
    }
  }
  return all;
}

std::vector<Variant> turning(std::uint64_t) {
  constexpr int kFrames = 9;
  std::vector<Variant> all;
  for (const char* base : {"box", "leaves"}) {
    Variant variant{base, baseScene(base), base};
    for (int frame = 0; frame < kFrames; ++frame) {
      scene::AreaLight light = variant.scene.lights.front();
      const glm::dmat3 turn(
          glm::rotate(glm::dmat4(1.0), frame * 0.25 * std::numbers::pi / 180.0, glm::dvec3(0, 1, 0)));
      light.centerWorld = turn * light.centerWorld;
      light.halfU = turn * light.halfU;
      light.halfV = turn * light.halfV;
      light.emission = turn * light.emission;
      variant.frames.push_back(light);
    }
    all.push_back(std::move(variant));
  }
  return all;
}
}  // namespace

std::vector<Case> lightCases() {
  return {
      {"light-size", "lights from no size to larger than the scene", Rule::own, sizes},
      {"light-shape", "lights of aspects up to 20 : 1 and 1 : 20, and slits", Rule::own, shapes},
      {"sun", "suns as rectangles 1,000 to 10,000,000 away", Rule::own, suns},
      {"turning", "the light turns about the scene, a quarter of a degree a frame", Rule::steady, turning},
  };
}

}  // namespace halfshadow::stress
