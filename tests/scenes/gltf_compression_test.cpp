// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Compressed geometry against what was compressed, by the encoders of the libraries whose decoders are used.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_writer.hpp"
#include "scenes/shapes.hpp"

#ifdef HALFSHADOW_HAS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef HALFSHADOW_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace halfshadow::scenes {
namespace {
using testing::GltfWriter;
using testing::Json;

/// World positions of all corners, triangle by triangle.
std::vector<glm::dvec3> cornersOf(const scene::SceneDescription& description) {
  std::vector<glm::dvec3> corners;
  for (const scene::SceneObject& object : description.objects) {
    for (const std::uint32_t index : object.mesh->indices) {
      corners.emplace_back(object.worldFromObject *
                           glm::dvec4(glm::dvec3(object.mesh->positions[index]), 1.0));
    }
  }
  return corners;
}

/// From each corner to the nearest of the others, the largest.
double farthest(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
  double largest = 0.0;
  for (const glm::dvec3& a : from) {
    double nearest = 1e9;
    for (const glm::dvec3& b : to) nearest = std::min(nearest, glm::length(a - b));
    largest = std::max(largest, nearest);
  }
  return largest;
}

const Shape& ball() {
  static const Shape shape = icosphereShape({1, 2, 3}, 1.5, 2);
  return shape;
}

#ifdef HALFSHADOW_HAS_MESHOPT
scene::SceneDescription meshoptBall(const char* extension) {
  const Shape& shape = ball();
  const std::size_t vertices = shape.positions.size(), indices = shape.indices.size();
  std::vector<unsigned char> points(meshopt_encodeVertexBufferBound(vertices, 12)),
      corners(meshopt_encodeIndexBufferBound(indices, vertices));
  points.resize(
      meshopt_encodeVertexBuffer(points.data(), points.size(), shape.positions.data(), vertices, 12));
  corners.resize(meshopt_encodeIndexBuffer(corners.data(), corners.size(), shape.indices.data(), indices));
  GltfWriter writer;
  const int pointsView = writer.addView(points), cornersView = writer.addView(corners);
  const auto encode = [&](int view, std::size_t count, std::size_t stride, const char* mode) {
    Json& stored = writer.json["bufferViews"][view];
    stored["extensions"][extension] = {{"buffer", 0},
                                       {"byteOffset", stored["byteOffset"]},
                                       {"byteLength", stored["byteLength"]},
                                       {"byteStride", stride},
                                       {"count", count},
                                       {"mode", mode}};
    stored["buffer"] = 1;
    stored["byteOffset"] = 0;
    stored["byteLength"] = count * stride;
  };
  encode(pointsView, vertices, 12, "ATTRIBUTES");
  encode(cornersView, indices, 4, "TRIANGLES");
  const int position = writer.addAccessor(
      {{"bufferView", pointsView}, {"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}});
  const int index = writer.addAccessor(
      {{"bufferView", cornersView}, {"componentType", 5125}, {"count", indices}, {"type", "SCALAR"}});
  writer.addPrimitive({{"attributes", {{"POSITION", position}}}, {"indices", index}});
  writer.json["extensionsRequired"] = {extension};
  writer.furtherBuffers.push_back({{"byteLength", std::max(vertices * 12, indices * 4)},
                                   {"extensions", {{extension, {{"fallback", true}}}}}});
  const auto result = writer.load();
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return result.ok() ? *result : scene::SceneDescription{};
}

TEST(GltfCompression, MeshoptComesBackExactly) {
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const scene::SceneDescription description = meshoptBall(extension);
    ASSERT_EQ(description.objects.size(), 1u);
    const auto mesh = meshOf(ball());
    EXPECT_EQ(description.objects[0].mesh->triangleCount(), mesh->triangleCount());
    std::vector<glm::dvec3> plain;
    for (const std::uint32_t i : mesh->indices) plain.emplace_back(mesh->positions[i]);
    EXPECT_EQ(farthest(cornersOf(description), plain), 0.0);
    EXPECT_EQ(farthest(plain, cornersOf(description)), 0.0);
  }
}
#endif

#ifdef HALFSHADOW_HAS_DRACO
scene::SceneDescription dracoBall(int quantizationBits) {
  const Shape& shape = ball();
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(shape.indices.size() / 3));
  const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    builder.SetAttributeValuesForFace(
        attribute, draco::FaceIndex(static_cast<std::uint32_t>(i / 3)), &shape.positions[shape.indices[i]].x,
        &shape.positions[shape.indices[i + 1]].x, &shape.positions[shape.indices[i + 2]].x);
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  if (quantizationBits > 0)
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, quantizationBits);
  draco::EncoderBuffer encoded;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &encoded).ok());
  GltfWriter writer;
  const int view = writer.addView(std::vector<char>(encoded.data(), encoded.data() + encoded.size()));
  const int position =
      writer.addAccessor({{"componentType", 5126}, {"count", mesh->num_points()}, {"type", "VEC3"}});
  const int index =
      writer.addAccessor({{"componentType", 5125}, {"count", shape.indices.size()}, {"type", "SCALAR"}});
  writer.addPrimitive({{"attributes", {{"POSITION", position}}},
                       {"indices", index},
                       {"extensions",
                        {{"KHR_draco_mesh_compression",
                          {{"bufferView", view},
                           {"attributes", {{"POSITION", mesh->attribute(attribute)->unique_id()}}}}}}}});
  writer.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const auto result = writer.load();
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return result.ok() ? *result : scene::SceneDescription{};
}

TEST(GltfCompression, DracoComesBackWithinItsQuantisation) {
  std::vector<glm::dvec3> plain;
  const auto mesh = meshOf(ball());
  for (const std::uint32_t i : mesh->indices) plain.emplace_back(mesh->positions[i]);
  for (const int bits : {0, 8, 14}) {
    const scene::SceneDescription description = dracoBall(bits);
    ASSERT_EQ(description.objects.size(), 1u) << bits;
    EXPECT_EQ(description.objects[0].mesh->triangleCount(), mesh->triangleCount()) << bits;
    EXPECT_TRUE(description.objects[0].mesh->statistics.closed()) << bits;
    // Half a step of the box's longest side, along each axis.
    const double step = bits == 0 ? 0.0 : 3.0 / ((1 << bits) - 1);
    EXPECT_LE(farthest(plain, cornersOf(description)), std::sqrt(3.0) * 0.5 * step + 1e-6) << bits;
  }
}
#endif

TEST(GltfCompression, DamagedDataIsNamed) {
  for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    GltfWriter writer = testing::quadWriter();
    if (std::string(extension) == "KHR_draco_mesh_compression") {
      writer.primitive()["extensions"][extension] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    } else {
      writer.json["bufferViews"][0]["extensions"][extension] = {
          {"buffer", 0}, {"byteLength", 48}, {"byteStride", 12}, {"count", 4}, {"mode", "ATTRIBUTES"}};
    }
    writer.json["extensionsRequired"] = {extension};
    const auto result = writer.load();
    ASSERT_FALSE(result.ok()) << extension;
    EXPECT_NE(result.error().message.find(extension), std::string::npos) << result.error().message;
    EXPECT_NE(result.error().message.find("uncompressed"), std::string::npos) << "what to do";
  }
}

}  // namespace
}  // namespace halfshadow::scenes
