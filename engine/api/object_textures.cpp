// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/object_textures.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace halfshadow::api {
namespace {
/// Sides of the largest images that any device samples: what claims more is a mistake, and would be read past
/// its end.
constexpr int kLongestSide = 65536;

/// Some channels of an image, `each` bytes a texel.
struct Texels {
  std::size_t width = 1, height = 1, each = 1;
  std::vector<std::uint8_t> bytes{255};
};

/// `each` 4: colours, opaque; 1: alpha.
Texels texelsOf(const ObjectDesc& desc, std::size_t each) {
  const auto channels = static_cast<std::size_t>(desc.baseColorChannels);
  Texels texels{static_cast<std::size_t>(desc.baseColorWidth), static_cast<std::size_t>(desc.baseColorHeight),
                each};
  texels.bytes.resize(texels.width * texels.height * each);
  const std::uint8_t* source = desc.baseColorPixels;
  for (std::uint8_t* target = texels.bytes.data(); target != texels.bytes.data() + texels.bytes.size();
       target += each, source += channels) {
    if (each == 1) {
      *target = channels == 4 ? source[3] : 255;
    } else {
      target[0] = source[0], target[1] = source[1], target[2] = source[2], target[3] = 255;
    }
  }
  return texels;
}

/// Where a row or column of another size reads: its two neighbours and the share of the second.
struct Between {
  std::size_t first = 0, second = 0;
  double share = 0.0;
};
Between between(std::size_t place, std::size_t from, std::size_t to, ImageWrap wrap) {
  const double at =
      (static_cast<double>(place) + 0.5) * static_cast<double>(from) / static_cast<double>(to) - 0.5;
  const auto low = static_cast<long long>(std::floor(at));
  const auto last = static_cast<long long>(from) - 1;
  const auto inside = [&](long long i) {
    if (i >= 0 && i <= last) return static_cast<std::size_t>(i);
    const bool repeats = wrap == ImageWrap::repeat;
    return static_cast<std::size_t>(repeats ? (i < 0 ? last : 0) : std::clamp<long long>(i, 0, last));
  };
  return {inside(low), inside(low + 1), at - static_cast<double>(low)};
}

Texels resized(const Texels& source, std::size_t width, std::size_t height, const ObjectDesc& desc) {
  Texels result{width, height, source.each};
  result.bytes.resize(width * height * source.each);
  const bool nearest = desc.baseColorFilter == ImageFilter::nearest;
  for (std::size_t y = 0; y < height; ++y) {
    const Between row = between(y, source.height, height, desc.baseColorWrapV);
    for (std::size_t x = 0; x < width; ++x) {
      const Between column = between(x, source.width, width, desc.baseColorWrapU);
      const double u = nearest ? std::round(column.share) : column.share;
      const double v = nearest ? std::round(row.share) : row.share;
      for (std::size_t c = 0; c < source.each; ++c) {
        const auto at = [&](std::size_t ry, std::size_t cx) {
          return static_cast<double>(source.bytes[(ry * source.width + cx) * source.each + c]);
        };
        const double top = at(row.first, column.first) * (1 - u) + at(row.first, column.second) * u;
        const double bottom = at(row.second, column.first) * (1 - u) + at(row.second, column.second) * u;
        result.bytes[(y * width + x) * source.each + c] =
            static_cast<std::uint8_t>(std::lround(top * (1 - v) + bottom * v));
      }
    }
  }
  return result;
}

bool reachesBeyondImage(const ObjectDesc& desc) {
  if (desc.mesh.texcoords == nullptr) return false;
  const float* end = desc.mesh.texcoords + std::size_t{2} * desc.mesh.vertexCount;
  return std::any_of(desc.mesh.texcoords, end, [](float t) { return t < 0.0f || t > 1.0f; });
}

bool needsPowersOfTwo(const ObjectDesc& desc) {
  return (desc.baseColorWrapU != ImageWrap::clampToEdge || desc.baseColorWrapV != ImageWrap::clampToEdge) &&
         reachesBeyondImage(desc);
}

/// ES 2.0 repeats images of sizes that are powers of two, and no others: those become such ones where it
/// matters, and ones above the device's limit are brought below it.
Texels fitted(int sizeLimit, Texels texels, const ObjectDesc& desc) {
  const auto limit = static_cast<std::size_t>(sizeLimit);
  const bool repeats = needsPowersOfTwo(desc);
  const auto side = [&](std::size_t size) {
    return std::min(repeats ? std::bit_ceil(size) : size, std::bit_floor(limit));
  };
  const std::size_t width = side(texels.width), height = side(texels.height);
  if (width == texels.width && height == texels.height) return texels;
  return resized(texels, width, height, desc);
}

device::TextureWrap wrapOf(ImageWrap wrap) {
  if (wrap == ImageWrap::clampToEdge) return device::TextureWrap::clampToEdge;
  return wrap == ImageWrap::repeat ? device::TextureWrap::repeat : device::TextureWrap::mirroredRepeat;
}

ImageWrap hostWrapOf(device::TextureWrap wrap) {
  if (wrap == device::TextureWrap::clampToEdge) return ImageWrap::clampToEdge;
  return wrap == device::TextureWrap::repeat ? ImageWrap::repeat : ImageWrap::mirroredRepeat;
}

device::TextureDesc textureDesc(const Texels& texels, const ObjectDesc& desc) {
  const bool powers = std::has_single_bit(texels.width) && std::has_single_bit(texels.height);
  device::TextureDesc result{.width = static_cast<int>(texels.width),
                             .height = static_cast<int>(texels.height)};
  result.filter = desc.baseColorFilter == ImageFilter::nearest ? device::TextureFilter::nearest
                                                               : device::TextureFilter::linear;
  result.wrap = powers ? wrapOf(desc.baseColorWrapU) : device::TextureWrap::clampToEdge;
  result.wrapV = powers ? wrapOf(desc.baseColorWrapV) : device::TextureWrap::clampToEdge;
  return result;
}
}  // namespace

Status checkSurface(const ObjectDesc& desc) {
  const int channels = desc.baseColorChannels, longer = std::max(desc.baseColorWidth, desc.baseColorHeight);
  if (desc.baseColorPixels && (std::min(desc.baseColorWidth, desc.baseColorHeight) <= 0 ||
                               longer > kLongestSide || (channels != 3 && channels != 4))) {
    return Error{ErrorCode::invalidArgument,
                 "a base colour image needs sides of 1 to 65536 texels and 3 or 4 channels"};
  }
  for (const float component : desc.baseColor) {
    if (!std::isfinite(component))
      return Error{ErrorCode::invalidArgument, "the object's base colour has a NaN or infinite component"};
  }
  if (!(desc.alphaCutoff >= 0.0f && desc.alphaCutoff <= 1.0f)) {
    return Error{ErrorCode::invalidArgument, "alphaCutoff must be a number from 0 (no holes) to 1"};
  }
  return {};
}

namespace {
/// Colours alone, with mips where the size is a power of two. `sizeLimit`: of the device's textures.
SurfaceImage baseColorImage(int sizeLimit, const ObjectDesc& desc) {
  Texels texels = fitted(sizeLimit, texelsOf(desc, 4), desc);
  device::TextureDesc texture = textureDesc(texels, desc);
  texture.mipmapped = std::has_single_bit(texels.width) && std::has_single_bit(texels.height);
  if (texture.mipmapped && desc.baseColorFilter == ImageFilter::linear)
    texture.filter = device::TextureFilter::linearMipLinear;
  if (texture.mipmapped && desc.baseColorFilter == ImageFilter::nearest)
    texture.filter = device::TextureFilter::nearestMipNearest;
  return {texture, std::move(texels.bytes)};
}

/// Alpha alone, without mips: a hole is as large from far away as from near. One opaque texel without an
/// image.
SurfaceImage alphaMaskImage(int sizeLimit, const ObjectDesc& desc) {
  const bool hasImage = desc.baseColorPixels != nullptr;
  Texels texels = hasImage ? fitted(sizeLimit, texelsOf(desc, 1), desc) : Texels();
  device::TextureDesc texture = textureDesc(texels, desc);
  texture.format = device::TextureFormat::alpha8;
  return {texture, std::move(texels.bytes)};
}

ContentKey keyOf(const ObjectDesc& desc, SurfaceImageKind kind) {
  ContentHasher hasher;
  hasher.add(static_cast<std::uint64_t>(kind));
  if (desc.baseColorPixels == nullptr) return hasher.key();
  const auto width = static_cast<std::size_t>(desc.baseColorWidth),
             height = static_cast<std::size_t>(desc.baseColorHeight),
             channels = static_cast<std::size_t>(desc.baseColorChannels);
  for (const std::uint64_t value : {width, height, channels}) hasher.add(value);
  hasher.add(static_cast<std::uint64_t>(desc.baseColorWrapU));
  hasher.add(static_cast<std::uint64_t>(desc.baseColorWrapV));
  hasher.add(static_cast<std::uint64_t>(desc.baseColorFilter));
  hasher.add(needsPowersOfTwo(desc) ? 1u : 0u);
  hasher.add(desc.baseColorPixels, width * height * channels);
  return hasher.key();
}
}  // namespace

Status SurfaceTexture::upload(gl::Context& context) {
  if (texture_) return {};
  auto made = gl::Texture::create(context, image_.desc, image_.bytes.data());
  if (!made) return made.error();
  if (image_.desc.mipmapped) made->generateMipmaps(context);
  texture_ = std::move(made).value();
  return {};
}

scene::AlphaCut SurfaceTexture::cut(float cutoff) const {
  const device::TextureDesc& desc = image_.desc;
  if (!alpha_)
    alpha_ = std::make_shared<const scene::Image>(
        scene::Image{.width = desc.width, .height = desc.height, .channels = 1, .pixels = image_.bytes});
  return {.mask = alpha_,
          .sampling = {.wrapU = hostWrapOf(desc.wrap),
                       .wrapV = hostWrapOf(desc.wrapV.value_or(desc.wrap)),
                       .filter = desc.filter == device::TextureFilter::nearest ? ImageFilter::nearest
                                                                               : ImageFilter::linear},
          .cutoff = cutoff};
}

Result<std::shared_ptr<SurfaceTexture>> SurfaceStore::find(gl::Context& context, const ObjectDesc& desc,
                                                           SurfaceImageKind kind) {
  const bool isMask = kind == SurfaceImageKind::alphaMask;
  if (isMask ? !(desc.alphaCutoff > 0.0f) : desc.baseColorPixels == nullptr)
    return std::shared_ptr<SurfaceTexture>();
  if (textures_.size() >= sweepAt_) {
    std::erase_if(textures_, [](const auto& entry) { return entry.second.expired(); });
    sweepAt_ = std::max<std::size_t>(64, 2 * textures_.size());
  }
  std::weak_ptr<SurfaceTexture>& known = textures_[keyOf(desc, kind)];
  if (auto texture = known.lock()) return texture;
  const int limit = context.capabilities().limits.textureSize;
  auto made =
      std::make_shared<SurfaceTexture>(isMask ? alphaMaskImage(limit, desc) : baseColorImage(limit, desc));
  if (Status status = made->upload(context); !status) return status.error();
  known = made;
  return made;
}

}  // namespace halfshadow::api
