// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A host's base colour image as textures (internal).
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/content_hash.hpp"
#include "gl/objects.hpp"
#include "halfshadow/types.hpp"
#include "scene/cut_by_alpha.hpp"

namespace halfshadow::api {

/// Checks what a description says of images and alpha. Errors: invalidArgument.
Status checkSurface(const ObjectDesc& desc);

/// Texels as they are uploaded.
struct SurfaceImage {
  device::TextureDesc desc;
  std::vector<std::uint8_t> bytes;
};

/// A host's image on the GPU, and once more beside it, for the next context; all objects that show it share
/// both.
class SurfaceTexture {
 public:
  explicit SurfaceTexture(SurfaceImage image) : image_(std::move(image)) {}
  /// Unless it is there already. Errors: outOfMemory, contextLost.
  Status upload(gl::Context& context);
  void forgetUpload() { texture_ = {}; }  ///< the context is gone
  const gl::Texture& texture() const { return texture_; }
  /// Of a mask: what it cuts out of meshes.
  scene::AlphaCut cut(float cutoff) const;

 private:
  SurfaceImage image_;
  mutable std::shared_ptr<const scene::Image> alpha_;  ///< of a mask, once it was asked for
  gl::Texture texture_;
};

enum class SurfaceImageKind { baseColor, alphaMask };

/// Finds what an earlier object uploaded of the same image, by all that matters of it.
class SurfaceStore {
 public:
  /// Null: no image, or for a mask no cutoff. Errors: outOfMemory, contextLost.
  Result<std::shared_ptr<SurfaceTexture>> find(gl::Context& context, const ObjectDesc& desc,
                                               SurfaceImageKind kind);

 private:
  std::unordered_map<ContentKey, std::weak_ptr<SurfaceTexture>, ContentKey::Hash> textures_;
  std::size_t sweepAt_ = 64;  ///< so many entries are looked through for those that nobody holds any more
};

}  // namespace halfshadow::api
