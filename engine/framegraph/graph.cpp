// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "framegraph/graph.hpp"

#include <utility>

namespace halfshadow::framegraph {
namespace {
constexpr std::uint32_t kNotImported = ~0u;
}

std::uint64_t bytesPerPixel(Format format) {
  switch (format) {
    case Format::rgba8:
    case Format::depth24:  // drivers pad 24 bits to a word
    case Format::depth24Stencil8:
      return 4;
    case Format::depth16:
      return 2;
    case Format::stencil8:
      return 1;
  }
  return 0;
}

ResourceId Graph::addResource(ResourceDesc desc) {
  resources_.push_back(std::move(desc));
  importedOfResource_.push_back(kNotImported);
  return {static_cast<std::uint32_t>(resources_.size() - 1)};
}

ResourceId Graph::importTarget(std::string name, const ImportedTarget& target) {
  const ResourceId id = addResource({.name = std::move(name),
                                     .width = target.width,
                                     .height = target.height,
                                     .storage = Storage::renderbuffer,
                                     .lifetime = Lifetime::imported});
  importedOfResource_[id.index] = static_cast<std::uint32_t>(importedTargets_.size());
  importedTargets_.push_back(target);
  return id;
}

PassId Graph::addPass(PassDesc desc) {
  passes_.push_back(std::move(desc));
  return {static_cast<std::uint32_t>(passes_.size() - 1)};
}

void Graph::markOutput(ResourceId resource) {
  outputs_.push_back(resource);
}

void Graph::noteSkipped(std::string what, std::string why) {
  skipped_.push_back({std::move(what), std::move(why)});
}

std::size_t Graph::importedIndex(ResourceId resource) const {
  return resource.index < importedOfResource_.size() ? importedOfResource_[resource.index] : kNotImported;
}

}  // namespace halfshadow::framegraph
