// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Shading compiles in what surfaces and lights of a draw need, no more: where a variant ends and the next
// begins the picture has no step, and every surface is drawn under every number of lights.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/type_ptr.hpp>

#include "engine_fixture.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {

constexpr float kDark = 0.25f;

struct Surface {
  glm::vec3 color{0.8f};
  bool vertexColors = false;
  bool textured = false;
  bool cut = false;
};

class ShadedSurfaces : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (!HasFatalFailure()) engine_ = makeEngine();
  }
  void TearDown() override {
    engine_.reset();
    EngineTest::TearDown();
  }
  /// A sphere of this surface in the light of lamps that stand one beside the other.
  Image picture(const Surface& surface, const std::vector<LightDesc>& lights) {
    const auto mesh = scenes::meshOf(scenes::icosphereShape({0, 1, 0}, 1.0, 3));
    const std::vector<float> colors(4 * mesh->positions.size(), 0.5f);
    // Half of the image is a hole.
    const std::array<std::uint8_t, 16> pixels{90, 90, 90, 255, 90, 90, 90, 0, 90, 90, 90, 255, 90, 90, 90, 0};
    std::vector<float> texcoords;
    for (const glm::vec3& position : mesh->positions)
      texcoords.insert(texcoords.end(), {position.x, position.y});
    ObjectDesc desc{.mesh = {.positions = glm::value_ptr(mesh->positions.front()),
                             .vertexCount = static_cast<std::uint32_t>(mesh->positions.size()),
                             .indices = mesh->indices.data(),
                             .indexCount = mesh->indices.size(),
                             .normals = glm::value_ptr(mesh->normals.front()),
                             .texcoords = texcoords.data(),
                             .colors = surface.vertexColors ? colors.data() : nullptr}};
    std::copy_n(glm::value_ptr(surface.color), 3, desc.baseColor);
    if (surface.textured || surface.cut) {
      desc.baseColorPixels = pixels.data();
      desc.baseColorWidth = desc.baseColorHeight = 2;
    }
    if (surface.cut) desc.alphaCutoff = 0.2f;
    ObjectId id = 0;
    expectOk(engine_->addObject(desc, id));
    expectOk(engine_->setLights(lights.data(), lights.size()));
    expectOk(engine_->setTechnique("hard"));
    Image image{.width = 64, .height = 48};
    image.rgba.resize(image.pixels() * 4);
    RenderDesc frame{.camera = {.eye = {2.5, 2.5, 2.5}, .target = {0, 1, 0}, .nearDistance = 0.1},
                     .target = {.width = image.width, .height = image.height},
                     .output = Output::shaded};
    expectOk(engine_->render(frame));
    expectOk(engine_->readOutput(image.rgba.data(), image.rgba.size()));
    expectOk(engine_->removeObject(id));
    return image;
  }
  static void expectOk(const Outcome& outcome) { EXPECT_TRUE(outcome.ok()) << outcome.message; }
  static LightDesc lamp(double intensity) {
    return {.center = {2, 5, 1}, .halfU = {0.2, 0, 0}, .halfV = {0, 0, 0.2}, .intensity = intensity};
  }
  static int apart(const Image& a, const Image& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
      most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return most;
  }
  static double brightness(const Image& image) {
    double sum = 0.0;
    for (std::size_t i = 0; i < image.pixels(); ++i) sum += image.byte(i);
    return sum / static_cast<double>(image.pixels());
  }

 private:
  std::unique_ptr<Engine> engine_;
};

TEST_F(ShadedSurfaces, HaveNoStepWhereTheSkyBeginsToShow) {
  const Image below = picture({.color = glm::vec3(kDark - 1e-4f)}, {lamp(0.5)}),
              above = picture({.color = glm::vec3(kDark + 1e-4f)}, {lamp(0.5)});
  EXPECT_LE(apart(below, above), 1);
  // What shows on black is sky alone.
  const Image black = picture({.color = glm::vec3(0.0f)}, {lamp(0.5)});
  EXPECT_GT(brightness(black), 1.0);
}

TEST_F(ShadedSurfaces, InsideAConeAreAsWithoutIt) {
  LightDesc spot = lamp(0.5);
  spot.innerConeRadians = 1.2;
  spot.outerConeRadians = 1.4;
  EXPECT_LE(apart(picture({}, {spot}), picture({}, {lamp(0.5)})), 1);
  spot.innerConeRadians = 0.2;
  spot.outerConeRadians = 0.4;
  EXPECT_LT(brightness(picture({}, {spot})), 0.9 * brightness(picture({}, {lamp(0.5)})));
}

TEST_F(ShadedSurfaces, AreFourTimesAsBrightNearALightThatFades) {
  LightDesc fading = lamp(0.1);
  fading.referenceDistance = 1e4;
  EXPECT_LE(apart(picture({}, {fading}), picture({}, {lamp(0.4)})), 1);
  fading = lamp(0.5);
  fading.referenceDistance = 0.5;
  EXPECT_LT(brightness(picture({}, {fading})), 0.9 * brightness(picture({}, {lamp(0.5)})));
}

TEST_F(ShadedSurfaces, GetNoLightBehindALamp) {
  LightDesc below = lamp(0.5);
  below.center[1] = 1.0;
  const Image dark = picture({}, {lamp(0.0)}), half = picture({}, {below});
  LightDesc turned = below;
  std::swap(turned.halfU, turned.halfV);
  const Image otherHalf = picture({}, {turned});
  // Each lights what the other does not.
  EXPECT_GT(brightness(half), brightness(dark) + 1.0);
  EXPECT_GT(brightness(otherHalf), brightness(dark) + 1.0);
  std::size_t both = 0;
  for (std::size_t i = 0; i < dark.pixels(); ++i)
    both += half.byte(i) > dark.byte(i) + 1 && otherHalf.byte(i) > dark.byte(i) + 1;
  EXPECT_EQ(both, 0u);
}

// Several lights are shaded from their visibilities on the screen, by other programs.
TEST_F(ShadedSurfaces, LookTheSameInTheLightOfTwoHalves) {
  for (const bool dark : {false, true}) {
    for (const bool vertexColors : {false, true}) {
      for (const bool textured : {false, true}) {
        for (const bool cut : {false, true}) {
          const Surface surface{glm::vec3(dark ? 0.1f : 0.8f), vertexColors, textured, cut};
          SCOPED_TRACE(std::string(dark ? "dark " : "") + (vertexColors ? "colours " : "") +
                       (textured ? "textured " : "") + (cut ? "cut" : ""));
          LightDesc whole = lamp(0.5), half = lamp(0.25);
          whole.referenceDistance = half.referenceDistance = 3.0;
          const Image one = picture(surface, {whole}), two = picture(surface, {half, half});
          // Visibilities on the screen have 8 bits; without highp so have sums of light.
          EXPECT_LE(apart(one, two), isForcedOff("highp") ? 3 : 2);
          EXPECT_GT(brightness(one), 2.0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
