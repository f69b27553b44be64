// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Output::shaded, what hosts get unless they ask for something else: Lambert × visibility, summed over
// lights. Every test compares pictures with each other or with a cosine, so that none depends on how bright a
// light of intensity 1 is at which distance.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {

/// Shaded output is encoded by a square root, which stands for sRGB's curve.
double linear(std::uint8_t byte) {
  return (byte / 255.0) * (byte / 255.0);
}

class Shaded : public SharedEngineTest {
 protected:
  static Image shaded(const std::string& technique, const std::vector<scene::AreaLight>& lights) {
    renderer().setLights(lights);
    return renderer().render(Configuration{technique}, Output::shaded);
  }
  static scene::AreaLight dimmed(scene::AreaLight light, double intensity) {
    light.intensity = intensity;
    return light;
  }
};

// Ambient light is what is left of a light without intensity; the rest is the unshadowed light times the
// visibility that the technique itself gives.
TEST_F(Shaded, IsAmbientPlusLightTimesVisibility) {
  const scene::SceneDescription scene = PlateOverGround().scene();
  renderer().load(scene);
  const std::vector<scene::AreaLight> dark{dimmed(scene.lights.front(), 0.0)}, lit = scene.lights;
  const Image ambient = shaded("none", dark), open = shaded("none", lit);
  double brightest = 0.0;
  for (std::size_t i = 0; i < open.pixels(); ++i)
    brightest = std::max(brightest, linear(open.byte(i)) - linear(ambient.byte(i)));
  ASSERT_GT(brightest, 0.2) << "the light must count for something";
  for (const std::string& technique : techniquesBut(renderer().engine(), {})) {
    renderer().setLights(lit);
    const Image visibility = renderer().render(Configuration{technique}, Output::visibility);
    const Image image = renderer().render(Output::shaded);
    int wrong = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const double a = linear(ambient.byte(i, channel)), l = linear(open.byte(i, channel));
        const double expected = std::sqrt(a + (l - a) * visibility.byte(i) / 255.0);
        const double error = std::abs(expected - image.byte(i, channel) / 255.0);
        worst = std::max(worst, error);
        // Half a step each of the four pictures.
        wrong += error > 2.0 / 255.0;
      }
    }
    EXPECT_EQ(wrong, 0) << technique << ", worst " << 255.0 * worst << " steps";
  }
}

enum class Normals { given, missing };
class ShadedPlates : public Shaded, public testing::WithParamInterface<Normals> {};

// Small plates all as far from the light as each other, each turned away from it by another angle. Without
// normals, facets are shaded flat.
TEST_P(ShadedPlates, FollowTheCosine) {
  constexpr double kDegrees[] = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 87.0};
  const glm::dvec3 center(0, 10, 0);
  scene::SceneDescription scene;
  std::vector<glm::dvec3> places;
  for (std::size_t k = 0; k < std::size(kDegrees); ++k) {
    const double around = 2.0 * 3.14159265358979 * static_cast<double>(k) / std::size(kDegrees);
    const glm::dvec3 place(4.0 * std::cos(around), 0.0, 4.0 * std::sin(around));
    const glm::dvec3 toLight = glm::normalize(center - place);
    const glm::dvec3 side = glm::normalize(glm::cross(toLight, glm::dvec3(0, 1, 0)));
    // Away from the axis: the camera above sees all of them from the lit side.
    const double turn = glm::radians(kDegrees[k]);
    const glm::dvec3 normal = glm::dvec3(glm::rotate(glm::dmat4(1.0), turn, side) * glm::dvec4(toLight, 0.0));
    const glm::dvec3 right = side, up = glm::cross(normal, right);
    scenes::Shape plate;
    constexpr double kHalf = 0.35;
    for (const glm::dvec2& corner :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
      plate.addVertex(place + kHalf * (corner.x * right + corner.y * up));
    if (GetParam() == Normals::given) plate.normals.assign(4, glm::vec3(normal));
    plate.addTriangle(0, 1, 2);
    plate.addTriangle(0, 2, 3);
    scene.objects.push_back(scenes::casterOf("plate", plate));
    scene.objects.back().casts = false;
    places.push_back(place);
  }
  scene.lights = {lightAbove(center, 0.5, 0.5)};
  scene.camera = cameraAbove(0.0, 0.0, 5.0);
  renderer().load(scene);
  const Image ambient = shaded("none", {dimmed(scene.lights.front(), 0.0)}),
              lit = shaded("none", scene.lights);
  const auto light = [&](std::size_t k) {
    int best = 0;
    double nearest = 1e9;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double away = glm::length(groundPoint(*scene.camera, kWidth, kHeight, x, y) - places[k]);
        if (away < nearest) nearest = away, best = y * kWidth + x;
      }
    }
    const auto pixel = static_cast<std::size_t>(best);
    return linear(lit.byte(pixel)) - linear(ambient.byte(pixel));
  };
  const double whole = light(0);
  ASSERT_GT(whole, 0.1);
  for (std::size_t k = 1; k < std::size(kDegrees); ++k) {
    // One step of 1/255 is at most two of linear light; a pixel's middle is not quite the plate's.
    EXPECT_NEAR(light(k), whole * std::cos(glm::radians(kDegrees[k])), 3.0 / 255.0)
        << kDegrees[k] << " degrees";
  }
}

INSTANTIATE_TEST_SUITE_P(Normals, ShadedPlates, testing::Values(Normals::given, Normals::missing),
                         [](const auto& tested) {
                           return tested.param == Normals::given ? "given" : "missing";
                         });

TEST_F(Shaded, LightsOfAnyColourAddUp) {
  const scene::SceneDescription scene = PlateOverGround().scene();
  renderer().load(scene);
  std::vector<scene::AreaLight> lights;
  for (const auto& [offset, color] : std::initializer_list<std::pair<glm::dvec3, glm::vec3>>{
           {{0, 0, 0}, {1, 0.2f, 0.1f}}, {{3, -1, 1}, {0.1f, 1, 0.3f}}, {{-2, 1, 3}, {0.2f, 0.3f, 1}}}) {
    lights.push_back(lightAbove(glm::dvec3(0, 12, 0) + offset, 1.0, 0.5));
    lights.back().color = color;
    lights.back().intensity = 0.35;  // none of the sums is clamped
  }
  for (const char* technique : {"hard", "pcss-mip", "wedges-cells"}) {
    const Image ambient = shaded(technique, {dimmed(lights.front(), 0.0)}),
                together = shaded(technique, lights);
    std::vector<Image> alone;
    for (const scene::AreaLight& light : lights) alone.push_back(shaded(technique, {light}));
    int wrong = 0;
    for (std::size_t i = 0; i < together.pixels(); ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const double a = linear(ambient.byte(i, channel));
        double expected = a;
        for (const Image& image : alone) expected += linear(image.byte(i, channel)) - a;
        ASSERT_LT(expected, 1.0) << "clamped";
        // Half a step of each of the five pictures, and of the visibilities between.
        wrong += std::abs(std::sqrt(expected) - together.byte(i, channel) / 255.0) > 3.0 / 255.0;
      }
    }
    EXPECT_EQ(wrong, 0) << technique;
  }
}

// What else the scene holds, and where its shadows fall, is nothing to a lit pixel's brightness.
TEST_F(Shaded, BrightnessOwesNothingToOtherObjects) {
  const PlateOverGround plate;
  const auto corner = [&](const scene::SceneDescription& scene) {
    renderer().load(scene);
    return static_cast<int>(shaded("pcss", scene.lights).byte(0));  // outside the plate's penumbra
  };
  const int before = corner(plate.scene());
  EXPECT_GT(before, 60);
  scene::SceneDescription lifted = plate.scene(), wide = plate.scene(), far = plate.scene();
  lifted.objects[0] = boxObject({0, 5, 0}, {0.5, 0.2, 0.5});
  wide.objects[1] = groundPlane(2000.0);
  far.objects.push_back(boxObject({40, 1, 0}, {1, 1, 1}));
  EXPECT_NEAR(corner(lifted), before, 1);
  EXPECT_NEAR(corner(wide), before, 1);
  EXPECT_NEAR(corner(far), before, 1);
}

// Intensity counts fully at the reference distance and falls with the square of the distance, up to four
// times as much near the light; 0 is the same everywhere.
TEST_F(Shaded, FallsWithTheSquareOfTheDistance) {
  scene::SceneDescription scene;
  scene.objects = {groundPlane(20.0)};
  scene.camera = cameraAbove(0.0, 0.0, 5.0);
  const std::size_t middle = static_cast<std::size_t>(kHeight / 2) * kWidth + kWidth / 2;
  const auto litFrom = [&](double height, double reference) {
    scene::AreaLight light = lightAbove({0, height, 0}, 0.1, 0.1);
    light.intensity = 0.3;
    light.referenceDistance = reference;
    scene.lights = {light};
    renderer().load(scene);
    const Image lit = shaded("none", {light}), dark = shaded("none", {dimmed(light, 0.0)});
    return linear(lit.byte(middle)) - linear(dark.byte(middle));
  };
  const double full = litFrom(10.0, 0.0);
  ASSERT_GT(full, 0.1);
  EXPECT_NEAR(litFrom(30.0, 0.0), full, 1.0 / 255.0) << "a sun";
  EXPECT_NEAR(litFrom(10.0, 10.0), full, 1.0 / 255.0);
  EXPECT_NEAR(litFrom(20.0, 10.0), full / 4.0, 1.0 / 255.0);
  EXPECT_NEAR(litFrom(10.0, 15.0), full * 2.25, 2.0 / 255.0);
  EXPECT_NEAR(litFrom(2.0, 10.0), std::min(full * 4.0, 1.0), 2.0 / 255.0) << "at most four times";
}

// A light shines to one side of its plane; what lies on the other shows ambient light alone.
TEST_F(Shaded, NothingIsLitBehindTheLight) {
  scene::SceneDescription scene = PlateOverGround().scene();
  scene::AreaLight& light = scene.lights.front();
  light.halfV = -light.halfV;
  light.emission = -light.emission;
  renderer().load(scene);
  const Image behind = shaded("pcss-mip", scene.lights),
              dark = shaded("pcss-mip", {dimmed(scene.lights.front(), 0.0)});
  EXPECT_EQ(behind.rgba, dark.rgba);
}

/// A ground with texture coordinates, unshadowed.
class ShadedTexture : public EngineTest {
 protected:
  static constexpr int kBlocks = 4, kBlockTexels = 16, kSide = kBlocks * kBlockTexels;
  /// `texels` (kBlocks² colours) as a base colour texture, or `plain` when there are none.
  static Image groundOf(const std::vector<glm::u8vec3>& texels, const glm::vec4& plain) {
    SceneRenderer renderer(makeEngine());
    scene::SceneDescription scene;
    scene.lights = {lightAbove({0, 30, 0}, 1.0, 1.0)};
    scene.lights.front().intensity = 0.8;  // with what the sky adds, white is not clamped
    scene.camera = cameraAbove(0.0, 0.0, 2.0);
    renderer.load(scene);
    const float positions[] = {-2, 0, -2, 2, 0, -2, 2, 0, 2, -2, 0, 2},
                texcoords[] = {0, 0, 1, 0, 1, 1, 0, 1};
    const std::uint32_t indices[] = {0, 2, 1, 0, 3, 2};
    ObjectDesc desc{.mesh = {.positions = positions,
                             .vertexCount = 4,
                             .indices = indices,
                             .indexCount = 6,
                             .texcoords = texcoords},
                    .casts = false};
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < kSide && !texels.empty(); ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::u8vec3& c =
            texels[static_cast<std::size_t>(y / kBlockTexels * kBlocks + x / kBlockTexels)];
        pixels.insert(pixels.end(), {c.x, c.y, c.z});
      }
    }
    if (!pixels.empty()) {
      desc.baseColorPixels = pixels.data();
      desc.baseColorWidth = desc.baseColorHeight = kSide;
      desc.baseColorChannels = 3;
    }
    for (int i = 0; i < 4; ++i) desc.baseColor[i] = plain[i];
    ObjectId id = 0;
    const Outcome outcome = renderer.engine().addObject(desc, id);
    EXPECT_TRUE(outcome.ok()) << outcome.message;
    return renderer.render(Configuration{"none"}, Output::shaded);
  }
  /// The pixel in the middle of a block: 4:3 image, the ground as high as the image.
  static std::size_t pixelOf(int column, int row) {
    const double x = kWidth / 2.0 + (column + 0.5 - kBlocks / 2.0) / kBlocks * kHeight;
    const double y = (row + 0.5) / kBlocks * kHeight;
    return static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
  }
};

// The ground fills the image from top to bottom; the first row of texels lies at the top (texcoord v = 0).
TEST_F(ShadedTexture, ShowsWhatWasPainted) {
  std::vector<glm::u8vec3> painted;
  for (int i = 0; i < kBlocks * kBlocks; ++i)
    painted.emplace_back(17 * i, 255 - 17 * i, i % 2 == 0 ? 40 : 200);
  const glm::vec4 white(1.0f);
  const Image textured = groundOf(painted, white), plain = groundOf({}, white);
  for (int row = 0; row < kBlocks; ++row) {
    for (int column = 0; column < kBlocks; ++column) {
      const std::size_t pixel = pixelOf(column, row);
      for (int c = 0; c < 3; ++c) {
        // sRGB in, the same curve out: under light that shows white as w, a colour shows as w times itself.
        const double expected =
            painted[static_cast<std::size_t>(row * kBlocks + column)][c] * (plain.byte(pixel, c) / 255.0);
        EXPECT_NEAR(textured.byte(pixel, c), expected, 1.5) << "block " << column << ", " << row;
      }
    }
  }
}

// The factor is linear and the texture sRGB: a grey painted and a grey as factor are the same grey. A square
// stands for sRGB's curve, which it misses by .037 at most.
TEST_F(ShadedTexture, FactorIsLinearAndTextureIsSrgb) {
  const Image half = groundOf({}, glm::vec4(0.5f, 0.25f, 0.1f, 1.0f)), white = groundOf({}, glm::vec4(1.0f));
  const std::size_t pixel = pixelOf(1, 1);
  const double factors[] = {0.5, 0.25, 0.1};
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(linear(half.byte(pixel, c)), factors[c] * linear(white.byte(pixel, c)), 2.0 / 255.0);
  const auto srgb = [](double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  };
  const glm::u8vec3 painted(std::lround(255 * srgb(0.5)), std::lround(255 * srgb(0.25)),
                            std::lround(255 * srgb(0.1)));
  const Image texture = groundOf(std::vector<glm::u8vec3>(kBlocks * kBlocks, painted), glm::vec4(1.0f));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(texture.byte(pixel, c), half.byte(pixel, c), 0.037 * 255) << c;
}

}  // namespace
}  // namespace halfshadow::test
