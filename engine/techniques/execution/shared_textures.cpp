// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/shared_textures.hpp"

namespace halfshadow::techniques {

Result<const gl::Texture*> SharedTextures::get(gl::Context& context, const PlannedTexture& planned) {
  gl::Texture& texture = textures_[planned.name];
  if (!texture) {
    auto made = gl::Texture::create(context, planned.desc, planned.pixels()->data());
    if (!made) return made.error();
    texture = std::move(made).value();
  }
  return const_cast<const gl::Texture*>(&texture);
}

}  // namespace halfshadow::techniques
