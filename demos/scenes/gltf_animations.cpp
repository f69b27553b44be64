// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_animations.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

Result<std::vector<AnimationInfo>> gltfAnimations(const std::string& path) {
  const auto file = parseGltfFile(path);
  if (!file) return Error{file.error().code, path + ": " + file.error().message};
  const tinygltf::Model& model = file->model;
  std::vector<AnimationInfo> animations;
  for (const tinygltf::Animation& animation : model.animations) {
    AnimationInfo info{animation.name.empty() ? std::to_string(animations.size()) : animation.name};
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
      if (sampler.input < 0 || static_cast<std::size_t>(sampler.input) >= model.accessors.size()) continue;
      // glTF 2.0, section 3.11: the accessor of the key times has its bounds.
      const auto& last = model.accessors[static_cast<std::size_t>(sampler.input)].maxValues;
      if (!last.empty() && std::isfinite(last[0])) info.seconds = std::max(info.seconds, last[0]);
    }
    animations.push_back(std::move(info));
  }
  return animations;
}

}  // namespace halfshadow::scenes
