// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Textures as data. No GL.
#pragma once

#include <optional>

namespace halfshadow::device {

enum class TextureFormat {
  rgba8,
  rgb8,
  alpha8,
  luminance8,
  depth16,         ///< OES_depth_texture
  depth24,         ///< OES_depth_texture, UNSIGNED_INT
  depth24Stencil8  ///< packed; sampled depth
};
enum class TextureFilter { nearest, linear, linearMipNearest, linearMipLinear, nearestMipNearest };
enum class TextureWrap { clampToEdge, repeat, mirroredRepeat };

struct TextureDesc {
  int width = 0, height = 0;
  TextureFormat format = TextureFormat::rgba8;
  TextureFilter filter = TextureFilter::nearest;
  TextureWrap wrap = TextureWrap::clampToEdge;  ///< along u
  std::optional<TextureWrap> wrapV{};           ///< along v; none: as along u
  bool mipmapped = false;  ///< the whole chain is allocated; width and height are then powers of two
  bool operator==(const TextureDesc&) const = default;
};

}  // namespace halfshadow::device
