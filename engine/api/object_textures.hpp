// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A host's base colour image as textures (internal).
#pragma once

#include <cstdint>
#include <vector>

#include "gl/objects.hpp"
#include "halfshadow/types.hpp"

namespace halfshadow::api {

/// Checks what a description says of images and alpha. Errors: invalidArgument.
Status checkSurface(const ObjectDesc& desc);

/// Texels as they are uploaded; none: no texture.
struct SurfaceImage {
  device::TextureDesc desc;
  std::vector<std::uint8_t> bytes;
};

/// Colours alone, with mips where the size is a power of two. `sizeLimit`: of the device's textures.
SurfaceImage baseColorImage(int sizeLimit, const ObjectDesc& desc);

/// Alpha alone, without mips: a hole is as large from far away as from near. Of one opaque texel without an
/// image; none where there is no cutoff.
SurfaceImage alphaMaskImage(int sizeLimit, const ObjectDesc& desc);

/// No texture of no image. Errors: outOfMemory, contextLost.
Result<gl::Texture> textureOf(gl::Context& context, const SurfaceImage& image);

}  // namespace halfshadow::api
