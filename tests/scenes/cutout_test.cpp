// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/cutout.hpp"

#include <gtest/gtest.h>

namespace halfshadow::scene {
namespace {

/// Alpha 0, 51, 102, 153, 204, 255 in a row, or in a column.
Image ramp(bool isRow) {
  Image image{.width = isRow ? 6 : 1, .height = isRow ? 1 : 6};
  for (int i = 0; i < 6; ++i) {
    const auto alpha = static_cast<std::uint8_t>(51 * i);
    image.pixels.insert(image.pixels.end(), {9, 9, 9, alpha});
  }
  return image;
}

double at(const Image& image, const ImageSampling& sampling, double place) {
  return alphaAt(image, sampling, image.width > 1 ? glm::dvec2(place, 0.5) : glm::dvec2(0.5, place));
}

TEST(Cutout, AlphaIsLinearBetweenTexelsAndWrapsAsAsked) {
  for (const bool isRow : {true, false}) {
    const Image image = ramp(isRow);
    const auto wrap = [&](ImageWrap way) { return ImageSampling{.wrapU = way, .wrapV = way}; };
    const ImageSampling clamp = wrap(ImageWrap::clampToEdge), repeat = wrap(ImageWrap::repeat),
                        mirror = wrap(ImageWrap::mirroredRepeat);
    EXPECT_NEAR(at(image, clamp, 1.5 / 6), 0.2, 1e-12) << "a texel's centre";
    EXPECT_NEAR(at(image, clamp, 2.0 / 6), 0.3, 1e-12) << "half way";
    EXPECT_NEAR(at(image, clamp, 2.75 / 6), 0.45, 1e-12);
    EXPECT_NEAR(at(image, clamp, -3.0), 0.0, 1e-12);
    EXPECT_NEAR(at(image, clamp, 9.0), 1.0, 1e-12);
    EXPECT_NEAR(at(image, repeat, 0.0), 0.5, 1e-12) << "between the last texel and the first";
    EXPECT_NEAR(at(image, repeat, 1.5 / 6 - 7.0), 0.2, 1e-12);
    EXPECT_NEAR(at(image, mirror, 0.0), 0.0, 1e-12);
    EXPECT_NEAR(at(image, mirror, 1.0 + 1.5 / 6), 0.8, 1e-12) << "on its way back";
    EXPECT_NEAR(at(image, mirror, 2.0 + 1.5 / 6), 0.2, 1e-12);
  }
}

TEST(Cutout, NearestKeepsTexelsWhole) {
  const Image image = ramp(true);
  const ImageSampling nearest{.filter = ImageFilter::nearest};
  EXPECT_NEAR(at(image, nearest, 2.01 / 6), 0.4, 1e-12);
  EXPECT_NEAR(at(image, nearest, 2.99 / 6), 0.4, 1e-12);
  EXPECT_NEAR(at(image, nearest, -0.01 / 6), 1.0, 1e-12) << "repeats";
}

TEST(Cutout, AlphaOfAnObjectIsTheProductOfAllThatHasOne) {
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0}, texcoords{0, 0.5f, 1, 0.5f, 0, 0.5f};
  const std::vector<float> colors{1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 0};
  const auto mesh = buildMesh({.positions = positions.data(),
                               .vertexCount = 3,
                               .texcoords = texcoords.data(),
                               .colors = colors.data()});
  ASSERT_TRUE(mesh.ok());
  SceneObject object{.mesh = std::make_shared<const TriangleMesh>(*mesh)};
  object.material.baseColor.a = 0.8f;
  EXPECT_NEAR(alphaAt(object, 0, {1, 0, 0}), 0.8, 1e-6);
  EXPECT_NEAR(alphaAt(object, 0, {0, 0, 1}), 0.0, 1e-6);
  object.material.baseColorImage = std::make_shared<const Image>(ramp(true));
  object.material.sampling.wrapU = ImageWrap::clampToEdge;
  EXPECT_NEAR(alphaAt(object, 0, {0.5, 0.5, 0}), 0.8 * 0.75 * 0.5, 1e-6) << "the middle of the ramp";
}

}  // namespace
}  // namespace halfshadow::scene
