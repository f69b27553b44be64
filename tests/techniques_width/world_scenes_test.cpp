// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Width maps, slices and moments in scenes as people bring them: wide grounds, grounds that cast, posts
// beside the lamp, strips, suns. A thin plate over the ground has a closed form, and what is added must not
// change it.
#include <algorithm>
#include <cmath>

#include "analytic_scenes.hpp"
#include "reference/closed_forms.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {

const Configuration kSigned{"shadow-width"}, kOcclusion{"occlusion-textures"}, kMoments{"vsm"};

class WorldScenes : public SharedEngineTest {
 protected:
  struct Errors {
    double penumbra = 0.0;  ///< root mean square over 0.005 < V < 0.995
    double lit = 0.0;       ///< worst where the whole light is seen, from the neighbouring pixels too
  };
  std::vector<float> visibilityOf(const scene::SceneDescription& scene, const Configuration& configuration) {
    renderer().load(scene);
    return renderer().render(configuration).visibility();
  }
  static bool litAround(const std::vector<float>& expected, int pixel) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = std::clamp(pixel % kWidth + dx, 0, kWidth - 1);
        const int y = std::clamp(pixel / kWidth + dy, 0, kHeight - 1);
        if (expected[static_cast<std::size_t>(y * kWidth + x)] < 1.0f) return false;
      }
    }
    return true;
  }
  static Errors errors(const std::vector<float>& expected, const std::vector<float>& actual) {
    Errors result;
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double error = static_cast<double>(actual[i]) - static_cast<double>(expected[i]);
      if (expected[i] > 0.005f && expected[i] < 0.995f) sum += error * error, count += 1.0;
      if (litAround(expected, static_cast<int>(i))) result.lit = std::max(result.lit, std::abs(error));
    }
    if (count > 0.0) result.penumbra = std::sqrt(sum / count);
    return result;
  }
  Errors errorsOf(const PlateOverGround& plate, const scene::SceneDescription& scene,
                  const Configuration& configuration) {
    return errors(plate.visibilityImage(), visibilityOf(scene, configuration));
  }
  bool runs(const Configuration& configuration) {
    std::string reason;
    return supports(configuration.technique, reason);
  }
};

// Whatever the ground's width and the light's size, ground outside the penumbra is lit: seen from so high
// that the shadow is a few pixels, and from beside it.
TEST_F(WorldScenes, GroundOutsidePenumbraeIsExactlyLit) {
  for (const double lightHalf : {0.3, 2.0, 6.0}) {
    for (const double groundHalf : {30.0, 3000.0}) {
      for (const double away : {0.0, 60.0}) {
        PlateOverGround plate;
        plate.lightHalf = lightHalf;
        scene::SceneDescription scene = plate.scene();
        scene.objects.back() = groundPlane(groundHalf);
        scene.camera = cameraAbove(away, 0.0, 25.0);
        const std::vector<float> actual = visibilityOf(scene, kSigned);
        // From the hard shadow's edge on: the disc that covers the kernel's corners, and a texel of the map.
        const double beyond = 0.2 + 1.05 * std::sqrt(0.5) * (plate.litHalf() - plate.umbraHalf());
        int judged = 0;
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 at = groundPoint(*scene.camera, kWidth, kHeight, x, y);
            if (std::max(std::abs(at.x), std::abs(at.z)) < plate.hardHalf() + beyond) continue;
            if (std::max(std::abs(at.x), std::abs(at.z)) > groundHalf) continue;
            ++judged;
            ASSERT_EQ(actual[static_cast<std::size_t>(y * kWidth + x)], 1.0f)
                << lightHalf << " " << groundHalf << " " << at.x << " " << at.z;
          }
        }
        EXPECT_GT(judged, 1000);
      }
    }
  }
}

// A caster that the light's centre sees edge-on has no texel: what is unknown is lit.
TEST_F(WorldScenes, CastersSeenEdgeOnDarkenNothing) {
  for (const double half : {0.2, 2.0}) {
    PlateOverGround plate;
    plate.lightHalf = half;
    scene::SceneDescription scene = plate.scene();
    scenes::Shape blade;
    blade.positions = {{-0.5f, 2.0f, 0.0f}, {0.5f, 2.0f, 0.0f}, {0.0f, 4.0f, 0.0f}};
    blade.indices = {0, 1, 2};
    scene.objects.front() = scenes::casterOf("blade", blade);
    scene.camera = cameraAbove(4.0, 4.0, 2.0);
    for (const float visible : visibilityOf(scene, kSigned)) ASSERT_EQ(visible, 1.0f);
  }
}

// Both sides of a strip count, on all sides of the plate.
TEST_F(WorldScenes, StripsOfLightHaveTwoWidths) {
  for (const double wide : {0.5, 1.0, 2.0}) {
    for (const double narrow : {1e-4, 0.001, 0.01, 0.1}) {
      for (const bool turned : {false, true}) {
        const PlateOverGround plate;
        scene::SceneDescription scene = plate.scene();
        const scene::AreaLight light =
            lightAbove({0, plate.lightHeight, 0}, turned ? narrow : wide, turned ? wide : narrow);
        scene.lights = {light};
        std::vector<float> expected;
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            expected.push_back(static_cast<float>(
                reference::rectangleVisibility(light, groundPoint(*scene.camera, kWidth, kHeight, x, y),
                                               {0, plate.plateHeight, 0}, plate.plateHalf, plate.plateHalf)));
          }
        }
        const Errors result = errors(expected, visibilityOf(scene, kSigned));
        // The hard shadow would be .25 off. Across the strip a penumbra of half a pixel is two texels wide.
        EXPECT_LT(result.penumbra, isForcedOff("highp") ? 0.09 : 0.07)
            << wide << " " << narrow << " " << turned;
        EXPECT_LT(result.lit, 0.3) << wide << " " << narrow << " " << turned;
      }
    }
  }
}

// A ground that casts is the last receiver everywhere: slightly hollow, so that none of its facets' planes
// holds all the others.
TEST_F(WorldScenes, GroundsThatCastChangeNothing) {
  for (const double depth : {0.0, 0.3, 1.0}) {
    PlateOverGround plate;
    scene::SceneDescription scene = plate.scene();
    scenes::Shape hollow;
    constexpr float kHalf = 6.0f;
    for (const float x : {-kHalf, kHalf}) {
      for (const float z : {-kHalf, kHalf}) hollow.positions.push_back({x, 0.0f, z});
    }
    hollow.positions.push_back({0.4f, static_cast<float>(-depth), 0.2f});
    // Seen from above the outline runs 0, 1, 3, 2.
    hollow.indices = {0, 1, 4, 1, 3, 4, 3, 2, 4, 2, 0, 4};
    scene.objects.back() = scenes::casterOf("hollow", hollow);
    for (const Configuration& configuration : {kSigned, kOcclusion}) {
      scene.objects.back().casts = false;
      const std::vector<float> without = visibilityOf(scene, configuration);
      scene.objects.back().casts = true;
      const Errors result = errors(without, visibilityOf(scene, configuration));
      // The map holds the ground too, whose texels are larger by four.
      EXPECT_LT(result.penumbra, 0.04) << configuration.technique << " " << depth;
      EXPECT_LT(result.lit, 0.1) << configuration.technique << " " << depth;
    }
  }
}

// Rooms of planes: receivers against which a caster stands have no seam of light between them.
TEST_F(WorldScenes, WallsThatMeetLetNoLightThrough) {
  scene::SceneDescription scene{.name = "corner"};
  // A wall on the ground between the light and the camera's view, all of which lies in its umbra.
  scene.objects = {scenes::casterOf("wall", scenes::boxShape({0, 1.0, 0}, {0.02, 1.0, 2.9})),
                   groundPlane(3.0)};
  scene.objects.back().casts = true;
  // Not nearer to the wall than two texels of a map of 256.
  scene.camera = cameraAbove(0.8, 0.0, 0.5);
  auto light = scene::areaLightAimed({-6, 6, 0}, {0, 0, 0}, 0.5, 0.5, {0, 0, 1});
  ASSERT_TRUE(light);
  scene.lights = {*light};
  for (const Configuration& configuration : {kSigned, kOcclusion}) {
    const std::vector<float> actual = visibilityOf(scene, configuration);
    EXPECT_LE(*std::ranges::max_element(actual), 0.03f) << configuration.technique;
  }
}

// The post's own shadow falls beside the picture.
TEST_F(WorldScenes, APostBesideTheLampLeavesOtherPenumbraeAlone) {
  const PlateOverGround plate;
  for (const Configuration& configuration : {kSigned, kOcclusion, kMoments}) {
    if (!runs(configuration)) continue;
    const double without = errorsOf(plate, plate.scene(), configuration).penumbra;
    // The noise of the samples that take over; without highp their depths have 16 bits for a range of 1:1000.
    const double least = isForcedOff("highp") ? 0.1 : 0.03;
    for (const double top : {9.0, 11.0, 11.5, 11.9, 12.0, 12.5}) {
      scene::SceneDescription scene = plate.scene();
      scene.objects.push_back(boxObject({4.5, 0.5 * top, 0}, {0.15, 0.5 * top, 0.15}));
      const Errors result = errorsOf(plate, scene, configuration);
      EXPECT_LT(result.penumbra, std::max(1.3 * without, least)) << configuration.technique << " " << top;
      EXPECT_LT(result.lit, 0.1) << configuration.technique << " " << top;
    }
  }
}

TEST_F(WorldScenes, LightsThatTouchCastersAreTakenOverWithAReason) {
  for (const Configuration& configuration : {kSigned, kOcclusion, kMoments}) {
    if (!runs(configuration)) continue;
    PlateOverGround plate;
    scene::SceneDescription scene = plate.scene();
    // Round the light, which shines nowhere.
    scene.objects.front() = boxObject({0, plate.lightHeight, 0}, {2.0, 0.5, 2.0});
    for (const float visible : visibilityOf(scene, configuration))
      ASSERT_LE(visible, 0.01f) << configuration.technique;
    EXPECT_TRUE(renderer().report().hasSkip("light 0 " + std::string(configuration.technique), "sampled"));
  }
}

// The same angles at all distances: the plate's penumbra is 1/12 of its height wide.
TEST_F(WorldScenes, SunsAreRightHoweverFar) {
  for (const Configuration& configuration : {kSigned, kOcclusion, kMoments}) {
    if (!runs(configuration)) continue;
    const double hard = errorsOf(PlateOverGround{}, PlateOverGround{}.scene(), {"hard"}).penumbra;
    for (const double distance : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
      // Depths of 16 bits, 1 - near / distance, tell the plate from the ground no farther away.
      if (isForcedOff("highp") && distance > 1e5) continue;
      PlateOverGround plate;
      plate.lightHeight = distance;
      plate.lightHalf = distance / 12.0;
      const Errors result = errorsOf(plate, plate.scene(), configuration);
      const bool moments = configuration.technique == kMoments.technique;
      EXPECT_LT(result.penumbra, moments ? hard : 0.05) << configuration.technique << " " << distance;
      EXPECT_LT(result.lit, moments ? 0.5 : 0.05) << configuration.technique << " " << distance;
    }
  }
}

// Looked up, the paper's attenuation is that of each light.
TEST_F(WorldScenes, TwoUnlikeLightsHaveTheirOwnAttenuation) {
  const PlateOverGround plate;
  renderer().load(plate.scene());
  const std::vector<scene::AreaLight> lights = {lightAbove({-1, 12, 0}, 0.1, 0.1),
                                                lightAbove({2, 9, 1}, 2.0, 2.0)};
  Image images[2];
  for (const bool texture : {false, true}) {
    renderer().setLights(lights);
    images[texture] = renderer().render({"shadow-width",
                                         {{"shadow-width.preset", "paper"},
                                          {"shadow-width.attenuation", texture ? "texture" : "arithmetic"}}});
  }
  for (int light = 0; light < 2; ++light) {
    double sum = 0.0;
    for (std::size_t i = 0; i < images[0].pixels(); ++i)
      sum += std::abs(images[0].byte(i, light) - images[1].byte(i, light));
    // 256 steps of depth and width; with the other light's table the mean is 5.
    EXPECT_LT(sum / static_cast<double>(images[0].pixels()), 1.0) << light;
  }
}

}  // namespace
}  // namespace halfshadow::test
