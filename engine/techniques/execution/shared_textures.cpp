// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/shared_textures.hpp"

namespace halfshadow::techniques {

void SharedTextures::beginFrame() {
  for (auto& [name, shared] : textures_) shared.used = false;
}

void SharedTextures::endFrame() {
  std::erase_if(textures_, [](const auto& entry) { return !entry.second.used; });
}

Result<const gl::Texture*> SharedTextures::get(gl::Context& context, const PlannedTexture& planned) {
  auto& [texture, used] = textures_[planned.name];
  used = true;
  if (!texture) {
    auto made = gl::Texture::create(context, planned.desc, planned.pixels()->data());
    if (!made) return made.error();
    texture = std::move(made).value();
  }
  return const_cast<const gl::Texture*>(&texture);
}

}  // namespace halfshadow::techniques
