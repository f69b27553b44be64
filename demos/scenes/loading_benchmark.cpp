// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What opening a .glb costs over reading and decoding its parts: the file's bytes, tinygltf's parse, Draco
/// and the base colours, one after another. Both are timed in turn; medians, as JSON.
///
/// Processor time is that of all threads, and says what a busy machine would pay.
///
///   halfshadow_loading_benchmark model.glb [runs, 9 unless given]
#include <tiny_gltf.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "images/images.hpp"
#include "scenes/scene_source.hpp"

#ifdef HALFSHADOW_HAS_DRACO
#include <draco/compression/decode.h>
#endif

namespace halfshadow {
namespace {
using Bytes = std::vector<unsigned char>;

struct Parts {
  double parseMs = 0.0, imagesMs = 0.0, dracoMs = 0.0, processorMs = 0.0;
  double totalMs() const { return parseMs + imagesMs + dracoMs; }
};

class Stopwatch {
 public:
  double processorMs() const {
    return 1e3 * static_cast<double>(std::clock() - processorStart_) / CLOCKS_PER_SEC;
  }
  double ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t processorStart_ = std::clock();
};

bool leaveEncoded(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                  int, void*) {
  return true;
}

std::span<const unsigned char> bytesOf(const tinygltf::Model& model, int view) {
  const tinygltf::BufferView& range = model.bufferViews.at(static_cast<std::size_t>(view));
  const Bytes& buffer = model.buffers.at(static_cast<std::size_t>(range.buffer)).data;
  return std::span(buffer).subspan(range.byteOffset, range.byteLength);
}

void decodeImages(const tinygltf::Model& model) {
  std::set<int> images;
  for (const tinygltf::Material& material : model.materials) {
    const int texture = material.pbrMetallicRoughness.baseColorTexture.index;
    if (texture >= 0) images.insert(model.textures.at(static_cast<std::size_t>(texture)).source);
  }
  for (const int image : images) {
    const auto bytes = bytesOf(model, model.images.at(static_cast<std::size_t>(image)).bufferView);
    const auto decoded = images::decodeImage(bytes, bytes[0] == 0xFF ? "jpeg" : "png");
    if (!decoded) std::fprintf(stderr, "%s\n", decoded.error().message.c_str());
  }
}

void decodeDraco(const tinygltf::Model& model) {
#ifdef HALFSHADOW_HAS_DRACO
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto extension = primitive.extensions.find("KHR_draco_mesh_compression");
      if (extension == primitive.extensions.end()) continue;
      const auto bytes = bytesOf(model, extension->second.Get("bufferView").GetNumberAsInt());
      draco::DecoderBuffer buffer;
      buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      if (!draco::Decoder().DecodeMeshFromBuffer(&buffer).ok()) std::fprintf(stderr, "Draco fails\n");
    }
  }
#else
  static_cast<void>(model);
#endif
}

Parts timeParts(const std::string& path) {
  Parts parts;
  const Stopwatch all, parse;
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  Bytes bytes(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(leaveEncoded, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  if (!parser.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                   static_cast<unsigned>(bytes.size())))
    std::fprintf(stderr, "%s\n", error.c_str());
  parts.parseMs = parse.ms();
  const Stopwatch images;
  decodeImages(model);
  parts.imagesMs = images.ms();
  const Stopwatch draco;
  decodeDraco(model);
  parts.dracoMs = draco.ms();
  parts.processorMs = all.processorMs();
  return parts;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

int run(const std::string& path, int runs) {
  std::vector<double> parse, images, draco, whole, ratio, processorRatio;
  for (int i = 0; i < runs; ++i) {
    const Parts parts = timeParts(path);
    const Stopwatch open;
    const auto scene = scenes::openScene(path, {});
    const double openMs = open.ms(), openProcessorMs = open.processorMs();
    if (!scene) {
      std::fprintf(stderr, "%s\n", scene.error().message.c_str());
      return 2;
    }
    parse.push_back(parts.parseMs), images.push_back(parts.imagesMs), draco.push_back(parts.dracoMs);
    whole.push_back(openMs), ratio.push_back(openMs / parts.totalMs());
    processorRatio.push_back(openProcessorMs / parts.processorMs);
  }
  std::printf(
      "{\"file\": \"%s\", \"runs\": %d, \"parse_ms\": %.1f, \"images_ms\": %.1f, \"draco_ms\": %.1f, "
      "\"open_ms\": %.1f, \"open_over_parts\": %.3f, \"processor_over_parts\": %.3f}\n",
      path.c_str(), runs, median(parse), median(images), median(draco), median(whole), median(ratio),
      median(processorRatio));
  return 0;
}
}  // namespace
}  // namespace halfshadow

int main(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: halfshadow_loading_benchmark model.glb [runs]\n");
    return 2;
  }
  return halfshadow::run(arguments[1], count > 2 ? std::max(std::atoi(arguments[2]), 1) : 9);
}
