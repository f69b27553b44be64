// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "api/engine_state.hpp"

namespace halfshadow {
namespace {
const char* formatName(device::TextureFormat format) {
  switch (format) {
    case device::TextureFormat::rgba8:
      return "rgba8";
    case device::TextureFormat::rgb8:
      return "rgb8";
    case device::TextureFormat::alpha8:
      return "alpha8";
    case device::TextureFormat::luminance8:
      return "luminance8";
    case device::TextureFormat::depth16:
      return "depth16";
    case device::TextureFormat::depth24:
      return "depth24";
    case device::TextureFormat::depth24Stencil8:
      return "depth24-stencil8";
  }
  return "";
}

ImageRecord recordOf(const std::string& name, const gl::Texture& texture) {
  return {.name = name.c_str(),
          .texture = texture.name(),
          .width = texture.desc().width,
          .height = texture.desc().height,
          .format = formatName(texture.desc().format)};
}
}  // namespace

std::vector<ImageRecord> Engine::State::images() const {
  std::vector<ImageRecord> records;
  if (!lastFrame || !lastFrame->valid || context->lost()) return records;
  const framegraph::Graph& graph = lastFrame->graph;
  for (std::uint32_t i = 0; i < graph.resources().size(); ++i) {
    const gl::Texture* texture = executor->texture(graph, {i});
    if (texture == nullptr) continue;
    std::erase_if(records, [&](const ImageRecord& record) { return record.texture == texture->name(); });
    records.push_back(recordOf(graph.resources()[i].name, *texture));
  }
  for (const std::uint32_t number : lightNumbers) {
    const LightCache& cache = lightCaches[number];
    if (!cache.passes) continue;
    cache.passes->visitTextures([&](const std::string& name, const gl::Texture& texture) {
      records.push_back(recordOf(name, texture));
    });
  }
  return records;
}

std::size_t Engine::images(ImageRecord* records, std::size_t capacity) const {
  const std::vector<ImageRecord> all = state_->images();
  if (records != nullptr) std::ranges::copy_n(all.begin(), std::min(all.size(), capacity), records);
  return all.size();
}

}  // namespace halfshadow
