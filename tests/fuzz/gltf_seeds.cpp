// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gltf_seeds.hpp"

#include "gltf_writer.hpp"
#include "scenes/shapes.hpp"

#ifdef HALFSHADOW_HAS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef HALFSHADOW_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace halfshadow::fuzz {
namespace {
using scenes::testing::GltfWriter;
using scenes::testing::Json;
using scenes::testing::kFloat;
using scenes::testing::kShort;
using scenes::testing::kUnsignedByte;
using scenes::testing::kUnsignedInt;
using scenes::testing::kUnsignedShort;
using scenes::testing::quadWriter;

/// 2 × 2 pixels, one of each column transparent.
constexpr std::uint8_t kPng[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49,
                                 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x06,
                                 0x00, 0x00, 0x00, 0x72, 0xb6, 0x0d, 0x24, 0x00, 0x00, 0x00, 0x14, 0x49, 0x44,
                                 0x41, 0x54, 0x78, 0xda, 0x63, 0x38, 0x91, 0x62, 0xf4, 0x9f, 0x4b, 0x44, 0x8e,
                                 0x81, 0x01, 0xc6, 0x00, 0x00, 0x36, 0xf9, 0x05, 0x33, 0x47, 0x71, 0x12, 0x17,
                                 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

GltfWriter geometry() {
  GltfWriter writer = quadWriter();
  const int sparseIndices = writer.addView(std::vector<std::uint8_t>{3});
  const int sparseValues = writer.addView(std::vector<float>{2, 2, 0});
  writer.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", sparseIndices}, {"componentType", 5121}}},
      {"values", {{"bufferView", sparseValues}}}};
  const int strip =
      writer.addAccessor(std::vector<float>{0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1, 0, 2, 1}, kFloat, "VEC3", 3);
  for (const int mode : {1, 4, 5, 6}) {
    Json primitive = {{"attributes", {{"POSITION", strip}}}, {"mode", mode}};
    if (mode == 4)
      primitive["indices"] =
          writer.addAccessor(std::vector<std::uint8_t>{0, 1, 2}, kUnsignedByte, "SCALAR", 1);
    writer.addPrimitive(primitive);
  }
  const int packed =
      writer.addView(std::vector<std::int16_t>{-32767, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0}, 8);
  const int position = writer.addAccessor({{"bufferView", packed},
                                           {"componentType", kShort},
                                           {"count", 3},
                                           {"type", "VEC3"},
                                           {"normalized", true}});
  writer.addPrimitive({{"attributes", {{"POSITION", position}}}});
  writer.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  return writer;
}

GltfWriter nodesCamerasLights() {
  GltfWriter writer = quadWriter();
  const int places = writer.addAccessor(std::vector<float>{0, 0, 0, 3, 0, 0}, kFloat, "VEC3", 3);
  writer.json["cameras"] =
      Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
                   {{"type", "orthographic"},
                    {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 50}}}}});
  writer.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "spot"},
                    {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}},
                    {"extras", {{"halfshadow", {{"size", {2, 0.5}}}}}}},
                   {{"type", "point"}, {"intensity", 200}, {"color", {1, 0.5, 0}}},
                   {{"type", "directional"}}});
  const auto light = [](int index) { return Json{{"KHR_lights_punctual", {{"light", index}}}}; };
  writer.json["nodes"] = Json::array(
      {{{"children", {1, 2}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}},
       {{"mesh", 0},
        {"translation", {0, 5, 0}},
        {"rotation", {0, 0, 0.6, 0.8}},
        {"scale", {2, -1, 1}},
        {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}},
       {{"mesh", 0},
        {"extras", {{"halfshadow", {{"casts", false}, {"receives", true}}}}},
        {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}},
       {{"camera", 0}, {"translation", {0, 4, 9}}, {"extensions", light(0)}},
       {{"translation", {0, 9, 0}}, {"extensions", light(1)}},
       {{"camera", 1}, {"rotation", {-0.6, 0, 0, 0.8}}, {"extensions", light(2)}}});
  writer.json["scenes"][0]["nodes"] = {0, 3, 4, 5};
  return writer;
}

GltfWriter deformed() {
  GltfWriter writer = quadWriter();
  const int offsets =
      writer.addAccessor(std::vector<float>{0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kFloat, "VEC3", 3);
  const int joints = writer.addAccessor(
      std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, kUnsignedByte, "VEC4", 4);
  const int weights = writer.addAccessor(
      std::vector<float>{.5f, .5f, 0, 0, 1, 0, 0, 0, .25f, .75f, 0, 0, 1, 0, 0, 0}, kFloat, "VEC4", 4);
  const int bind = writer.addAccessor(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                                         1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1},
                                      kFloat, "MAT4", 16);
  writer.primitive()["targets"] = Json::array({{{"POSITION", offsets}}});
  writer.primitive()["attributes"]["JOINTS_0"] = joints;
  writer.primitive()["attributes"]["WEIGHTS_0"] = weights;
  writer.json["skins"] = Json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", bind}}});
  writer.json["nodes"] = Json::array({{{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}},
                                      {{"translation", {0, 1, 0}}, {"children", {2}}},
                                      {{"rotation", {0, 0, 0.6, 0.8}}}});
  writer.json["scenes"][0]["nodes"] = {0, 1};
  const int times = writer.addAccessor(std::vector<float>{0, 1}, kFloat, "SCALAR", 1);
  const auto values = [&](std::vector<float> numbers, const char* type, std::size_t components) {
    return writer.addAccessor(numbers, kFloat, type, components);
  };
  Json channels = Json::array(), samplers = Json::array();
  const auto add = [&](Json target, int output, const char* interpolation) {
    channels.push_back({{"sampler", samplers.size()}, {"target", std::move(target)}});
    samplers.push_back({{"input", times}, {"output", output}, {"interpolation", interpolation}});
  };
  add({{"node", 1}, {"path", "translation"}}, values({0, 0, 0, 2, 0, 0}, "VEC3", 3), "LINEAR");
  add({{"node", 2}, {"path", "rotation"}}, values({0, 0, 0, 1, 0, 0, -.6f, -.8f}, "VEC4", 4), "LINEAR");
  add({{"node", 0}, {"path", "weights"}}, values({0, 0, 1, 0, 1, 0}, "SCALAR", 1), "CUBICSPLINE");
  add({{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/1/scale"}}}}}},
      values({1, 1, 1, 2, 2, 2}, "VEC3", 3), "STEP");
  writer.json["animations"] = Json::array({{{"channels", channels}, {"samplers", samplers}}});
  return writer;
}

GltfWriter textured() {
  GltfWriter writer = quadWriter();
  const int image = writer.addView(std::vector<std::uint8_t>(std::begin(kPng), std::end(kPng)));
  Json& attributes = writer.primitive()["attributes"];
  attributes["NORMAL"] =
      writer.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3", 3);
  attributes["TEXCOORD_0"] =
      writer.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, kFloat, "VEC2", 2);
  attributes["TEXCOORD_1"] = writer.addAccessor(
      std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535, 65535, 65535}, kUnsignedShort, "VEC2", 2);
  writer.json["accessors"].back()["normalized"] = true;
  attributes["COLOR_0"] = writer.addAccessor(
      std::vector<float>{1, 1, 1, 1, 1, 0, 0, 1, 0, 1, 0, .5f, 0, 0, 1, 1}, kFloat, "VEC4", 4);
  writer.primitive()["material"] = 0;
  writer.json["images"] = Json::array({{{"bufferView", image}, {"mimeType", "image/png"}}});
  writer.json["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
  writer.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}});
  writer.json["materials"] = Json::array(
      {{{"alphaMode", "MASK"},
        {"alphaCutoff", 0.4},
        {"doubleSided", true},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {1, 1, 1, 0.9}},
          {"baseColorTexture",
           {{"index", 0},
            {"texCoord", 1},
            {"extensions",
             {{"KHR_texture_transform", {{"offset", {0.1, 0}}, {"rotation", 0.5}, {"scale", {2, 2}}}}}}}}}}},
       {{"alphaMode", "BLEND"}}});
  return writer;
}

#ifdef HALFSHADOW_HAS_MESHOPT
GltfWriter meshopt() {
  const scenes::Shape shape = scenes::icosphereShape({1, 2, 3}, 1.5, 1);
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
    stored["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
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
      {{"bufferView", pointsView}, {"componentType", kFloat}, {"count", vertices}, {"type", "VEC3"}});
  const int index = writer.addAccessor(
      {{"bufferView", cornersView}, {"componentType", kUnsignedInt}, {"count", indices}, {"type", "SCALAR"}});
  writer.addPrimitive({{"attributes", {{"POSITION", position}}}, {"indices", index}});
  writer.furtherBuffers.push_back({{"byteLength", vertices * 12 + indices * 4},
                                   {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  writer.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  return writer;
}
#endif

#ifdef HALFSHADOW_HAS_DRACO
GltfWriter draco() {
  const scenes::Shape shape = scenes::icosphereShape({1, 2, 3}, 1.5, 0);
  ::draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(shape.indices.size() / 3));
  const int attribute = builder.AddAttribute(::draco::GeometryAttribute::POSITION, 3, ::draco::DT_FLOAT32);
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    builder.SetAttributeValuesForFace(attribute, ::draco::FaceIndex(static_cast<std::uint32_t>(i / 3)),
                                      &shape.positions[shape.indices[i]].x,
                                      &shape.positions[shape.indices[i + 1]].x,
                                      &shape.positions[shape.indices[i + 2]].x);
  }
  const auto mesh = builder.Finalize();
  ::draco::Encoder encoder;
  encoder.SetAttributeQuantization(::draco::GeometryAttribute::POSITION, 11);
  ::draco::EncoderBuffer encoded;
  require(encoder.EncodeMeshToBuffer(*mesh, &encoded).ok(), "the Draco seed cannot be encoded");
  GltfWriter writer;
  const int view = writer.addView(std::vector<char>(encoded.data(), encoded.data() + encoded.size()));
  const int position =
      writer.addAccessor({{"componentType", kFloat}, {"count", mesh->num_points()}, {"type", "VEC3"}});
  const int index = writer.addAccessor(
      {{"componentType", kUnsignedInt}, {"count", shape.indices.size()}, {"type", "SCALAR"}});
  writer.addPrimitive({{"attributes", {{"POSITION", position}}},
                       {"indices", index},
                       {"extensions",
                        {{"KHR_draco_mesh_compression",
                          {{"bufferView", view},
                           {"attributes", {{"POSITION", mesh->attribute(attribute)->unique_id()}}}}}}}});
  writer.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return writer;
}
#endif

/// The quad as text, its buffer in a data URI.
std::string asText() {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36}],"buffers":[{"byteLength":36,)"
         R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}
}  // namespace

std::vector<Bytes> gltfSeeds() {
  std::vector<Bytes> seeds = {bytesOf(asText())};
  for (const auto make : {quadWriter, geometry, nodesCamerasLights, deformed, textured})
    seeds.push_back(bytesOf(make().glb()));
#ifdef HALFSHADOW_HAS_MESHOPT
  seeds.push_back(bytesOf(meshopt().glb()));
#endif
#ifdef HALFSHADOW_HAS_DRACO
  seeds.push_back(bytesOf(draco().glb()));
#endif
  return seeds;
}

std::vector<std::string> gltfWords() {
  return {"\"mesh\":",
          "\"nodes\":[",
          "\"children\":[0]",
          "\"bufferView\":",
          "\"byteOffset\":",
          "\"byteLength\":",
          "\"byteStride\":",
          "\"count\":",
          "\"type\":\"VEC3\"",
          "\"type\":\"MAT4\"",
          "\"sparse\":",
          "\"skin\":0",
          "\"matrix\":[",
          "\"normalized\":true",
          "\"extensions\":{",
          "\"extras\":",
          "\"weights\":",
          "\"mode\":",
          "\"uri\":\"",
          "null",
          "true",
          "[]",
          "{}",
          ",",
          "\""};
}

}  // namespace halfshadow::fuzz
