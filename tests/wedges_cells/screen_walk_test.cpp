// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lists of casting receivers walked on the screen: as right as on surfaces, the same pictures, and only where
// that pays.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "wedge_accuracy.hpp"

namespace halfshadow::test {
namespace {

Configuration walked(Configuration configuration, const char* where) {
  configuration.settings.push_back({"list_walk", where});
  return configuration;
}

const Configuration kWalkers[] = {{"wedges-cells", {}},
                                  {"wedges-cells", {{"wedges-cells.bytes", "4"}}},
                                  {"wedges-cells", {{"wedges-cells.bytes", "32"}}},
                                  {"wedges-cells", {{"wedges-cells.route", "scatter"}}},
                                  {"wedges-blended", {}},
                                  {"wedges-blended", {{"wedges-blended.cog", "on"}}},
                                  {"wedges-blended", {{"wedges-blended.merge", "core"}}},
                                  {"wedges", {}},
                                  {"wedges-probabilistic", {}}};

class ScreenWalks : public WedgeAccuracyTest {
 protected:
  void SetUp() override {
    if (isForcedOff("highp")) GTEST_SKIP() << "places on the screen take highp: lists are walked on surfaces";
  }
  static bool hasPass(const std::string& part) {
    return std::ranges::any_of(renderer().report().passes,
                               [&](const Pass& pass) { return pass.name.find(part) != std::string::npos; });
  }
  struct Difference {
    double rms = 0.0, share = 0.0;  ///< share of pixels that differ by more than two steps of a byte
  };
  static Difference between(const std::vector<float>& a, const std::vector<float>& b) {
    Difference difference;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double d = std::abs(a[i] - b[i]);
      difference.rms += d * d;
      difference.share += d > 2.5 / 255.0 ? 1.0 : 0.0;
    }
    difference.rms = std::sqrt(difference.rms / static_cast<double>(a.size()));
    difference.share /= static_cast<double>(a.size());
    return difference;
  }
  /// Of what is loaded, on surfaces and on the screen. Where a pixel's own facet is one of two that meet at a
  /// small angle, a millionth of its distance decides what the other hides; measured: .0004 and .0006 on the
  /// terrain, on all others at most .0001 and .0001.
  static void expectSamePicture(const Configuration& configuration, const std::string& what,
                                int channel = 0) {
    const std::vector<float> surfaces =
        renderer().render(walked(configuration, "surfaces")).visibility(channel);
    EXPECT_FALSE(hasPass("own lists")) << what;
    const std::vector<float> screen = renderer().render(walked(configuration, "screen")).visibility(channel);
    const Difference difference = between(surfaces, screen);
    // Else there is nothing to tell apart.
    EXPECT_TRUE(std::ranges::any_of(screen, [](float v) { return v > 0.1f && v < 0.9f; })) << what;
    std::printf("%-28s %-34s rms %.5f, %.4f %% differ\n", what.c_str(), configuration.text().c_str(),
                difference.rms, 100.0 * difference.share);
    EXPECT_LE(difference.rms, 0.001) << what << ", " << configuration.text();
    EXPECT_LE(difference.share, 0.002) << what << ", " << configuration.text();
  }
};

TEST_F(ScreenWalks, AreAsRightAsOnSurfaces) {
  for (const std::string scene :
       {"terrain", "sheets", "butterfly", "room", "figure@light=1", "spheres27@light=1", "leaves@light=1"}) {
    const Truth& truth = truthOf(scene);
    const auto errorOf = [&](const Configuration& configuration) {
      return metrics::errorStatistics(visibility(scene, configuration), truth.visibility,
                                      judgedOnCasters(truth));
    };
    for (const char* technique : {"wedges-cells", "wedges-blended", "wedges-probabilistic"}) {
      const auto surfaces = errorOf(walked({technique}, "surfaces")),
                 screen = errorOf(walked({technique}, "screen"));
      EXPECT_EQ(screen.nanPixels, 0u) << scene;
      EXPECT_LE(screen.rmse, surfaces.rmse + 0.0005) << scene << ", " << technique;
    }
  }
}

TEST_F(ScreenWalks, PicturesAreThoseOfSurfaces) {
  for (const char* scene : {"sheets", "contact"}) {
    renderer().load(builtinScene(scene));
    for (const Configuration& configuration : kWalkers) expectSamePicture(configuration, scene);
  }
  for (const char* scene : {"terrain", "figure@light=1", "large-world", "tiny"}) {
    renderer().load(builtinScene(scene));
    for (const char* technique : {"wedges-cells", "wedges-blended"}) expectSamePicture({technique}, scene);
  }
}

TEST_F(ScreenWalks, FromAnywhere) {
  for (const char* scene : {"terrain", "room"}) {
    renderer().load(builtinScene(scene));
    const CameraDesc whole = renderer().desc().camera;
    // Near enough that some casters are cut by the view's sides and by the near plane, and from far away.
    for (const double share : {0.6, 0.8, 1.5}) {
      for (int k = 0; k < 3; ++k) {
        const auto from = static_cast<double>(whole.target[k]), to = static_cast<double>(whole.eye[k]);
        renderer().desc().camera.eye[k] = from + share * (to - from);
      }
      expectSamePicture({"wedges-cells"}, std::string(scene) + " at " + std::to_string(share));
    }
    renderer().desc().camera = whole;
  }
}

TEST_F(ScreenWalks, OfSeveralLights) {
  renderer().load(builtinScene("terrain"));
  scene::AreaLight first = builtinScene("terrain").lights.front(), second = first;
  second.centerWorld += 3.5 * first.halfU;
  renderer().setLights({first, second});
  expectSamePicture({"wedges-cells"}, "two lights", 1);
  // Where receivers are does not depend on the light.
  EXPECT_EQ(std::ranges::count_if(renderer().report().passes,
                                  [](const Pass& pass) { return pass.name == "facets of receivers"; }),
            1);
}

TEST_F(ScreenWalks, AreChosenForDenseCasters) {
  renderer().load(builtinScene("terrain"));
  renderer().render({"wedges-cells"});
  EXPECT_TRUE(hasPass("own lists"));
  // Their lists are short: passes of their own would cost more.
  renderer().load(builtinScene("spheres27@light=1"));
  renderer().render({"wedges-cells"});
  EXPECT_FALSE(hasPass("own lists"));
}

TEST_F(ScreenWalks, OfMoreReceiversThanHaveNumbers) {
  // Alpha tells 254 of them; those that are apart on the screen share one.
  for (const int side : {20, 34}) {
    scene::SceneDescription scene = builtinScene("box@light=1");
    const scene::SceneObject box = scene.objects.front();
    ASSERT_TRUE(box.casts);
    scene.objects.erase(scene.objects.begin());
    for (int i = 0; i < side * side; ++i) {
      scene::SceneObject& copy = scene.objects.emplace_back(box);
      const glm::dvec3 at(0.2 * (i % side - 0.5 * side), 0.0, 0.2 * (i / side - 0.5 * side));
      copy.worldFromObject = glm::translate(glm::dmat4(1.0), at) *
                             glm::scale(glm::dmat4(1.0), glm::dvec3(0.08)) * box.worldFromObject;
    }
    renderer().load(scene);
    expectSamePicture({"wedges-cells"}, std::to_string(side * side) + " boxes");
    EXPECT_TRUE(hasPass("own lists"));
  }
}

TEST_F(ScreenWalks, AreNotWhereNumbersDoNotSuffice) {
  // All in one place.
  scene::SceneDescription scene = builtinScene("box@light=1");
  const scene::SceneObject box = scene.objects.front();
  for (int i = 0; i < 254; ++i) scene.objects.push_back(box);
  renderer().load(scene);
  renderer().render(walked({"wedges-cells"}, "screen"));
  EXPECT_FALSE(hasPass("own lists"));
}

TEST_F(ScreenWalks, FetchesAreCounted) {
  renderer().load(builtinScene("terrain"));
  const auto fetches = [&](const char* where) {
    const Image image = renderer().render(walked({"wedges-cells"}, where), Output::taps);
    double sum = 0.0;
    for (std::size_t i = 0; i < image.pixels(); ++i) sum += image.byte(i) + 256.0 * image.byte(i, 1);
    return sum / static_cast<double>(image.pixels());
  };
  const double surfaces = fetches("surfaces"), screen = fetches("screen");
  std::printf("fetches a pixel: %.1f on surfaces, %.1f on the screen\n", surfaces, screen);
  // Two where the receiver is, one of what was found.
  EXPECT_NEAR(screen, surfaces, 3.0 + 0.01 * surfaces);
}

}  // namespace
}  // namespace halfshadow::test
