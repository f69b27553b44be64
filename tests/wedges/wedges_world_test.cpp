// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What else the world holds changes no penumbra: wide grounds, far casters, a light's distance, seams of a
// mesh, a floor that is there twice.
#include <algorithm>
#include <cmath>
#include <ostream>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "scenes/shapes.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

struct Tested {
  std::string technique, route;
};
void PrintTo(const Tested& tested, std::ostream* stream) {
  *stream << tested.technique << " " << tested.route;
}

class WedgesWorld : public SharedEngineTest, public testing::WithParamInterface<Tested> {
 protected:
  void SetUp() override {
    SharedEngineTest::SetUp();
    if (isForcedOff("highp")) GTEST_SKIP() << "highp is forced off: positions have 11 bits";
  }
  static Image image(const scene::SceneDescription& scene) {
    Configuration configuration{GetParam().technique, {}};
    if (!GetParam().route.empty())
      configuration.settings = {{GetParam().technique + ".route", GetParam().route}};
    renderer().load(scene);
    return renderer().render(configuration);
  }
  /// Pixels that differ by more than one of 255: a sum is rounded to a 512th a piece.
  static int differing(const Image& a, const Image& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) count += std::abs(a.byte(i) - b.byte(i)) > 1;
    return count;
  }
  static int offTheClosedForm(const Image& picture, const PlateOverGround& plate) {
    const std::vector<float> truth = plate.visibilityImage(), seen = picture.visibility();
    int count = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) count += std::abs(seen[i] - truth[i]) > 3.0f / 255.0f;
    return count;
  }
};

TEST_P(WedgesWorld, WideGroundsChangeNothing) {
  for (const double lightHalf : {1.0, 0.02}) {
    const PlateOverGround plate{.lightHalf = lightHalf};
    scene::SceneDescription scene = plate.scene();
    const Image usual = image(scene);
    // Under the small light the plate's thickness is a part of its penumbra's width.
    if (lightHalf == 1.0) EXPECT_EQ(offTheClosedForm(usual, plate), 0);
    for (const double half : {28.4, 2e3, 2e4, 2e6}) {
      scene.objects[1] = groundPlane(half);
      EXPECT_LE(differing(image(scene), usual), half > 1e5 ? 100 : 4) << half << ", light " << lightHalf;
    }
  }
}

TEST_P(WedgesWorld, FarCastersChangeNothing) {
  for (const double lightHalf : {1.0, 0.02}) {
    const PlateOverGround plate{.lightHalf = lightHalf};
    scene::SceneDescription scene = plate.scene();
    const Image alone = image(scene);
    for (const double away : {1e2, 1e3, 1e5, 1e7}) {
      scene.objects.resize(2);
      scene.objects.push_back(boxObject({away, 1.0, 0.3 * away}, {1.0, 1.0, 1.0}));
      EXPECT_LE(differing(image(scene), alone), 4) << away << ", light " << lightHalf;
    }
  }
}

TEST_P(WedgesWorld, SunsAreRightAtAnyDistance) {
  for (const double distance : {30.0, 1e3, 1e4, 1e5, 1e6, 1e7}) {
    const PlateOverGround plate{.lightHeight = distance, .lightHalf = 0.1 * distance};
    EXPECT_LE(offTheClosedForm(image(plate.scene()), plate), 4) << distance;
  }
}

TEST_P(WedgesWorld, AFloorThatIsThereTwiceIsOne) {
  const PlateOverGround plate;
  scene::SceneDescription scene = plate.scene();
  const Image once = image(scene);
  scene.objects.push_back(scene.objects[1]);
  EXPECT_LE(differing(image(scene), once), 4);
  // Other triangles, another size.
  scene.objects[2] = groundPlane(7.0);
  EXPECT_LE(differing(image(scene), once), 4);
  scenes::Shape tiles;
  for (int k = 0; k < 2; ++k) {
    const scenes::Shape plane = scenes::planeShape(glm::dvec3(0.0), 8.0 + k);
    for (const std::uint32_t i : plane.indices)
      tiles.indices.push_back(i + static_cast<std::uint32_t>(tiles.positions.size()));
    tiles.positions.insert(tiles.positions.end(), plane.positions.begin(), plane.positions.end());
  }
  scene.objects.resize(2);
  scene.objects[1] = scenes::casterOf("twice", tiles);
  scene.objects[1].casts = false;
  EXPECT_LE(differing(image(scene), once), 4) << "in one mesh";
}

/// The object as two, of every other triangle: no seam stays whole.
void splitObject(scene::SceneDescription& scene, std::size_t index) {
  const scene::SceneObject whole = scene.objects[index];
  scene.objects.erase(scene.objects.begin() + static_cast<std::ptrdiff_t>(index));
  for (std::uint32_t half = 0; half < 2; ++half) {
    scenes::Shape shape;
    shape.positions = whole.mesh->positions;
    for (std::uint32_t t = half; t < whole.mesh->triangleCount(); t += 2) {
      for (std::uint32_t k = 0; k < 3; ++k) shape.indices.push_back(whole.mesh->indices[3 * t + k]);
    }
    scene::SceneObject piece = scenes::casterOf("piece", shape);
    piece.worldFromObject = whole.worldFromObject;
    piece.casts = whole.casts, piece.receives = whole.receives;
    scene.objects.push_back(piece);
  }
}

TEST_P(WedgesWorld, PiecesOfOneThingCastAsTheThing) {
  scene::SceneDescription scene = builtinScene("figure@light=0.3");
  const Image whole = image(scene);
  const std::size_t count = scene.objects.size();
  for (std::size_t i = 0; i < count; ++i) {
    // Those that stand before the ones already split.
    std::size_t first = 0;
    while (first < scene.objects.size() &&
           (scene.objects[first].name == "piece" || !scene.objects[first].casts))
      ++first;
    if (first < scene.objects.size()) splitObject(scene, first);
  }
  ASSERT_GT(scene.objects.size(), count + 5);
  // The halves' own surfaces are receivers of many triangles or of few, as they were not before.
  const Truth& truth = truthOf("figure@light=0.3");
  const Image split = image(scene);
  int ground = 0, onGround = 0, onCasters = 0;
  for (std::size_t i = 0; i < split.pixels(); ++i) {
    if (truth.kind[i] == reference::kNoReceiver || !truth.interior[i]) continue;
    const bool differs = std::abs(split.byte(i) - whole.byte(i)) > 1;
    const bool isGround = truth.kind[i] == reference::kGroundReceiver;
    ground += isGround, onGround += isGround && differs, onCasters += !isGround && differs;
  }
  EXPECT_GT(ground, 20000);
  EXPECT_LE(onGround, 10);
  EXPECT_LE(onCasters, 20);
}

/// A rectangle that casts and receives: a corner and two sides, turned towards their cross product.
scene::SceneObject wall(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
  scenes::Shape shape;
  for (const glm::dvec3& p : {corner, corner + u, corner + u + v, corner + v}) shape.addVertex(p);
  shape.addTriangle(0, 1, 2);
  shape.addTriangle(0, 2, 3);
  return scenes::casterOf("wall", shape);
}

TEST_P(WedgesWorld, RoomsOfSingleWallsAreLitThroughTheirOpenings) {
  // Open towards +z, where the camera stands; the light shines in from outside, over the right wall and the
  // ceiling, which hide it from most of the room. Their inner faces, turned away from it, are not looked at.
  scene::SceneDescription scene{.name = "room"};
  scene.objects = {wall({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), wall({-2, 0, -2}, {4, 0, 0}, {0, 4, 0}),
                   wall({-2, 0, -2}, {0, 4, 0}, {0, 0, 4}), wall({2, 0, -2}, {0, 0, 4}, {0, 4, 0}),
                   wall({-2, 4, -2}, {4, 0, 0}, {0, 0, 4})};
  scene.objects.push_back(boxObject({-0.9, 0.6, -0.3}, {0.5, 0.6, 0.5}));
  scene.objects.back().receives = true;
  scene.camera = scene::Camera{.eyeWorld = {1.5, 3.0, 6.0},
                               .targetWorld = {-1.2, 0.6, -0.8},
                               .verticalFovRadians = 0.5,
                               .nearDistance = 0.1,
                               .farDistance = 100.0};
  for (const glm::dvec3& from : {glm::dvec3(5, 6, 7), glm::dvec3(1, 3, 9), glm::dvec3(8, 3, 6)}) {
    const auto light = scene::areaLightAimed(from, {-0.5, 1, 0}, 0.01, 0.01, {0, 1, 0});
    ASSERT_TRUE(light);
    scene.lights = {*light};
    const Image seen = image(scene);
    // So small a light shadows as its centre does, which volumes count exactly.
    const Image hard = renderer().render(Configuration{"shadow-volume", {}});
    int wrong = 0, dark = 0, lit = 0;
    for (std::size_t i = 0; i < hard.pixels(); ++i) {
      wrong += std::abs(seen.byte(i) - hard.byte(i)) > 160;
      dark += hard.byte(i) == 0, lit += hard.byte(i) == 255;
    }
    EXPECT_GT(dark, 200);
    EXPECT_GT(lit, 500);
    // Outlines and edges between walls: a pixel's middle lies on either side.
    EXPECT_LE(wrong, 80) << from.x;
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, WedgesWorld,
                         testing::Values(Tested{"wedges", "screen"}, Tested{"wedges", "receivers"},
                                         Tested{"wedges", "auto"}, Tested{"wedges-probabilistic", "auto"},
                                         Tested{"wedges-blended", ""}),
                         [](const auto& tested) {
                           std::string name = tested.param.technique + "_" + tested.param.route;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace halfshadow::test
