// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What alpha leaves of meshes, against the alpha of single places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scene/cutout.hpp"
#include "scenes/gltf_presence.hpp"

namespace halfshadow::scenes {
namespace {

/// Patches of alpha 0, 1 and between, each several texels wide.
std::shared_ptr<const scene::Image> patchedImage(std::mt19937& random, int width, int height) {
  auto image = std::make_shared<scene::Image>();
  image->width = width, image->height = height, image->channels = 4;
  image->pixels.assign(static_cast<std::size_t>(width * height) * 4, 200);
  std::vector<std::uint8_t> patches(64);
  for (std::uint8_t& patch : patches) patch = static_cast<std::uint8_t>(random() % 3 * 100 + random() % 50);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image->pixels[static_cast<std::size_t>(y * width + x) * 4 + 3] =
          patches[static_cast<std::size_t>(y * 8 / height * 8 + x * 8 / width)];
  }
  return image;
}

scene::ImageSampling someSampling(std::mt19937& random) {
  constexpr ImageWrap kWraps[] = {ImageWrap::repeat, ImageWrap::clampToEdge, ImageWrap::mirroredRepeat};
  return {.wrapU = kWraps[random() % 3],
          .wrapV = kWraps[random() % 3],
          .filter = random() % 2 ? ImageFilter::nearest : ImageFilter::linear};
}

TEST(AlphaPyramids, HoldTheAlphaOfEveryPlaceInARectangle) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int narrow = 0;
  for (int k = 0; k < 400; ++k) {
    const auto image =
        patchedImage(random, 1 + static_cast<int>(random() % 70), 1 + static_cast<int>(random() % 70));
    const scene::ImageSampling sampling = someSampling(random);
    const scene::AlphaPyramid pyramid(*image);
    const double size = std::pow(10.0, -3.0 * unit(random));
    const glm::dvec2 low(6.0 * unit(random) - 3.0, 6.0 * unit(random) - 3.0);
    const glm::dvec2 high = low + size * glm::dvec2(unit(random), unit(random));
    const scene::AlphaRange range = pyramid.over(low, high, sampling);
    for (int p = 0; p < 60; ++p) {
      const glm::dvec2 place = glm::mix(low, high, glm::dvec2(unit(random), unit(random)));
      const double alpha = scene::alphaAt(*image, sampling, place);
      ASSERT_GE(alpha, range.low - 1e-6) << k;
      ASSERT_LE(alpha, range.high + 1e-6) << k;
    }
    narrow += range.high - range.low < 0.3f;
  }
  EXPECT_GT(narrow, 100) << "small rectangles are told apart from the image";
}

/// Quads of a grid, each with texture coordinates of its own.
scene::TriangleMesh quads(std::mt19937& random, int count) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> texcoords;
  std::vector<std::uint32_t> indices;
  for (int q = 0; q < count; ++q) {
    const glm::vec2 first(4.0f * unit(random) - 2.0f, 4.0f * unit(random) - 2.0f);
    const glm::vec2 along(0.2f * unit(random), 0.1f * unit(random)),
        up(-0.1f * unit(random), 0.2f * unit(random));
    const auto at = static_cast<std::uint32_t>(positions.size());
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto x = static_cast<float>(k % 2), y = static_cast<float>(k / 2);
      positions.emplace_back(static_cast<float>(2 * q) + x, y, 0.0f);
      texcoords.push_back(first + x * along + y * up);
    }
    indices.insert(indices.end(), {at, at + 1, at + 2, at + 2, at + 1, at + 3});
  }
  return *scene::buildMesh({.positions = &positions.front().x,
                            .vertexCount = static_cast<std::uint32_t>(positions.size()),
                            .indices = indices.data(),
                            .indexCount = indices.size(),
                            .texcoords = &texcoords.front().x});
}

TEST(PresentMeshes, LackTrianglesThatAreTransparentAllOver) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t left = 0, dropped = 0;
  for (int k = 0; k < 40; ++k) {
    GltfMaterial material{.blends = false};
    material.material.baseColorImage = patchedImage(random, 64, 48);
    material.material.sampling = someSampling(random);
    material.material.alphaCutoff = 0.4f;
    material.imageAlpha = std::make_shared<const scene::AlphaPyramid>(*material.material.baseColorImage);
    const auto mesh = std::make_shared<const scene::TriangleMesh>(quads(random, 60));
    const PresentMesh present = presentMesh(material, mesh);
    const std::size_t triangles = present.mesh ? present.mesh->triangleCount() : 0;
    left += triangles, dropped += mesh->triangleCount() - triangles;
    // A triangle is found again by its corners.
    const auto isLeft = [&](std::uint32_t t) {
      const glm::vec3& corner = mesh->positions[mesh->indices[3 * t]];
      for (std::uint32_t i = 0; present.mesh && i < present.mesh->triangleCount(); ++i) {
        if (present.mesh->positions[present.mesh->indices[3 * i]] == corner &&
            present.mesh->positions[present.mesh->indices[3 * i + 1]] ==
                mesh->positions[mesh->indices[3 * t + 1]])
          return true;
      }
      return false;
    };
    const scene::SceneObject object{.mesh = mesh, .material = material.material};
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
      double least = 1.0, most = 0.0;
      for (int p = 0; p < 200; ++p) {
        double a = unit(random), b = unit(random);
        if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
        const double alpha = scene::alphaAt(object, t, {a, b, 1.0 - a - b});
        least = std::min(least, alpha), most = std::max(most, alpha);
      }
      if (most >= 0.4) {
        ASSERT_TRUE(isLeft(t)) << k << ", " << t;
      }
      if (most >= 0.4 && least < 0.4) {
        ASSERT_TRUE(present.hasHoles) << k << ", " << t;
      }
    }
  }
  EXPECT_GT(left, 1000u);
  EXPECT_GT(dropped, 500u);
}

/// A tetrahedron whose triangles, wound inward, have vertices of their own; those of the last have this
/// alpha.
std::shared_ptr<const scene::TriangleMesh> inwardTetrahedron(float lastAlpha) {
  const glm::vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<glm::vec3> positions;
  std::vector<glm::vec4> colors;
  for (const int corner : {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0}) {
    positions.push_back(corners[corner]);
    colors.emplace_back(1.0f, 1.0f, 1.0f, positions.size() > 9 ? lastAlpha : 1.0f);
  }
  return std::make_shared<const scene::TriangleMesh>(*scene::buildMesh(
      {.positions = &positions.front().x, .vertexCount = 12, .indexCount = 12, .colors = &colors.front().x}));
}

TEST(PresentMeshes, AreTheMeshItselfWhereAllOfItStays) {
  const auto mesh = inwardTetrahedron(1.0f);
  GltfMaterial material;
  material.material.alphaCutoff = 0.5f;
  EXPECT_EQ(presentMesh(material, mesh).mesh, mesh);
  EXPECT_FALSE(presentMesh(material, mesh).hasHoles);
  material.material.baseColor.a = 0.4f;
  EXPECT_EQ(presentMesh(material, mesh).mesh, nullptr);
  material.material.alphaCutoff = 0.0f;
  EXPECT_EQ(presentMesh(material, mesh).mesh, mesh) << "without a cutoff alpha is not looked at";
}

TEST(PresentMeshes, AreWoundAsInTheFile) {
  const auto mesh = inwardTetrahedron(0.0f);
  ASSERT_TRUE(mesh->statistics.closed());
  ASSERT_FALSE(mesh->turned.empty()) << "shells are wound outward";
  GltfMaterial material;
  material.material.alphaCutoff = 0.5f;
  const PresentMesh present = presentMesh(material, mesh);
  ASSERT_NE(present.mesh, nullptr);
  ASSERT_EQ(present.mesh->triangleCount(), 3u);
  EXPECT_FALSE(present.mesh->statistics.closed());
  EXPECT_FALSE(present.hasHoles);
  const glm::dvec3 middle(0.25);
  for (std::uint32_t t = 0; t < 3; ++t) {
    const auto at = [&](std::uint32_t k) {
      return glm::dvec3(present.mesh->positions[present.mesh->indices[3 * t + k]]);
    };
    EXPECT_GT(glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), middle - at(0)), 0.0) << "inward, as given";
  }
}

}  // namespace
}  // namespace halfshadow::scenes
