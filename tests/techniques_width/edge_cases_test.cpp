// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Through the public interface: closed forms, lights without size, tiny and odd maps, full maps, wrong
// settings.
#include <algorithm>
#include <cmath>

#include "analytic_scenes.hpp"
#include "metrics/metrics.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {

Configuration signedWidth(std::vector<Setting> settings = {}) {
  return {"shadow-width", std::move(settings)};
}
Configuration paperWidth(std::vector<Setting> settings = {}) {
  settings.insert(settings.begin(), {"shadow-width.preset", "paper"});
  return {"shadow-width", std::move(settings)};
}

class ShadowWidthScenes : public SharedEngineTest {
 protected:
  static double rmse(const std::vector<float>& expected, const std::vector<float>& actual) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i] <= 0.005f || expected[i] >= 0.995f) continue;
      sum += std::pow(static_cast<double>(actual[i]) - expected[i], 2.0), count += 1.0;
    }
    EXPECT_GT(count, 1000.0);
    return std::sqrt(sum / count);
  }
};

TEST_F(ShadowWidthScenes, ThePlatesPenumbraIsTheClosedForm) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const std::vector<float> expected = plate.visibilityImage();
  // Through one map, where corners are as large as the penumbra.
  const double both = rmse(expected, renderer().render(signedWidth({{"sub_lights", "1"}})).visibility());
  const double straight = rmse(
      expected,
      renderer().render(signedWidth({{"shadow-width.corners", "off"}, {"sub_lights", "1"}})).visibility());
  const double paper = rmse(expected, renderer().render(paperWidth()).visibility());
  std::printf("plate: signed %.4f, straight edges %.4f, paper %.4f\n", both, straight, paper);
  // Straight edges are exact but for 8-bit distances (1/255 of the reach is about .01 of the kernel), corners
  // by the boxes; without them corners are up to .25 off.
  EXPECT_LT(both, 0.015);
  EXPECT_LT(straight, 0.06);
  EXPECT_LT(both, straight);
  // Half of the penumbra is lit and the other is up to .5 too bright: 1/sqrt(12) to .3.
  EXPECT_GT(paper, 0.18);
  EXPECT_LT(paper, 0.30);
}

TEST_F(ShadowWidthScenes, UmbraAndLitGroundAreExact) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const std::vector<float> actual = renderer().render(signedWidth()).visibility();
  const scene::Camera camera = plate.camera();
  int judged = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 ground = groundPoint(camera, kWidth, kHeight, x, y);
      const double beyondX = std::abs(ground.x) - plate.hardHalf(),
                   beyondZ = std::abs(ground.z) - plate.hardHalf();
      const double outside = std::hypot(std::max(beyondX, 0.0), std::max(beyondZ, 0.0));
      // Where the disc up to the hard shadow's edge covers the kernel's corners, and a twentieth more for the
      // steps of the stored distance.
      const double covered = 1.05 * std::sqrt(0.5) * (plate.litHalf() - plate.umbraHalf());
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      const bool umbra = -std::max(beyondX, beyondZ) > covered;
      if (!umbra && outside <= covered) continue;
      ++judged;
      ASSERT_EQ(actual[i], umbra ? 0.0f : 1.0f) << x << ", " << y;
    }
  }
  EXPECT_GT(judged, 2000);
}

TEST_F(ShadowWidthScenes, ALightWithoutSizeIsHard) {
  scene::SceneDescription scene = builtinScene("figure@light=1");
  scene.lights[0].halfU = scene.lights[0].halfV = glm::dvec3(0.0);
  renderer().load(scene);
  const Image hard = renderer().render(Configuration{"hard"});
  const Image width = renderer().render(signedWidth());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < hard.pixels(); ++i) wrong += hard.byte(i) != width.byte(i);
  EXPECT_EQ(wrong, 0u);
  // The paper's map keeps its start difference: the first texel of a shadow is between.
  const Image paper = renderer().render(paperWidth({{"shadow-width.scale", "0"}}));
  std::size_t different = 0;
  for (std::size_t i = 0; i < hard.pixels(); ++i) different += std::abs(hard.byte(i) - paper.byte(i)) > 64;
  EXPECT_LT(different, hard.pixels() / 100);
}

TEST_F(ShadowWidthScenes, WithoutCastersAllIsLit) {
  scene::SceneDescription scene = builtinScene("box@light=1");
  std::erase_if(scene.objects, [](const scene::SceneObject& object) { return object.casts; });
  renderer().load(scene);
  for (const Configuration& configuration : {signedWidth(), paperWidth()}) {
    const Image image = renderer().render(configuration);
    for (std::size_t i = 0; i < image.pixels(); ++i) ASSERT_EQ(image.byte(i), 255) << configuration.text();
  }
}

TEST_F(ShadowWidthScenes, ACasterThatFillsTheMapShadowsAll) {
  // The roof covers everything that the camera sees, and all of the map but its border.
  scene::SceneDescription scene;
  scene.objects = {boxObject({0, 3, 0}, {20, 0.05, 20}), groundPlane(4.0)};
  scene.lights = {lightAbove({0, 12, 0}, 0.5, 0.5)};
  scene.camera = cameraAbove(0, 0, 2.0);
  renderer().load(scene);
  for (const Configuration& configuration : {signedWidth(), paperWidth()}) {
    const Image image = renderer().render(configuration);
    std::size_t lit = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) lit += image.byte(i) > 1;
    EXPECT_EQ(lit, 0u) << configuration.text();
  }
}

TEST_F(ShadowWidthScenes, TinyAndOddMapsKeepTheShadow) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const std::vector<float> expected = plate.visibilityImage();
  // The plate is 11 of 16 texels wide and its kernel 1.8: half a texel of doubt about an edge is .28 of it,
  // and less in proportion on larger maps, down to the steps of 8 bits.
  const std::pair<const char*, double> kMaps[] = {
      {"16", 0.28}, {"33", 0.14}, {"64", 0.07}, {"100", 0.045}, {"300", 0.02}};
  for (const auto& [size, bound] : kMaps) {
    const double error = rmse(expected, renderer().render(signedWidth({{"map_size", size}})).visibility());
    std::printf("map_size %s: %.4f\n", size, error);
    EXPECT_LT(error, bound) << size;
    renderer().render(paperWidth({{"map_size", size}}));
  }
}

TEST_F(ShadowWidthScenes, TwoFetchesWhateverTheScene) {
  for (const char* name : {"spheres27@light=0.3", "figure@light=1"}) {
    renderer().load(builtinScene(name));
    for (const Configuration& configuration :
         {signedWidth({{"sub_lights", "1"}}), paperWidth(), paperWidth({{"shadow-width.neighbours", "3"}}),
          paperWidth({{"shadow-width.faces", "back"}})}) {
      const Image taps = renderer().render(configuration, Output::taps);
      for (std::size_t i = 0; i < taps.pixels(); ++i)
        ASSERT_LE(taps.byte(i), 2) << name << configuration.text();
    }
  }
}

// Two of the bounds, and one a sub-light; a second one where the receiver may be the caster itself.
TEST_F(ShadowWidthScenes, OneFetchASubLight) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const Image taps = renderer().render(signedWidth({{"sub_lights", "3"}}), Output::taps);
  int filtered = 0;
  for (std::size_t i = 0; i < taps.pixels(); ++i) {
    ASSERT_LE(taps.byte(i), 2 + 2 * 9);
    filtered += taps.byte(i) > 2;
  }
  EXPECT_GT(filtered, 100);
  // Most pixels are lit or in umbra, which bounds tell.
  EXPECT_LT(filtered, static_cast<int>(taps.pixels()) / 2);
}

TEST_F(ShadowWidthScenes, SubLightsKeepThePlatesPenumbra) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const std::vector<float> expected = plate.visibilityImage();
  for (const char* corners : {"auto", "off", "on"}) {
    const double error =
        rmse(expected, renderer()
                           .render(signedWidth({{"sub_lights", "3"}, {"shadow-width.corners", corners}}))
                           .visibility());
    std::printf("plate through nine sub-lights, corners %s: %.4f\n", corners, error);
    EXPECT_LT(error, 0.025) << corners;
  }
}

TEST_F(ShadowWidthScenes, SubLightsTakeNoMorePassesThanOneMap) {
  renderer().load(builtinScene("figure@light=1"));
  renderer().render(signedWidth({{"sub_lights", "1"}}));
  const std::size_t one = renderer().report().lightPasses();
  for (const char* corners : {"auto", "off", "on"}) {
    renderer().render(signedWidth({{"sub_lights", "3"}, {"shadow-width.corners", corners}}));
    EXPECT_LE(renderer().report().lightPasses(), one) << corners;
    EXPECT_EQ(renderer().report().framebufferSwitches, renderer().report().passes.size()) << corners;
  }
}

TEST_F(ShadowWidthScenes, AStillSceneMakesItsMapsOnce) {
  renderer().load(builtinScene("box@light=0.3"));
  for (const Configuration& configuration :
       {signedWidth(), paperWidth(), paperWidth({{"shadow-width.build", "cpu"}})}) {
    const Image first = renderer().render(configuration);
    const Image second = renderer().render();
    EXPECT_EQ(first.rgba, second.rgba);
    EXPECT_EQ(renderer().report().lightPasses(), 0u) << configuration.text();
    EXPECT_EQ(renderer().report().textureBytesUploaded, 0u) << configuration.text();
  }
}

TEST_F(ShadowWidthScenes, TheLookupTextureIsTheArithmetic) {
  renderer().load(builtinScene("figure@light=1"));
  const Image arithmetic = renderer().render(paperWidth());
  const Image texture = renderer().render(paperWidth({{"shadow-width.attenuation", "texture"}}));
  double sum = 0.0;
  std::size_t far = 0;
  for (std::size_t i = 0; i < arithmetic.pixels(); ++i) {
    const int difference = std::abs(arithmetic.byte(i) - texture.byte(i));
    sum += difference, far += difference > 16;
  }
  // 256 steps of depth and width: where the function is steep a step is several bytes, and few pixels lie
  // there.
  EXPECT_LT(sum / static_cast<double>(arithmetic.pixels()), 0.5);
  EXPECT_LT(far, arithmetic.pixels() / 200);
}

TEST_F(ShadowWidthScenes, SettingsOutsideTheirRangeAreRefused) {
  for (const auto& [key, value] :
       {std::pair{"shadow-width.neighbours", "4"}, std::pair{"shadow-width.start", "2"},
        std::pair{"shadow-width.start", "512"}, std::pair{"shadow-width.build", "fpga"},
        std::pair{"shadow-width.offset", "-1"}, std::pair{"shadow-width.preset", "best"}}) {
    const Outcome outcome = renderer().engine().set(key, value);
    EXPECT_FALSE(outcome.ok()) << key;
    EXPECT_NE(std::string(outcome.message).find(key), std::string::npos) << outcome.message;
  }
}

}  // namespace
}  // namespace halfshadow::test
