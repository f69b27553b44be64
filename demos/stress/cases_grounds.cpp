// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Grounds of any width, casting or not, and what else the world holds that shadows nothing in view.
#include <cmath>

#include "stress/stages.hpp"

namespace halfshadow::stress {
namespace {
using scenes::boxShape;

std::vector<Variant> farCasters(std::uint64_t seed) {
  Random random(seed + 10);
  std::vector<Variant> all;
  for (const double distance : {60.0, 1e3, 1e5}) {
    // Off to the sides on which no shadow of it meets the view.
    const double turn = random.between(-0.5, 0.5);
    const glm::dvec3 center(distance * std::cos(turn), 1.0, distance * std::sin(turn));
    all.push_back({std::to_string(static_cast<int>(distance)),
                   with(baseScene("box"), "far", boxShape(center, {1, 1, 1})), "box"});
  }
  return all;
}

std::vector<Variant> wideGrounds(std::uint64_t) {
  return {{"x10", withGround(baseScene("box-small-light"), 1200, false), "box-small-light"},
          {"x100", withGround(baseScene("box-small-light"), 12000, false), "box-small-light"},
          {"x1000", withGround(baseScene("box-small-light"), 120000, false), "box-small-light"},
          {"x100000", withGround(baseScene("box-small-light"), 1.2e7, false), "box-small-light"},
          {"figure-x1000", withGround(baseScene("figure"), 120000, false), "figure"}};
}

std::vector<Variant> castingGrounds(std::uint64_t) {
  std::vector<Variant> all;
  for (const double width : {40.0, 120.0, 141.0, 142.0, 12000.0})
    all.push_back(
        {std::to_string(static_cast<int>(width)), withGround(baseScene("box"), width, true), "box"});
  all.push_back({"figure-120", withGround(baseScene("figure"), 120, true), "figure"});
  return all;
}

std::vector<Variant> below(std::uint64_t) {
  return {{"box", with(baseScene("box"), "below", boxShape({-2, -1.5, 0}, {0.5, 0.5, 0.5})), "box"},
          {"slab", with(baseScene("box"), "below", boxShape({0, -3, 0}, {8, 0.5, 8})), "box"},
          {"deep", with(baseScene("figure"), "below", boxShape({-2, -40, 0}, {10, 1, 10})), "figure"}};
}

std::vector<Variant> coincident(std::uint64_t) {
  const SceneDescription& box = baseScene("box");
  return {{"twice", withReceiver(box, "second ground", scenes::planeShape({0, 0, 0}, 120)), "box"},
          {"smaller", withReceiver(box, "second ground", scenes::planeShape({0.3, 0, 0.2}, 30)), "box"},
          {"casting", with(box, "second ground", scenes::planeShape({0, 0, 0}, 120)), "box"}};
}

std::vector<Variant> apart(std::uint64_t) {
  std::vector<Variant> all;
  for (const double distance : {100.0, 800.0, 1000.0, 30000.0, 1e6}) {
    SceneDescription scene = withGround(baseScene("apart"), 2.5 * distance, false);
    all.push_back({std::to_string(static_cast<int>(distance)),
                   with(std::move(scene), "far", boxShape({0, 0.2, distance}, {1.0, 0.2, 1.5})), "apart"});
  }
  return all;
}

/// A triangle whose plane holds the centre of a light above the origin, over a floor.
SceneDescription edgeOnTriangle(double lightHalf) {
  scenes::Shape triangle;
  for (const glm::dvec3& corner : {glm::dvec3(0, 2, 0), glm::dvec3(0, 3, 1.5), glm::dvec3(0, 4, -0.5)})
    triangle.addVertex(corner);
  triangle.addTriangle(0, 1, 2);
  return stage({scenes::casterOf("triangle", triangle), floorObject(60)},
               lightDown({0, 10, 0}, lightHalf, lightHalf), {4, 6, 7}, {0, 0, 0});
}

std::vector<Variant> edgeOn(std::uint64_t) {
  return {{"wide-light", edgeOnTriangle(0.5), "box"}, {"wider-light", edgeOnTriangle(2.0), "box"}};
}

std::vector<Variant> unshadowed(std::uint64_t seed) {
  Random random(seed + 11);
  const scene::AreaLight above = lightDown({0, 6, 0}, 0.25, 0.25);
  // A box on a wide floor, and the camera looks past it, away from its shadow.
  const double turn = random.between(0.0, 6.28);
  const glm::dvec3 away(std::cos(turn), 0, std::sin(turn));
  const SceneDescription wide = stage({boxObject("box", {0, 0.5, 0}, {0.5, 0.5, 0.5}), floorObject(200)},
                                      above, 1.5 * away + glm::dvec3(0, 4, 0), 9.0 * away);
  return {{"wide-floor", wide},
          {"behind-the-light",
           stage({boxObject("box", {0, 8, 0}, {2, 0.5, 2}), floorObject(40)}, above, {4, 5, 6}, {0, 0, 0})},
          {"below-the-floor",
           stage({boxObject("box", {0, -2, 0}, {2, 0.5, 2}), floorObject(40)}, above, {4, 5, 6}, {0, 0, 0})},
          {"floor-alone", withGround(stage({floorObject(40)}, above, {4, 5, 6}, {0, 0, 0}), 40, true)},
          {"edge-on", edgeOnTriangle(1e-4)}};
}
}  // namespace

std::vector<Case> groundCases() {
  return {
      {"far-caster", "one more caster, far outside the view", Rule::same, farCasters},
      {"wide-ground", "the ground ten to a hundred thousand times as wide", Rule::same, wideGrounds},
      {"casting-ground", "the ground casts", Rule::same, castingGrounds},
      {"below", "a caster below the ground", Rule::same, below},
      {"coincident", "two grounds in one plane", Rule::same, coincident},
      {"apart", "two objects 100 to 1,000,000 apart on one ground", Rule::own, apart},
      {"unshadowed", "casters that can shadow nothing in view", Rule::lit, unshadowed},
      {"edge-on", "a triangle whose plane holds the light's centre", Rule::own, edgeOn},
  };
}

}  // namespace halfshadow::stress
