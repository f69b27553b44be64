// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/pass_plan.hpp"

#include <algorithm>

namespace halfshadow::techniques {

std::uint32_t PassPlan::addProgram(device::ProgramVariant variant) {
  const auto known = std::ranges::find(programs, variant);
  const auto index = static_cast<std::uint32_t>(known - programs.begin());
  if (known == programs.end()) programs.push_back(std::move(variant));
  return index;
}

framegraph::ResourceId PassPlan::addImage(framegraph::ResourceDesc desc) {
  images.push_back(std::move(desc));
  imageIsShared.push_back(false);
  return {static_cast<std::uint32_t>(images.size() - 1)};
}

framegraph::ResourceId PassPlan::addSharedImage(framegraph::ResourceDesc desc) {
  const framegraph::ResourceId image = addImage(std::move(desc));
  imageIsShared.back() = true;
  return image;
}

std::uint32_t PassPlan::addTexture(PlannedTexture texture) {
  textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(textures.size() - 1);
}

std::uint32_t PassPlan::addBuffer(PlannedBuffer buffer) {
  buffers.push_back(std::move(buffer));
  return static_cast<std::uint32_t>(buffers.size() - 1);
}

std::span<const DrawItem> PassPlan::keep(std::vector<DrawItem> items) {
  kept_.push_back(std::make_unique<std::vector<DrawItem>>(std::move(items)));
  return *kept_.back();
}

FilterSkip preferredSkip(const LightScene& scene) {
  return filterSkipFromName(scene.settings.choice("filter_skip"));
}

bool hasShortPrograms(const LightScene& scene) {
  return scene.settings.choice("program_size") != "full";
}

bool hasProgramsInParts(const LightScene& scene) {
  return scene.settings.choice("program_size") == "parts";
}

}  // namespace halfshadow::techniques
