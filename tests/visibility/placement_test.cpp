// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a mesh is made like changes nothing that is seen: its windings, where its vertices were baked, what
// ground it stands on.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/ext/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"

namespace halfshadow::test {
namespace {

const char* const kTechniques[] = {"hard",           "pcf",           "pcf-quantized", "pcss",
                                   "pcss-mip",       "shadow-volume", "wedges",        "wedges-probabilistic",
                                   "wedges-blended", "wedges-cells",  "shadow-width"};

class Placement : public SharedEngineTest {
 protected:
  Image image(const scene::SceneDescription& scene, const std::string& technique) {
    renderer().load(scene);
    return renderer().render({technique});
  }
};

/// Every second triangle of some objects, all of others.
scene::SceneDescription withOtherWindings(scene::SceneDescription scene) {
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    auto mesh = std::make_shared<scene::TriangleMesh>(*scene.objects[o].mesh);
    for (std::size_t t = 0; t < mesh->triangleCount(); t += 1 + o % 2) {
      std::swap(mesh->indices[3 * t + 1], mesh->indices[3 * t + 2]);
    }
    scene.objects[o].mesh = mesh;
  }
  return scene;
}

/// The caller's positions, moved; transforms move the other way.
scene::SceneDescription bakedAt(scene::SceneDescription scene, const glm::vec3& offset) {
  for (scene::SceneObject& object : scene.objects) {
    auto mesh = std::make_shared<scene::TriangleMesh>(*object.mesh);
    for (glm::vec3& position : mesh->positions) position += offset;
    object.mesh = mesh;
    object.worldFromObject = glm::translate(object.worldFromObject, -glm::dvec3(offset));
  }
  return scene;
}

/// Boxes with coordinates of a few bits, that single precision holds up to 2^20.
scene::SceneDescription boxes() {
  scene::SceneDescription scene{.name = "boxes"};
  for (const glm::dvec3& center :
       {glm::dvec3(0, 1, 0), glm::dvec3(1.5, 0.5, -1), glm::dvec3(-1.25, 1.75, 0.5)}) {
    scene.objects.push_back(boxObject(center, {0.5, 0.5, 0.25}));
    scene.objects.back().receives = true;
  }
  scene.objects.push_back(groundPlane(8.0));
  scene.lights = {*scene::areaLightAimed({2, 8, 3}, {0, 0, 0}, 1.0, 1.0, {0.2, 0.1, 1.0})};
  scene.camera = scene::Camera{
      .eyeWorld = {-3, 5, 6}, .targetWorld = {0, 0.5, 0}, .nearDistance = 2.0, .farDistance = 30.0};
  return scene;
}

double largestDifference(const Image& a, const Image& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.pixels(); ++i)
    largest = std::max(largest, std::abs(a.byte(i) - b.byte(i)) / 255.0);
  return largest;
}

TEST_F(Placement, WindingsChangeNothing) {
  for (const char* technique : kTechniques) {
    SCOPED_TRACE(technique);
    const scene::SceneDescription scene = boxes();
    const Image turned = image(withOtherWindings(scene), technique), straight = image(scene, technique);
    // Triangles that begin at another corner are interpolated otherwise in the last bit, which can move a tap
    // to the neighbouring texel.
    int differing = 0;
    for (std::size_t i = 0; i < turned.pixels(); ++i) differing += turned.byte(i) != straight.byte(i);
    std::printf("%-22s %d of %zu pixels differ, at most by %.4f\n", technique, differing, turned.pixels(),
                largestDifference(turned, straight));
    EXPECT_LE(differing, static_cast<int>(turned.pixels() / 1000));
  }
}

TEST_F(Placement, VerticesBakedFarAwayChangeNothing) {
  for (const char* technique : kTechniques) {
    SCOPED_TRACE(technique);
    const scene::SceneDescription scene = boxes();
    const Image here = image(scene, technique);
    // The matrices take another way to the same numbers: a rounding at an edge may differ, nothing else.
    for (const glm::vec3& offset :
         {glm::vec3(4096, 0, 0), glm::vec3(-65536, 32768, 131072), glm::vec3(1048576, 0, -524288)}) {
      const Image there = image(bakedAt(scene, offset), technique);
      std::size_t differing = 0;
      for (std::size_t i = 0; i < here.pixels(); ++i) differing += std::abs(here.byte(i) - there.byte(i)) > 2;
      EXPECT_LE(differing, 4u) << "at " << offset.x;
    }
  }
}

TEST_F(Placement, AGroundThatCastsIsLikeOneThatDoesNot) {
  for (const char* technique : {"hard", "pcf-quantized", "pcss", "pcss-mip", "vsm", "shadow-volume", "wedges",
                                "occlusion-textures", "shadow-width"}) {
    std::string reason;
    if (!supports(technique, reason)) continue;
    SCOPED_TRACE(technique);
    scene::SceneDescription scene = boxes();
    for (scene::SceneObject& object : scene.objects) object.worldFromObject[3].y += object.casts ? 0.25 : 0.0;
    const Image without = image(scene, technique);
    scene.objects.back().casts = true;
    const Image with = image(scene, technique);
    EXPECT_TRUE(std::ranges::any_of(renderer().report().skips, [](const Skip& skip) {
      return skip.why.find("nothing-beyond") != std::string::npos;
    }));
    EXPECT_LE(largestDifference(with, without), 2.0 / 255.0);
  }
}

TEST_F(Placement, AHouseSeenFromWithinIsDark) {
  for (const bool inward : {false, true}) {
    scene::SceneDescription house{.name = "house"};
    house.objects = {boxObject({0, 1.5, 0}, {3, 1.5, 3}), boxObject({0, 0.5, -1}, {0.5, 0.5, 0.5})};
    for (scene::SceneObject& object : house.objects) object.receives = true;
    if (inward) {
      auto mesh = std::make_shared<scene::TriangleMesh>(*house.objects[0].mesh);
      for (std::size_t t = 0; t < mesh->triangleCount(); ++t)
        std::swap(mesh->indices[3 * t + 1], mesh->indices[3 * t + 2]);
      house.objects[0].mesh = mesh;
    }
    house.lights = {*scene::areaLightAimed({3, 9, 4}, {0, 1, 0}, 1.0, 1.0, {0.2, 0.1, 1.0})};
    house.camera = scene::Camera{.eyeWorld = {1.5, 1.6, 2.2},
                                 .targetWorld = {0, 1.2, 0},
                                 .verticalFovRadians = 1.0,
                                 .nearDistance = 0.1,
                                 .farDistance = 20.0};
    const auto receivers = reference::traceReceivers(house, *house.camera, house.lights[0], kWidth, kHeight);
    ASSERT_TRUE(receivers.ok());
    for (const char* technique :
         {"hard", "pcf", "pcf-quantized", "pcss", "pcss-mip", "shadow-volume", "wedges", "shadow-width"}) {
      SCOPED_TRACE(std::string(technique) + (inward ? ", wound inward" : ""));
      const Image seen = image(house, technique);
      double sum = 0.0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < seen.pixels(); ++i) {
        if (receivers->kind[i] == reference::kNoReceiver) continue;
        sum += seen.byte(i) / 255.0;
        ++count;
      }
      ASSERT_GT(count, seen.pixels() / 2);
      // Without highp a receiver's place has 11 bits, too few for silhouettes that pass through its own wall:
      // a figure of record.
      const bool coarse = isForcedOff("highp") && std::string(technique) == "wedges";
      EXPECT_LE(sum / static_cast<double>(count), coarse ? 0.08 : 0.01) << "light comes in";
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
