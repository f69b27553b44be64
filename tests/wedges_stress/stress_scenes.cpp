// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress_scenes.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {
using scenes::Shape;

scene::SceneObject solid(const Shape& shape) {
  return scenes::casterOf("caster", shape);
}
scene::SceneObject box(const glm::dvec3& center, const glm::dvec3& half) {
  return solid(scenes::boxShape(center, half));
}
scene::Camera lookAt(const glm::dvec3& eye, const glm::dvec3& target) {
  return {.eyeWorld = eye, .targetWorld = target, .verticalFovRadians = 0.8, .nearDistance = 0.1};
}
scene::SceneDescription sceneOf(std::vector<scene::SceneObject> objects, const scene::AreaLight& light,
                                const scene::Camera& camera) {
  scene::SceneDescription scene;
  scene.objects = std::move(objects);
  scene.lights = {light};
  scene.camera = camera;
  return scene;
}
scene::SceneDescription figure(double lightHalf) {
  // Light half size in the built-in scene is 1 when asked for; the vectors scale with it.
  scene::SceneDescription scene = builtinScene("figure@light=1");
  scene.lights.front().halfU *= lightHalf;
  scene.lights.front().halfV *= lightHalf;
  return scene;
}
scene::SceneDescription placed(scene::SceneDescription scene, double scale, const glm::dvec3& shift) {
  const glm::dmat4 moved = glm::scale(glm::translate(glm::dmat4(1.0), shift), glm::dvec3(scale));
  for (scene::SceneObject& object : scene.objects) object.worldFromObject = moved * object.worldFromObject;
  for (scene::AreaLight& light : scene.lights) {
    light.centerWorld = scale * light.centerWorld + shift;
    light.halfU *= scale;
    light.halfV *= scale;
  }
  scene.camera->eyeWorld = scale * scene.camera->eyeWorld + shift;
  scene.camera->targetWorld = scale * scene.camera->targetWorld + shift;
  scene.camera->nearDistance *= scale;
  scene.camera->farDistance *= scale;
  return scene;
}

/// A quad in two triangles and its neighbour in three: a T-junction in the middle of their common edge.
Shape tJunctions() {
  Shape shape;
  for (const glm::dvec3& corner :
       {glm::dvec3(-1, 2, -1), {0, 2, -1}, {0, 2, 1}, {-1, 2, 1}, {0, 2, 0}, {1, 2, -1}, {1, 2, 1}})
    shape.addVertex(corner);
  for (const glm::uvec3& t : {glm::uvec3(0, 2, 1), {0, 3, 2}, {1, 4, 5}, {4, 6, 5}, {4, 2, 6}})
    shape.addTriangle(t.x, t.y, t.z);
  return shape;
}

Shape withSlivers(Shape shape) {
  // Degenerate and nearly degenerate triangles along edges.
  const auto count = static_cast<std::uint32_t>(shape.positions.size());
  for (std::uint32_t i = 0; i + 1 < count; i += 3) {
    const glm::dvec3 a(shape.positions[i]), b(shape.positions[i + 1]);
    const std::uint32_t middle = shape.addVertex(0.5 * (a + b) + glm::dvec3(0, 1e-7, 0));
    shape.addTriangle(i, i + 1, middle);
    shape.addTriangle(i + 1, i, middle);
  }
  return shape;
}

std::vector<StressScene> makeScenes() {
  const scene::AreaLight above = lightAbove({2, 12, 1}, 1.0, 1.0);
  // No corner of the ground lies in the plane of the eye: SwiftShader loses such triangles' varyings.
  const scene::Camera usual = lookAt({4, 6, 7.3}, {-0.5, 0.5, 0});
  const scene::SceneObject ground = groundPlane(40.0);
  std::vector<StressScene> all;
  const auto add = [&](const char* name, scene::SceneDescription scene, double allowance = 1.0,
                       bool overlapping = false) {
    all.push_back({name, std::move(scene), allowance, overlapping});
  };
  add("figure", figure(1.0), 1.0, true);
  add("tiny-light", figure(1e-4), 1.5);  // a hard edge differs by whole pixels
  add("point-light", figure(0.0), 1.5);
  // Silhouettes of the centre stand for points of the light at 40 degrees from it.
  add("huge-light", figure(8.0), 2.0, true);
  add("shifted-1e4", placed(figure(1.0), 1.0, {1e4, -1e4, 1e4}), 1.0, true);
  add("scaled-1e-3", placed(figure(1.0), 1e-3, glm::dvec3(0.0)), 1.0, true);
  add("scaled-1e3", placed(figure(1.0), 1e3, glm::dvec3(0.0)), 1.0, true);
  // The light's centre on the plane of a side and over an edge and a corner, in line with pixels' centres.
  add("center-on-edge", sceneOf({box({1, 1, 1}, {1, 1, 1}), ground}, lightAbove({0, 8, 0}, 0.5, 0.5),
                                lookAt({0, 7, 7}, {0, 0, 0})));
  add("center-over-corner",
      sceneOf({box({1, 3, 1}, {1, 0.2, 1}), box({-1, 2, -1}, {1, 0.2, 1}), ground},
              lightAbove({0, 8, 0}, 0.5, 0.5), lookAt({0, 9, 5}, {0, 0, 0})),
      1.5);
  add("edges-along-rays",
      sceneOf({box({0, 1.5, 0}, {0.02, 1.5, 0.02}), box({1, 1, 0}, {0.3, 1, 0.3}), ground},
              lightAbove({0, 8, 0}, 0.5, 0.5), lookAt({2, 5, 5}, {0, 0.5, 0})));
  // The wall's shadow spreads without end: its penumbra is where the bits of places count most.
  add("receiver-through-light-plane",
      sceneOf({box({0.5, 1, 0}, {0.4, 0.4, 0.4}), box({-2, 3, 0}, {0.1, 3, 3}), ground},
              lightAbove({0, 3, 0}, 0.5, 0.5), lookAt({5, 4, 5}, {-1, 1.5, 0})),
      1.3);
  Shape frame;
  for (const double side : {-1.0, 1.0}) {
    frame.append(scenes::boxShape({side * 1.5, 4.2, 0}, {0.2, 1.0, 1.7}));
    frame.append(scenes::boxShape({0, 4.2, side * 1.5}, {1.3, 1.0, 0.2}));
  }
  add("caster-through-light-plane",
      sceneOf({solid(frame), box({0.5, 1, 0.2}, {0.3, 0.3, 0.3}), ground}, lightAbove({0, 4, 0}, 0.4, 0.4),
              lookAt({1, 3, 8}, {0, 0.5, 0})),
      1.5);
  add("caster-behind-light", sceneOf({box({0, 8, 0}, {2, 0.5, 2}), box({0, 2, 0}, {0.5, 0.3, 0.5}), ground},
                                     lightAbove({0, 6, 0}, 0.5, 0.5), usual));
  // Nearer to the light than its own size: from elsewhere on the light its silhouette is another.
  add("caster-at-the-light",
      sceneOf({box({0.4, 5.9, 0}, {0.2, 0.05, 0.2}), ground}, lightAbove({0, 6, 0}, 0.5, 0.5),
              lookAt({4, 5, 8}, {0, 0, 0})),
      3.5);
  scene::SceneDescription inside =
      sceneOf({box({0, 4, 0}, {1, 0.2, 1}), box({2.5, 1, -4}, {0.4, 1, 0.4}), ground},
              lightAbove({0, 12, 0}, 1.0, 1.0), lookAt({0.9, 1.5, 0.5}, {1.5, 0.3, -4.0}));
  inside.camera->nearDistance = 0.5;
  add("camera-in-penumbra", inside);
  inside.camera = lookAt({0.3, 1.0, 0.5}, {1.0, 0.0, -3.0});
  inside.camera->nearDistance = 0.02;
  add("camera-in-umbra", inside);
  add("t-junctions", sceneOf({solid(tJunctions()), ground}, above, usual));
  Shape twice = scenes::boxShape({0, 2, 0}, {1, 0.3, 0.6});
  for (const std::uint32_t first : {0u, 6u, 12u})
    twice.addTriangle(twice.indices[first], twice.indices[first + 1], twice.indices[first + 2]);
  add("duplicate-faces", sceneOf({solid(twice), ground}, above, usual));
  add("slivers",
      sceneOf({solid(withSlivers(scenes::boxShape({0, 2, 0}, {1, 0.3, 0.6}))), ground}, above, usual));
  Shape mixed = tJunctions();
  std::swap(mixed.indices[1], mixed.indices[2]);
  std::swap(mixed.indices[7], mixed.indices[8]);
  add("mixed-winding", sceneOf({solid(mixed), ground}, above, usual));
  Shape bent;
  for (int i = 0; i <= 8; ++i) {
    const double turn = 3.0 * i / 8;
    for (const double z : {-1.0, 1.0}) bent.addVertex({std::cos(turn), 2.0 + 0.8 * std::sin(turn), z});
  }
  for (std::uint32_t i = 0; i < 16; i += 2) {
    bent.addTriangle(i, i + 1, i + 2);
    bent.addTriangle(i + 1, i + 3, i + 2);
  }
  add("open-sheet", sceneOf({solid(bent), ground}, above, usual));
  scene::SceneObject mirrored = solid(scenes::capsuleShape({-0.5, 1.5, 0}, {0.8, 2.2, 0.4}, 0.4));
  mirrored.worldFromObject = glm::scale(glm::dmat4(1.0), {-1.0, 1.0, 1.3});
  add("mirrored", sceneOf({mirrored, ground}, above, usual));
  std::vector<scene::SceneObject> nested;
  for (int i = 0; i < 300; ++i) {
    nested.push_back(box({0, 2.0 + 0.003 * i, 0}, {1.0, 0.001, 1.0}));
    nested.back().receives = false;
  }
  nested.push_back(ground);
  // The penumbrae of 300 casters that hide the same part of the light are no independent events: products and
  // sums grow dark.
  add("nested-300", sceneOf(nested, above, usual), 9.0);
  add("coplanar",
      sceneOf({solid(scenes::planeShape({0.13, 0, 0.21}, 2.0)), box({1, 2, 0}, {0.4, 0.1, 0.4}), ground},
              above, usual));
  add("elongated-turned",
      sceneOf({box({0, 2, 0}, {1, 0.3, 0.6}), ground}, lightAbove({1, 9, 1}, 2.0, 0.1, 0.6), usual));
  return all;
}
}  // namespace

const std::vector<StressScene>& stressScenes() {
  static const std::vector<StressScene> all = makeScenes();
  return all;
}

scene::SceneDescription lampInABall() {
  return sceneOf({solid(scenes::icosphereShape({0, 5, 0}, 0.8, 2)), box({2, 0.5, 0}, {0.3, 0.5, 0.3}),
                  groundPlane(40.0)},
                 lightAbove({0, 5, 0}, 0.2, 0.2), lookAt({-3, 5, 5}, {-3, 0, 0}));
}

scene::SceneDescription flickerScene() {
  Shape shape = scenes::capsuleShape({-0.5, 0, 0}, {0.6, 0.4, 0.2}, 0.35);
  shape.append(scenes::boxShape({0.4, -0.5, 0.3}, {0.3, 0.4, 0.2}));
  scene::SceneObject caster = solid(shape);
  caster.receives = false;
  scene::SceneDescription scene = sceneOf({caster, groundPlane(40.0)}, lightAbove({1, 9, 0}, 0.7, 0.7),
                                          lookAt({0.5, 7, 4}, {-0.3, 0, 0}));
  scene.objects[0].worldFromObject = flickerPlace(0, 1);
  return scene;
}

glm::dmat4 flickerPlace(int frame, int frames) {
  const double t = static_cast<double>(frame) / frames;
  return glm::rotate(glm::translate(glm::dmat4(1.0), {-0.4 + 0.8 * t, 2.2, 0.2 * std::sin(9.0 * t)}), 3.0 * t,
                     glm::normalize(glm::dvec3(0.3, 1.0, 0.2)));
}

}  // namespace halfshadow::test
