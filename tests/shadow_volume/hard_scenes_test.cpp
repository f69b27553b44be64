// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Shadow volumes against ray casting: they are exact, so only pixels cut by an outline may differ.
#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "hard_truth.hpp"
#include "scenes/scene_source.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {

/// The counter under test: by stencil, and by blending.
class HardScenes : public SharedEngineTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    SharedEngineTest::SetUp();
    if (std::string(GetParam()) == "stencil" && isForcedOff("packed-depth-stencil"))
      GTEST_SKIP() << "packed-depth-stencil is forced off";
  }
  static Configuration configuration() { return {"shadow-volume", {{"shadow-volume.count", GetParam()}}}; }
  static void expectExact(const std::string& name, const scene::SceneDescription& scene,
                          int surfacesInLine = 1) {
    renderer().load(scene);
    expectHard(name + "_" + GetParam(), hardTruth(scene), renderer().render(configuration()), 0,
               surfacesInLine);
  }
};

scene::SceneObject casterBox(const glm::dvec3& center, const glm::dvec3& half) {
  return scenes::casterOf("box", scenes::boxShape(center, half));
}
scene::SceneObject unseen(scene::SceneObject object) {
  object.receives = false;
  return object;
}
scene::SceneDescription sceneOf(std::vector<scene::SceneObject> objects, const scene::AreaLight& light,
                                const scene::Camera& camera) {
  scene::SceneDescription scene;
  scene.objects = std::move(objects);
  scene.lights = {light};
  scene.camera = camera;
  return scene;
}
scene::Camera lookAt(const glm::dvec3& eye, const glm::dvec3& target) {
  return {.eyeWorld = eye, .targetWorld = target, .verticalFovRadians = 0.8, .nearDistance = 0.1};
}

TEST_P(HardScenes, BuiltIn) {
  for (const char* name :
       {"box", "bars", "fence", "leaves", "figure", "spheres27", "contact", "room", "large-world", "tiny"}) {
    expectExact(name, builtinScene(name));
  }
}

TEST_P(HardScenes, MovedAndScaledWorlds) {
  const scene::SceneDescription& figure = builtinScene("figure");
  expectExact("figure_at_1e4", transformedScene(figure, 1.0, {1e4, -1e4, 1e4}));
  expectExact("figure_by_1e3", transformedScene(figure, 1e3, glm::dvec3(0.0)));
  expectExact("figure_by_1e-3", transformedScene(figure, 1e-3, glm::dvec3(0.0)));
}

TEST_P(HardScenes, CameraInsideAVolume) {
  // In the middle of the box's shadow, which the picture's sides leave.
  const scene::AreaLight light = lightAbove({0, 12, 0}, 0.3, 0.3);
  scene::SceneDescription scene =
      sceneOf({casterBox({0, 4, 0}, {1, 0.2, 1}), casterBox({2.5, 1, -4}, {0.4, 1, 0.4}), groundPlane(60.0)},
              light, lookAt({0.3, 1.5, 0.5}, {1.0, 0.5, -4.0}));
  expectExact("camera_inside", scene);
  // Out of it, past casters.
  scene.camera = lookAt({0.3, 1.5, 2.0}, {2.5, 2.2, -4.0});
  expectExact("camera_inside_out", scene);
  // Through a closed caster: its inner faces are seen, and the world through the hole that the near plane
  // cuts.
  scene.camera = lookAt({0.3, 4.15, 1.02}, {0.3, 0.0, -3.0});
  scene.camera->nearDistance = 0.3;
  expectExact("near_plane_through_caster", scene);
}

TEST_P(HardScenes, MoreNestedVolumesThanACounterHolds) {
  // Sheets of paper in a pile: 300, and exactly 256, which wraps to none.
  for (const int sheets : {256, 300}) {
    std::vector<scene::SceneObject> objects;
    for (int i = 0; i < sheets; ++i) {
      objects.push_back(casterBox({0, 3.0 + 0.01 * i, 0}, {1.0, 0.002, 1.0}));
      objects.back().receives = false;  // finer than pixels
    }
    objects.push_back(groundPlane(60.0));
    const scene::AreaLight light = lightAbove({3, 14, 0}, 0.3, 0.3);
    expectExact("nested_" + std::to_string(sheets), sceneOf(objects, light, lookAt({0, 6, 9}, {-1, 0.5, 0})),
                sheets);
    expectExact("nested_inside_" + std::to_string(sheets),
                sceneOf(objects, light, lookAt({-1, 0.8, 0.5}, {-1, 0.4, -4})), sheets);
    // The same as one caster, and as one connected caster.
    scenes::Shape pile, screw;
    for (int i = 0; i < sheets; ++i) pile.append(scenes::boxShape({0, 3.0 + 0.01 * i, 0}, {1.0, 0.002, 1.0}));
    expectExact("pile_" + std::to_string(sheets),
                sceneOf({unseen(scenes::casterOf("pile", pile)), groundPlane(60.0)}, light,
                        lookAt({0, 6, 9}, {-1, 0.5, 0})),
                sheets);
    constexpr int kSteps = 8;
    for (int i = 0; i <= sheets * kSteps; ++i) {
      const double turn = 2.0 * 3.14159265358979 * i / kSteps, y = 3.0 + 0.01 * i / kSteps;
      screw.addVertex({0.2 * std::cos(turn), y, 0.2 * std::sin(turn)});
      screw.addVertex({std::cos(turn), y, std::sin(turn)});
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sheets * kSteps); ++i) {
      screw.addTriangle(2 * i, 2 * i + 1, 2 * i + 2);
      screw.addTriangle(2 * i + 1, 2 * i + 3, 2 * i + 2);
    }
    expectExact("screw_" + std::to_string(sheets),
                sceneOf({unseen(scenes::casterOf("screw", screw)), groundPlane(60.0)}, light,
                        lookAt({0, 6, 9}, {-1, 0.5, 0})),
                sheets);
  }
}

TEST_P(HardScenes, OpenSheetsFromBothSides) {
  scenes::Shape sheet;
  for (const glm::dvec3& corner : {glm::dvec3(-1, 2, -1), {1, 2.4, -1}, {1, 2, 1}, {-1, 2.4, 1}})
    sheet.addVertex(corner);
  sheet.addTriangle(0, 2, 1);
  sheet.addTriangle(0, 3, 2);
  scenes::Shape turned = sheet;
  std::swap(turned.indices[1], turned.indices[2]);
  std::swap(turned.indices[4], turned.indices[5]);
  scenes::Shape inconsistent = sheet;
  std::swap(inconsistent.indices[1], inconsistent.indices[2]);
  const scene::AreaLight light = lightAbove({2, 12, 1}, 0.3, 0.3);
  for (const auto& [name, shape] :
       {std::pair{"sheet", &sheet}, {"turned", &turned}, {"mixed", &inconsistent}}) {
    const auto caster = scenes::casterOf(name, *shape);
    expectExact(name, sceneOf({caster, groundPlane(60.0)}, light, lookAt({3, 5, 5}, {0, 1, 0})));
    expectExact(std::string(name) + "_below",
                sceneOf({caster, groundPlane(60.0)}, light, lookAt({-0.3, 1.2, 0.3}, {0.2, 0.1, -2.0})));
  }
}

TEST_P(HardScenes, EdgesOfThreeFacesAndDuplicates) {
  // A fin on a plate: three faces share an edge; and one face twice.
  scenes::Shape shape;
  for (const glm::dvec3& corner :
       {glm::dvec3(-1, 2, 0), {1, 2, 0}, {0, 2, 1.2}, {0, 2, -1.2}, {0, 3.2, 0}, {0.5, 1.2, 0.6}})
    shape.addVertex(corner);
  shape.addTriangle(0, 2, 1);
  shape.addTriangle(0, 1, 3);
  shape.addTriangle(0, 1, 4);
  shape.addTriangle(1, 0, 5);
  shape.addTriangle(0, 4, 1);
  const scene::AreaLight light = lightAbove({4, 10, 3}, 0.3, 0.3);
  expectExact("fin", sceneOf({scenes::casterOf("fin", shape), groundPlane(60.0)}, light,
                             lookAt({3, 6, 6}, {-0.5, 0.8, 0})));
}

TEST_P(HardScenes, MirroredAndInsideOutCasters) {
  scenes::Shape shape = scenes::capsuleShape({-0.5, 1.5, 0}, {0.8, 2.2, 0.4}, 0.4);
  shape.append(scenes::boxShape({1.0, 1.0, -1.0}, {0.3, 0.5, 0.4}));
  scene::SceneObject mirrored = scenes::casterOf("mirrored", shape);
  mirrored.worldFromObject = glm::scale(glm::dmat4(1.0), {-1.0, 1.0, 1.3});
  const scene::AreaLight light = lightAbove({4, 10, 3}, 0.3, 0.3);
  expectExact("mirrored", sceneOf({mirrored, groundPlane(60.0)}, light, lookAt({3, 5, 6}, {-0.5, 0.8, 0})));
  expectExact("mirrored_below",
              sceneOf({mirrored, groundPlane(60.0)}, light, lookAt({-0.6, 0.5, 0.1}, {-1.6, 0.0, -1.5})));
}

TEST_P(HardScenes, LightInsideAClosedCasterShadowsEverythingOutside) {
  const scene::AreaLight light = lightAbove({0, 2, 0}, 0.1, 0.1);
  scene::SceneDescription scene =
      sceneOf({scenes::casterOf("ball", scenes::icosphereShape({0, 2, 0}, 0.8, 2)),
               casterBox({2, 0.5, 0}, {0.3, 0.5, 0.3}), groundPlane(60.0)},
              light, lookAt({1, 4, 7}, {0, 1, 0}));
  renderer().load(scene);
  const Image image = renderer().render(configuration());
  const HardTruth truth = hardTruth(scene);
  int shadowed = 0, receivers = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    receivers += truth.receiver[i];
    shadowed += truth.receiver[i] != 0 && image.byte(i) == 0;
  }
  EXPECT_GT(receivers, 4000);
  EXPECT_GE(shadowed, receivers - allowedSlivers());
  // From inside its walls are lit.
  scene.camera = lookAt({0.2, 2.1, 0.3}, {0.5, 1.0, -2.0});
  expectExact("inside_the_ball", scene);
}

TEST_P(HardScenes, CastersBesideAndBehindTheLight) {
  const scene::AreaLight light = lightAbove({0, 4, 0}, 0.3, 0.3);
  expectExact("caster_behind", sceneOf({casterBox({0, 6, 0}, {1, 0.5, 1}),
                                        casterBox({1, 1, 0}, {0.3, 0.3, 0.3}), groundPlane(30.0)},
                                       light, lookAt({2, 5, 7}, {0, 1, 0})));
  // Through the plane of the light, around it.
  scenes::Shape frame;
  for (const double side : {-1.0, 1.0}) {
    frame.append(scenes::boxShape({side * 1.5, 4.2, 0}, {0.2, 1.0, 1.7}));
    frame.append(scenes::boxShape({0, 4.2, side * 1.5}, {1.3, 1.0, 0.2}));
  }
  expectExact("caster_through_plane", sceneOf({scenes::casterOf("frame", frame), groundPlane(30.0)}, light,
                                              lookAt({2, 3, 8}, {0, 1, 0})));
}

TEST_P(HardScenes, CasterInThePlaneOfItsReceiver) {
  // A card on the floor, in the same plane: lit all over from above, whatever depth wins.
  scene::SceneDescription scene = sceneOf({scenes::casterOf("card", scenes::planeShape({0.13, 0, 0.21}, 2.0)),
                                           casterBox({2, 1, 0}, {0.3, 0.3, 0.3}), groundPlane(17.3)},
                                          lightAbove({3, 9, 2}, 0.3, 0.3), lookAt({1, 4, 5}, {0, 0, 0}));
  for (const glm::dvec3& eye : {glm::dvec3(1, 4, 5), {-6, 0.7, 3}, {0.1, 6, 0.2}}) {
    scene.camera->eyeWorld = eye;
    renderer().load(scene);
    const HardTruth truth = hardTruth(scene);
    const Image image = renderer().render(configuration());
    int wrong = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      // The truth's own rays start above the card, so it is right about the floor beside it only; what it
      // calls lit for certain must be.
      wrong += truth.certain[i] != 0 && truth.lit[i] != 0 && image.byte(i) == 0;
    }
    EXPECT_EQ(wrong, 0) << eye.x;
  }
  // The eye in the volume of the card: depth-fail with caps. Below the card lies nothing to be shadowed.
  scene.camera = lookAt({0.2, 0.4, 0.3}, {0.1, 0.0, -0.4});
  scene.camera->nearDistance = 0.5;
  renderer().load(scene);
  const Image image = renderer().render(configuration());
  int dark = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) dark += image.byte(i) == 0;
  EXPECT_EQ(dark, 0);
}

TEST_P(HardScenes, SeveralLightsOneChannelEach) {
  scene::SceneDescription scene = builtinScene("figure");
  scene::AreaLight second = scene.lights.front(), third = second;
  second.centerWorld += glm::dvec3(-9, -2, 5);
  third.centerWorld += glm::dvec3(3, 2, -7);
  scene.lights.push_back(second);
  scene.lights.push_back(third);
  renderer().load(scene);
  const Image image = renderer().render(configuration());
  for (int i = 0; i < 3; ++i) {
    expectHard("light_" + std::to_string(i) + "_" + GetParam(), hardTruth(scene, static_cast<std::size_t>(i)),
               image, i);
  }
}

TEST_P(HardScenes, RealModels) {
  for (const char* name : {"cat", "CesiumMan", "low-poly-tree", "terrain"}) {
    const std::string path = std::string(HALFSHADOW_SHARED_DIR) + "/scenes/" + name + ".glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
    const auto opened = scenes::openScene(path, {});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    expectExact(name, *opened);
  }
}

INSTANTIATE_TEST_SUITE_P(Counters, HardScenes, testing::Values("stencil", "blend"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace halfshadow::test
