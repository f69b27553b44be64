// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Seen from within: closed houses and tunnels, and rooms of separate planes.
#include <cmath>

#include "stress/stages.hpp"

namespace halfshadow::stress {
namespace {
using scenes::boxShape;
using scenes::Shape;

/// Camera inside, light outside; a table inside.
SceneDescription house(const Shape& walls, const glm::dvec3& eye, const glm::dvec3& target) {
  return stage(
      {scenes::casterOf("walls", walls), boxObject("table", {0, 0.4, -1}, {0.4, 0.4, 0.4}), floorObject(40)},
      lightDown({3, 9, 4}, 0.5, 0.5), eye, target, 1.0);
}

std::vector<Variant> inside(std::uint64_t seed) {
  Random random(seed + 20);
  const glm::dvec3 eye(1.5, 1.6, 2.2), target(0, 0.6, -1);
  SceneDescription box = house(boxShape({0, 1.5, 0}, {3, 1.5, 3}), eye, target);
  const double turn = random.between(0.1, 1.4);
  const SceneDescription turned =
      house(boxShape({0, 1.5, 0}, {3, 1.5, 3}, {std::cos(turn), 0, std::sin(turn)}, {0, 1, 0}),
            {0.8, 1.6, 1.2}, target);
  return {
      {"box", box},
      {"inward", flipped(box, FlipRule::all)},
      {"turned", turned},
      {"tunnel", house(boxShape({0, 1.5, 0}, {1.5, 1.5, 40}), {0.4, 1.6, 8}, {0, 1.0, -10})},
      {"jar", house(scenes::icosphereShape({0, 1, 0}, 2.8, 3), {1.2, 1.6, 1.2}, {0, 0.3, -1})},
      {"jar-inward", flipped(house(scenes::icosphereShape({0, 1, 0}, 2.8, 3), {1.2, 1.6, 1.2}, {0, 0.3, -1}),
                             FlipRule::all)}};
}

Shape quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  Shape shape;
  for (const glm::dvec3& corner : {a, b, c, d}) shape.addVertex(corner);
  shape.addTriangle(0, 1, 2);
  shape.addTriangle(0, 2, 3);
  return shape;
}

/// Five planes, open in front; the light outside, above one wall.
SceneDescription planeRoom(double width, double height, double depth, const scene::AreaLight& light) {
  const double x = width / 2, z = depth / 2, y = height;
  const auto plane = [](const char* name, const Shape& shape) { return scenes::casterOf(name, shape); };
  return stage({plane("floor", quad({-x, 0, -z}, {-x, 0, z}, {x, 0, z}, {x, 0, -z})),
                plane("ceiling", quad({-x, y, -z}, {x, y, -z}, {x, y, z}, {-x, y, z})),
                plane("back", quad({-x, 0, -z}, {x, 0, -z}, {x, y, -z}, {-x, y, -z})),
                plane("left", quad({-x, 0, -z}, {-x, y, -z}, {-x, y, z}, {-x, 0, z})),
                plane("right", quad({x, 0, -z}, {x, 0, z}, {x, y, z}, {x, y, -z})),
                boxObject("box", {-0.3 * x, 0.25 * y, -0.3 * z}, {0.2 * x, 0.25 * y, 0.2 * z})},
               light, {0, 0.5 * height, 4.3 * z}, {0, 0.5 * height, 0});
}

std::vector<Variant> planeRooms(std::uint64_t) {
  // Aimed at the origin as c(11, 16, 8) is.
  const auto aimed = [](const glm::dvec3& center, double half) {
    return scene::areaLightAimed(center, {0, 0, 0}, 2 * half, 2 * half, {0, 1, 0}).value();
  };
  return {{"right", planeRoom(5.5, 5.5, 5.6, aimed({11, 16, 8}, 1.0)), "bars"},
          {"behind", planeRoom(4, 3, 5, aimed({-4, 11, -9}, 0.5)), "bars"},
          {"lamp", planeRoom(5.5, 5.5, 5.6, lightDown({0.4, 5.2, 0.3}, 0.4, 0.4)), "bars"}};
}

/// From inside a box without its front: nothing but what comes in through the front is lit.
std::vector<Variant> openBox(std::uint64_t) {
  Shape shape = boxShape({0, 1.7, 0}, {2, 1.5, 2});
  Shape open;
  open.positions = shape.positions;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    bool front = true;
    for (std::size_t k = 0; k < 3; ++k) front = front && shape.positions[shape.indices[i + k]].z > 1.9f;
    if (!front)
      open.indices.insert(open.indices.end(), shape.indices.begin() + static_cast<long>(i),
                          shape.indices.begin() + static_cast<long>(i) + 3);
  }
  const SceneDescription scene =
      stage({scenes::casterOf("walls", open), floorObject(40)},
            scene::areaLightAimed({3, 6, 9}, {0, 0.5, 0}, 1.0, 1.0, {0, 1, 0}).value(), {0.5, 1.5, 1.7},
            {0, 0.8, -1}, 1.2);
  return {{"outward", scene, "bars"}, {"inward", flipped(scene, FlipRule::all), "bars"}};
}

/// A closed room with the outline of an L, from the floor up.
Shape ell(double height) {
  const glm::dvec2 outline[] = {{0, 0}, {0, 3}, {-3, 3}, {-3, -3}, {3, -3}, {3, 0}};
  Shape shape;
  for (const double y : {0.0, height}) {
    for (const glm::dvec2& corner : outline) shape.addVertex({corner.x, y, corner.y});
  }
  // Every corner sees the first one, at which the L bends.
  for (std::uint32_t k = 1; k + 1 < 6; ++k) {
    shape.addTriangle(0, k + 1, k);
    shape.addTriangle(6, 6 + k, 6 + k + 1);
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    shape.addTriangle(k, next, 6 + next);
    shape.addTriangle(k, 6 + next, 6 + k);
  }
  return shape;
}

/// Light and camera inside a closed room; of the L the light sees all or turns a corner. The floor of the
/// shed goes on outside.
std::vector<Variant> lampRooms(std::uint64_t) {
  const auto room = [](const Shape& walls, const glm::dvec3& lamp, const glm::dvec3& table) {
    return stage({scenes::casterOf("walls", walls), boxObject("table", table, {0.4, 0.4, 0.4})},
                 lightDown(lamp, 0.3, 0.3), {-2.4, 1.8, 2.4}, {-1.0, 0.5, -2.0}, 1.0);
  };
  const SceneDescription bend = room(ell(3), {2.0, 2.6, -1.5}, {-1.5, 0.6, -1.0});
  SceneDescription shed = stage({scenes::casterOf("walls", boxShape({0, 1.5, 0}, {1.5, 1.6, 1.5})),
                                 boxObject("table", {0.3, 0.5, 0.2}, {0.3, 0.3, 0.3}), floorObject(40)},
                                lightDown({0, 2.6, 0}, 0.3, 0.3), {-1.2, 1.8, -1.2}, {0.5, 0.5, 0.5}, 1.0);
  return {{"ell", room(ell(3), {-1.5, 2.6, -1.0}, {-1.5, 0.6, -1.0}), "bars"},
          {"bend", bend, "bars"},
          {"bend-inward", flipped(bend, FlipRule::all), "bars"},
          {"shed", shed, "bars"},
          {"shed-inward", flipped(shed, FlipRule::all), "bars"}};
}
}  // namespace

std::vector<Case> roomCases() {
  return {
      {"inside", "the camera inside a closed house, tunnel or jar, the light outside", Rule::dark, inside},
      {"lamp-room", "light and camera inside a closed room", Rule::own, lampRooms},
      {"plane-room", "a room of separate planes, open in front", Rule::own, planeRooms},
      {"open-box", "the camera in a box without its front", Rule::own, openBox},
  };
}

}  // namespace halfshadow::stress
