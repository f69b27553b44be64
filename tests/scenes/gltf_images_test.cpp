// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Images in glTF files: which pixels arrive, on which objects, and how often they are decoded.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "gltf_writer.hpp"
#include "images/images.hpp"

namespace halfshadow::scenes {
namespace {
using testing::anyNoteContains;
using testing::GltfWriter;
using testing::Json;
using testing::quadWriter;

scene::SceneDescription loaded(const GltfWriter& writer) {
  auto result = writer.load();
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return result.ok() ? *result : scene::SceneDescription{};
}

std::vector<std::uint8_t> png(int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
  auto bytes = images::encodePng(width, height, channels, pixels);
  EXPECT_TRUE(bytes.ok());
  return bytes.ok() ? *bytes : std::vector<std::uint8_t>();
}

/// Quads side by side, one for each of `materials`, with images in buffer views.
GltfWriter quads(const std::vector<std::vector<std::uint8_t>>& images, const Json& materials) {
  GltfWriter writer = quadWriter();
  writer.primitive()["attributes"]["TEXCOORD_0"] =
      writer.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, testing::kFloat, "VEC2", 2);
  writer.primitive()["attributes"]["TEXCOORD_1"] =
      writer.addAccessor(std::vector<float>{5, 5, 6, 5, 5, 6, 6, 6}, testing::kFloat, "VEC2", 2);
  const Json primitive = writer.primitive();
  writer.json["meshes"] = writer.json["nodes"] = writer.json["scenes"][0]["nodes"] = Json::array();
  for (std::size_t i = 0; i < materials.size(); ++i) {
    Json own = primitive;
    own["material"] = i;
    writer.json["meshes"].push_back({{"primitives", Json::array({own})}});
    writer.json["nodes"].push_back({{"mesh", i}, {"translation", {2 * i, 0, 0}}});
    writer.json["scenes"][0]["nodes"].push_back(i);
  }
  writer.json["materials"] = materials;
  for (const auto& image : images) {
    writer.json["textures"].push_back({{"source", writer.json["textures"].size()}});
    writer.json["images"].push_back({{"bufferView", writer.addView(image)}, {"mimeType", "image/png"}});
  }
  return writer;
}

Json textured(std::size_t texture) {
  return {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}};
}

TEST(GltfImages, GreyOnesAreSpreadToColours) {
  const auto description = loaded(quads({png(2, 1, 1, {10, 200}), png(2, 1, 2, {10, 128, 200, 255})},
                                        Json::array({textured(0), textured(1)})));
  const auto imageOf = [&](std::size_t i) { return *description.objects.at(i).material.baseColorImage; };
  EXPECT_EQ(imageOf(0).channels, 3);
  EXPECT_EQ(imageOf(0).pixels, (std::vector<std::uint8_t>{10, 10, 10, 200, 200, 200}));
  EXPECT_EQ(imageOf(1).channels, 4);
  EXPECT_EQ(imageOf(1).pixels, (std::vector<std::uint8_t>{10, 10, 10, 128, 200, 200, 200, 255}));
}

TEST(GltfImages, EachArrivesOnceWhereItIsMeant) {
  constexpr std::size_t kImages = 23;  // more than threads
  std::vector<std::vector<std::uint8_t>> images;
  Json materials = Json::array();
  for (std::size_t i = 0; i < kImages; ++i) {
    const auto shade = static_cast<std::uint8_t>(10 * i);
    images.push_back(png(1, 1, 3, {shade, 255, 0}));
  }
  images[5].resize(images[5].size() / 2);  // one of them is damaged
  for (std::size_t i = 0; i < 2 * kImages; ++i) materials.push_back(textured(i % kImages));
  const auto description = loaded(quads(images, materials));
  ASSERT_EQ(description.objects.size(), 2 * kImages);
  for (std::size_t i = 0; i < kImages; ++i) {
    const auto& image = description.objects[i].material.baseColorImage;
    EXPECT_EQ(image, description.objects[i + kImages].material.baseColorImage) << "one, shared";
    if (i == 5) {
      EXPECT_EQ(image, nullptr);
      continue;
    }
    ASSERT_NE(image, nullptr) << i;
    EXPECT_EQ(image->pixels[0], 10 * i);
  }
  EXPECT_TRUE(anyNoteContains(description, "image 5"));
  EXPECT_EQ(description.notes.size(), 1u) << "named once, though two materials ask for it";
}

TEST(GltfImages, DiffuseOnesOfSpecularGlossinessHaveTheirCoordinates) {
  const double c = std::cos(glm::radians(30.0)), s = std::sin(glm::radians(30.0));
  const auto texcoordOf = [&](const Json& texture) {
    const auto description = loaded(quads(
        {png(1, 1, 3, {255, 0, 0})},
        Json::array(
            {{{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseTexture", texture}}}}}}})));
    EXPECT_NE(description.objects.at(0).material.baseColorImage, nullptr);
    return glm::dvec2(description.objects[0].mesh->texcoords.at(1));
  };
  EXPECT_EQ(texcoordOf({{"index", 0}}), glm::dvec2(1, 0));
  EXPECT_EQ(texcoordOf({{"index", 0}, {"texCoord", 1}}), glm::dvec2(6, 5));
  const Json transform = {{"offset", {0.25, 0.5}}, {"rotation", glm::radians(30.0)}, {"scale", {2, 3}}};
  const glm::dvec2 moved = texcoordOf({{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}});
  EXPECT_LT(glm::length(moved - glm::dvec2(0.25 + 2 * c, 0.5 - 2 * s)), 1e-6);
}

/// As PNG files have it behind each chunk.
std::uint32_t crcOf(const std::uint8_t* bytes, std::size_t count) {
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

TEST(GltfImages, AFewBytesThatClaimGigabytesAreRefused) {
  std::vector<std::uint8_t> bytes = png(1, 1, 3, {1, 2, 3});
  // The header chunk: 8 bytes of signature, length, "IHDR", width, height, five more, checksum.
  for (const std::size_t at : {16, 20}) bytes[at + 1] = 0, bytes[at + 2] = 200, bytes[at + 3] = 0;
  const std::uint32_t crc = crcOf(&bytes[12], 17);
  for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
  const auto image = images::decodeImage(bytes, "png");
  ASSERT_FALSE(image.ok());
  EXPECT_NE(image.error().message.find("16384"), std::string::npos) << image.error().message;
  EXPECT_TRUE(anyNoteContains(loaded(quads({bytes}, Json::array({textured(0)}))), "image 0"));
}

}  // namespace
}  // namespace halfshadow::scenes
