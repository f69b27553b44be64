// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Scenes whose visibility is known on paper.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "analytic_scenes.hpp"
#include "metrics/metrics.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

struct Method {
  std::string name;
  Configuration configuration;
  bool softWithLight = false;  ///< its penumbra is as wide as the light makes it
  double reachTexels = 1.0;    ///< how far beyond the hard edge its filter may reach (fixed kernels)
  double step = 0.0;           ///< least difference between two of its values
};
void PrintTo(const Method& method, std::ostream* stream) {
  *stream << method.configuration.text();
}

const Method kHard{"hard", {"hard"}, false, 1.0, 1.0};
const std::vector<Method> kMethods = {
    kHard,
    {"pcf", {"pcf", {{"pcf.size", "7"}}}, false, 4.5, 1.0 / 49},
    {"pcf_poisson", {"pcf", {{"pcf.size", "9"}, {"pcf.pattern", "poisson"}}}, false, 6.5, 1.0 / 16},
    {"pcf_masked", {"pcf-masked", {{"pcf-masked.size", "7"}}}, false, 4.5, 1.0 / 49},
    {"pcf_quantized", {"pcf-quantized"}, true, 0.0, 1.0 / 9},
    {"pcss", {"pcss"}, true, 0.0, 1.0 / 49},
    {"pcss_mip", {"pcss-mip"}, true, 0.0, 1.0 / 49},
    {"sampled", {"sampled"}, true, 0.0, 1.0 / 64},
};
std::vector<Method> softMethods() {
  std::vector<Method> soft;
  std::ranges::copy_if(kMethods, std::back_inserter(soft), &Method::softWithLight);
  return soft;
}
const auto kName = [](const auto& tested) { return tested.param.name; };

/// Widest extent of the map's texel on the ground of PlateOverGround: the plate's view over 1024 texels.
double plateTexelWorld(const PlateOverGround& plate) {
  return 2.2 * plate.hardHalf() / 1024.0;
}

class Analytic : public SharedEngineTest, public testing::WithParamInterface<Method> {
 protected:
  static void saveUnlessPassed(const std::string& name, const std::vector<float>& expected,
                               const Image& image) {
    if (!HasFailure()) return;
    std::printf("%s\n", saveComparison(name + "_" + GetParam().name, image.width, image.height, expected,
                                       image.visibility())
                            .c_str());
  }
};
class AnalyticSoft : public Analytic {};
class AnalyticEngine : public SharedEngineTest {};
class FourLights : public SharedEngineTest {};

TEST_P(Analytic, PlateHasExactUmbraAndExactLight) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const Image image = renderer().render(GetParam().configuration);
  const scene::Camera camera = plate.camera();
  // Methods that know the light stay within its penumbra, a kernel's worth of texels and one pixel; the
  // others within their own reach around the hard edge.
  const double margin = plate.pixelWorld() + (GetParam().reachTexels + 3.0) * plateTexelWorld(plate);
  const double umbra = (GetParam().softWithLight ? plate.umbraHalf() : plate.hardHalf()) - margin;
  const double lit = (GetParam().softWithLight ? plate.litHalf() : plate.hardHalf()) + margin;
  int umbraPixels = 0, litPixels = 0, wrongUmbra = 0, wrongLit = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 ground = groundPoint(camera, kWidth, kHeight, x, y);
      const double distance = std::max(std::abs(ground.x), std::abs(ground.z));
      const std::uint8_t value = image.byte(static_cast<std::size_t>(y * kWidth + x));
      if (distance < umbra) ++umbraPixels, wrongUmbra += value != 0;
      if (distance > lit) ++litPixels, wrongLit += value != 255;
    }
  }
  EXPECT_GE(umbraPixels, 3000);
  EXPECT_GE(litPixels, 3000);
  EXPECT_EQ(wrongUmbra, 0) << "of " << umbraPixels;
  EXPECT_EQ(wrongLit, 0) << "of " << litPixels;
  saveUnlessPassed("plate", plate.visibilityImage(), image);
}

TEST_P(AnalyticSoft, StraightEdgeIsMonotoneAndFollowsTheClosedForm) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const Image image = renderer().render(GetParam().configuration);
  const scene::Camera camera = plate.camera();
  const int row = kHeight / 2;
  double squares = 0.0, measuredWidth = 0.0, exactWidth = 0.0;
  int pixels = 0;
  float before = 0.0f;
  for (int x = kWidth / 2; x < kWidth; ++x) {
    const double exact = plate.visibility(groundPoint(camera, kWidth, kHeight, x, row));
    const float value = static_cast<float>(image.byte(static_cast<std::size_t>(row * kWidth + x))) / 255.0f;
    // A step backwards of one of the method's own steps, and one of storage: taps move across the edge one by
    // one.
    EXPECT_GE(value, before - GetParam().step - 1.01 / 255.0) << "at x = " << x;
    before = value;
    // Between .1 and .9 the exact ramp is linear: the number of pixels there is the penumbra's width.
    measuredWidth += value > 0.1f && value < 0.9f;
    exactWidth += exact > 0.1 && exact < 0.9;
    if (exact > 0.005 && exact < 0.995) squares += (value - exact) * (value - exact), ++pixels;
  }
  const double rmse = std::sqrt(squares / pixels);
  std::printf("%-14s straight edge: rmse %.4f, width %.0f of %.0f pixels\n", GetParam().name.c_str(), rmse,
              measuredWidth, exactWidth);
  EXPECT_GE(exactWidth, 12.0) << "too few pixels to measure a width";
  // One occluder, one height, a straight edge: nothing but taps, bands and storage stand between method and
  // truth. pcf-quantized rounds widths to bands half an octave apart, 19 % to either side.
  const bool bands = GetParam().name == "pcf_quantized";
  EXPECT_NEAR(measuredWidth, exactWidth, (bands ? 0.25 : 0.12) * exactWidth + 1.0);
  EXPECT_LE(rmse, bands ? 0.096 : 0.05);
  saveUnlessPassed("straight_edge", plate.visibilityImage(), image);
}

TEST_P(AnalyticSoft, LightOfNoSizeGivesHardShadows) {
  for (const char* name : {"figure@light=0", "bars@light=0"}) {
    renderer().load(builtinScene(name));
    const Image hard = renderer().render(kHard.configuration);
    const Image image = renderer().render(GetParam().configuration);
    int differing = 0, partial = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      differing += image.byte(i) != hard.byte(i);
      partial += image.byte(i) != 0 && image.byte(i) != 255;
    }
    std::printf("%-14s %s: %d pixels differ from hard, %d partial\n", GetParam().name.c_str(), name,
                differing, partial);
    // Kernels of a single texel still average their taps inside it: 1 pixel in 100, along edges.
    EXPECT_LE(differing, kWidth * kHeight / 100) << name;
    saveUnlessPassed(std::string("point_light_") + name, hard.visibility(), image);
  }
}

TEST_P(AnalyticSoft, ShrinkingLightConvergesToHardShadows) {
  PlateOverGround plate{.lightHalf = 0.002};
  renderer().load(plate.scene());
  const Image hard = renderer().render(kHard.configuration);
  const Image image = renderer().render(GetParam().configuration);
  const scene::Camera camera = plate.camera();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 ground = groundPoint(camera, kWidth, kHeight, x, y);
      const double distance = std::abs(std::max(std::abs(ground.x), std::abs(ground.z)) - plate.hardHalf());
      // The penumbra is .0013 wide, a texel .005, a pixel .037: only pixels at the edge itself may differ.
      if (distance < plate.pixelWorld() + 2.0 * plateTexelWorld(plate)) continue;
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      ASSERT_EQ(image.byte(i), hard.byte(i)) << "pixel " << x << ", " << y;
    }
  }
}

TEST_P(Analytic, ReceiversOutsideTheMapAreLit) {
  PlateOverGround plate;
  renderer().load(plate.scene());
  const scene::Camera wide =
      cameraAbove(0.0, 0.0, 14.0);  // the ground's edge and the clear colour beyond it too
  renderer().desc().camera = cameraDesc(wide);
  const Image image = renderer().render(GetParam().configuration);
  int judged = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 ground = groundPoint(wide, kWidth, kHeight, x, y);
      if (std::max(std::abs(ground.x), std::abs(ground.z)) < plate.litHalf() + 0.5) continue;
      ++judged;
      ASSERT_EQ(image.byte(static_cast<std::size_t>(y * kWidth + x)), 255) << "pixel " << x << ", " << y;
    }
  }
  EXPECT_GE(judged, kWidth * kHeight / 2);
}

// A wall that crosses the light's plane: below it lies the shadow of a plate, above it nothing is asked of
// the light.
TEST_P(Analytic, ReceiversInAndBehindTheLightsPlaneAreLit) {
  scene::SceneDescription scene;
  scene.objects = {boxObject({0, 4.8, 0}, {1.2, 0.05, 1.2}), groundPlane(10.0)};
  scene::SceneObject wall = boxObject({0, 6, -2.5}, {6, 6, 0.1});
  wall.receives = true;
  wall.casts = false;
  scene.objects.push_back(wall);
  const scene::AreaLight light = lightAbove({0, 6, 0}, 0.5, 0.5);
  scene.lights = {light};
  scene.camera =
      scene::Camera{.eyeWorld = {0, 6, 12}, .targetWorld = {0, 6, -2.4}, .verticalFovRadians = 0.7};
  renderer().load(scene);
  const Image image = renderer().render(GetParam().configuration);
  const Image again = renderer().render(GetParam().configuration);
  EXPECT_EQ(image.rgba, again.rgba) << "the same frame twice";
  int shadowed = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t value = image.byte(static_cast<std::size_t>(y * kWidth + x));
      // Row 72 looks at the light's own height, on the wall; the plate's shadow on the wall ends 2 below.
      if (y <= kHeight / 2 + 2) {
        ASSERT_EQ(value, 255) << "pixel " << x << ", " << y;
      }
      shadowed += value < 128;
    }
  }
  EXPECT_GE(shadowed, 100) << "the plate's shadow on the wall";
}

TEST_P(Analytic, LightInsideACasterGivesADefinedImage) {
  scene::SceneDescription scene = PlateOverGround().scene();
  scene.objects.push_back(boxObject({0, 12, 0}, {2, 2, 2}));
  renderer().load(scene);
  const Image image = renderer().render(GetParam().configuration);
  const Image again = renderer().render(GetParam().configuration);
  EXPECT_EQ(image.rgba, again.rgba) << "the same frame twice";
  // The box closes the light in: below it nothing is lit but what its walls' cut near the light lets through.
  const std::uint8_t middle = image.byte(static_cast<std::size_t>(kHeight / 2 * kWidth + kWidth / 2));
  EXPECT_EQ(middle, 0);
}

TEST_P(AnalyticSoft, TurnedLightOfAspectFourFollowsTheTruth) {
  scene::SceneDescription scene = builtinScene("box@light=1");
  const scene::AreaLight square = scene.lights.front();
  const glm::dvec3 u = glm::normalize(square.halfU), v = glm::normalize(square.halfV);
  const double c = std::cos(0.6), s = std::sin(0.6);
  auto light = scene::areaLightFromVectors(square.centerWorld, 1.2 * (c * u + s * v), 0.3 * (c * v - s * u));
  ASSERT_TRUE(light);
  scene.lights = {*light};
  const auto receivers = reference::traceReceivers(scene, *scene.camera, *light, kWidth, kHeight);
  ASSERT_TRUE(receivers);
  const auto truth = reference::traceVisibility(scene, *light, *receivers, {.samples = 256});
  ASSERT_TRUE(truth);
  renderer().load(scene);
  const Image image = renderer().render(GetParam().configuration);
  std::vector<std::uint8_t> ground(receivers->kind.size());
  for (std::size_t i = 0; i < ground.size(); ++i)
    ground[i] = receivers->kind[i] == reference::kGroundReceiver;
  const auto error =
      metrics::errorStatistics(image.visibility(), *truth, metrics::penumbraMask(*truth, ground));
  std::printf("%-14s light 4:1, turned: rmse %.4f bias %+.4f\n", GetParam().name.c_str(), error.rmse,
              error.bias);
  EXPECT_GE(error.pixels, 500u);
  // The project's figures for square lights (see accuracy_test.cpp) hold for a rectangle: kernels are
  // rectangles too.
  EXPECT_LE(error.rmse, GetParam().name == "pcf_quantized" ? 0.065 : 0.042);
  saveUnlessPassed("turned_light", *truth, image);
}

INSTANTIATE_TEST_SUITE_P(Methods, Analytic, testing::ValuesIn(kMethods), kName);
INSTANTIATE_TEST_SUITE_P(Methods, AnalyticSoft, testing::ValuesIn(softMethods()), kName);

// vsm knows no exact umbra; it must still be lit where nothing is in the way, and dark in the middle.
TEST_F(AnalyticEngine, VsmIsLitOutsideAndDarkInside) {
  std::string reason;
  if (!supports("vsm", reason)) GTEST_SKIP() << "vsm needs " << reason;
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const Image image = renderer().render(Configuration{"vsm"});
  const scene::Camera camera = plate.camera();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 ground = groundPoint(camera, kWidth, kHeight, x, y);
      const double distance = std::max(std::abs(ground.x), std::abs(ground.z));
      const std::uint8_t value = image.byte(static_cast<std::size_t>(y * kWidth + x));
      if (distance > plate.hardHalf() + 0.15) {
        ASSERT_EQ(value, 255) << x << ", " << y;
      }
      // Chebyshev's bound with the least variance that 16 bits can tell from 0.
      if (distance < plate.hardHalf() - 0.15) {
        ASSERT_LE(value, 8) << x << ", " << y;
      }
    }
  }
}

TEST_F(FourLights, GiveWhatEachGivesAlone) {
  renderer().load(builtinScene("figure@light=0.3"));
  const scene::AreaLight first = builtinScene("figure@light=0.3").lights.front();
  std::vector<scene::AreaLight> lights;
  for (const glm::dvec3& offset :
       {glm::dvec3(0, 0, 0), glm::dvec3(-4, 2, 1), glm::dvec3(1, 1, -5), glm::dvec3(-8, -2, -4)}) {
    auto light = scene::areaLightAimed(first.centerWorld + offset, {0, 1, 0}, 0.6, 0.6, {0.2, 0.1, 1.0});
    ASSERT_TRUE(light);
    lights.push_back(*light);
  }
  // Where depths are complete, filters decide again what the mask knows: those are programs of their own. In
  // half precision (11 bits), two compilations of one sum may come out on either side of the middle between
  // two bytes.
  const int rounding = isForcedOff("highp") ? 1 : 0;
  // A quarter of the pixels: every technique, four lights at once and each alone.
  renderer().desc().target.width = kWidth / 2;
  renderer().desc().target.height = kHeight / 2;
  for (const std::string& technique : techniquesBut(renderer().engine(), {{"none", "it has no shadow"}})) {
    renderer().setLights(lights);
    const Image together = renderer().render(Configuration{technique});
    for (int i = 0; i < 4; ++i) {
      renderer().setLights({lights[static_cast<std::size_t>(i)]});
      const Image alone = renderer().render(Configuration{technique});
      int differing = 0, shadowed = 0;
      for (std::size_t p = 0; p < alone.pixels(); ++p) {
        const int difference = std::abs(alone.byte(p) - together.byte(p, i));
        differing += difference > rounding;
        shadowed += alone.byte(p) < 128;
      }
      // None: the same maps, the same arithmetic, another channel.
      EXPECT_EQ(differing, 0) << technique << ", light " << i;
      EXPECT_GE(shadowed, 50) << technique << ", light " << i << " must shadow something";
    }
  }
}

TEST_F(AnalyticEngine, NoneIsLitEverywhere) {
  renderer().load(builtinScene("figure@light=1"));
  const Image image = renderer().render(Configuration{"none"});
  EXPECT_EQ(std::ranges::count(image.rgba, 255), static_cast<std::ptrdiff_t>(image.rgba.size()));
}

}  // namespace
}  // namespace halfshadow::test
