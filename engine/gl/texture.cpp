// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <bit>

#include "gl/allocation.hpp"
#include "gl/objects.hpp"

namespace halfshadow::gl {
namespace {

struct TextureEncoding {
  GLenum format, type;
  std::size_t bytesPerTexel;
};

TextureEncoding encodingOf(TextureFormat format) {
  switch (format) {
    case TextureFormat::rgba8:
      return {GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case TextureFormat::rgb8:
      return {GL_RGB, GL_UNSIGNED_BYTE, 3};
    case TextureFormat::alpha8:
      return {GL_ALPHA, GL_UNSIGNED_BYTE, 1};
    case TextureFormat::luminance8:
      return {GL_LUMINANCE, GL_UNSIGNED_BYTE, 1};
    case TextureFormat::depth16:
      return {GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, 2};
    case TextureFormat::depth24:
      return {GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 4};
    case TextureFormat::depth24Stencil8:
      return {GL_DEPTH_STENCIL_OES, GL_UNSIGNED_INT_24_8_OES, 4};
  }
  return {GL_RGBA, GL_UNSIGNED_BYTE, 4};
}

GLint minFilterOf(TextureFilter filter) {
  switch (filter) {
    case TextureFilter::nearest:
      return GL_NEAREST;
    case TextureFilter::linear:
      return GL_LINEAR;
    case TextureFilter::linearMipNearest:
      return GL_LINEAR_MIPMAP_NEAREST;
    case TextureFilter::linearMipLinear:
      return GL_LINEAR_MIPMAP_LINEAR;
    case TextureFilter::nearestMipNearest:
      return GL_NEAREST_MIPMAP_NEAREST;
  }
  return GL_NEAREST;
}

GLint magFilterOf(TextureFilter filter) {
  return filter == TextureFilter::nearest || filter == TextureFilter::nearestMipNearest ? GL_NEAREST
                                                                                        : GL_LINEAR;
}

bool isPowerOfTwo(int value) {
  return std::has_single_bit(static_cast<unsigned>(value));
}

GLint glWrap(TextureWrap wrap) {
  if (wrap == TextureWrap::clampToEdge) return GL_CLAMP_TO_EDGE;
  return wrap == TextureWrap::repeat ? GL_REPEAT : GL_MIRRORED_REPEAT;
}

}  // namespace

std::size_t bytesPerTexel(TextureFormat format) {
  return encodingOf(format).bytesPerTexel;
}

Result<Texture> Texture::create(Context& context, const TextureDesc& desc, const void* pixels) {
  const std::string what = "Texture of " + sizeText(desc.width, desc.height);
  const int limit = context.capabilities().limits.textureSize;
  if (desc.width <= 0 || desc.height <= 0 || desc.width > limit || desc.height > limit) {
    return Error{ErrorCode::invalidArgument,
                 what + " is outside 1x1 to " + sizeText(limit, limit) + ", the limit of this driver."};
  }
  const bool powersOfTwo = isPowerOfTwo(desc.width) && isPowerOfTwo(desc.height);
  if (desc.mipmapped && !powersOfTwo) {
    return Error{ErrorCode::invalidArgument,
                 what + " cannot have mipmaps: OpenGL ES 2.0 needs powers of two."};
  }
  const TextureWrap wrapV = desc.wrapV.value_or(desc.wrap);
  const bool clamps = desc.wrap == TextureWrap::clampToEdge && wrapV == TextureWrap::clampToEdge;
  if (!clamps && !powersOfTwo) {
    return Error{ErrorCode::invalidArgument, what + " cannot repeat: OpenGL ES 2.0 needs powers of two."};
  }
  const bool filterNeedsMips = desc.filter != TextureFilter::nearest && desc.filter != TextureFilter::linear;
  if (filterNeedsMips && !desc.mipmapped) {
    return Error{ErrorCode::invalidArgument, what + " has a mip filter but no mipmaps; set mipmapped."};
  }
  Texture texture;
  texture.desc_ = desc;
  if (Status status = context.checkMemory(texture.byteCount(), what); !status) return status.error();
  texture.object_ = Object<ObjectKind::texture>::create(context);
  if (!texture.object_) return noNameError(context, what);

  const Functions& gl = context.functions();
  context.noteBindingsChanged();
  gl.bindTexture(GL_TEXTURE_2D, texture.name());
  // Without the binding another texture would be written.
  context.collectErrors();
  if (context.hasFaults()) return context.checkErrors(what.c_str()).error();
  gl.pixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minFilterOf(desc.filter));
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magFilterOf(desc.filter));
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, glWrap(desc.wrap));
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, glWrap(wrapV));

  const TextureEncoding encoding = encodingOf(desc.format);
  int width = desc.width, height = desc.height;
  for (int level = 0;; ++level) {
    gl.texImage2D(GL_TEXTURE_2D, level, static_cast<GLint>(encoding.format), width, height, 0,
                  encoding.format, encoding.type, level == 0 ? pixels : nullptr);
    if (!desc.mipmapped || (width == 1 && height == 1)) break;
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
  if (Status status = allocationStatus(context, what); !status) return status.error();
  texture.object_.setStoredBytes(texture.byteCount());
  if (pixels) {
    context.uploads().textureBytes +=
        encoding.bytesPerTexel * static_cast<std::size_t>(desc.width) * static_cast<std::size_t>(desc.height);
  }
  return texture;
}

Texture Texture::wrap(std::uint32_t name, const TextureDesc& desc) {
  Texture texture;
  texture.wrapped_ = name;
  texture.desc_ = desc;
  return texture;
}

void Texture::update(Context& context, int x, int y, int width, int height, const void* pixels) {
  if (context.lost() || !*this) return;
  const Functions& gl = context.functions();
  const TextureEncoding encoding = encodingOf(desc_.format);
  context.noteBindingsChanged();
  gl.bindTexture(GL_TEXTURE_2D, name());
  gl.pixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.texSubImage2D(GL_TEXTURE_2D, 0, x, y, width, height, encoding.format, encoding.type, pixels);
  context.uploads().textureBytes +=
      encoding.bytesPerTexel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void Texture::bind(Context& context, int unit) const {
  if (context.lost()) return;
  context.functions().activeTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  context.functions().bindTexture(GL_TEXTURE_2D, name());
  context.noteBindingsChanged();
}

void Texture::generateMipmaps(Context& context) {
  if (context.lost() || !*this) return;
  context.noteBindingsChanged();
  context.functions().bindTexture(GL_TEXTURE_2D, name());
  context.functions().generateMipmap(GL_TEXTURE_2D);
}

std::size_t Texture::byteCount() const {
  std::size_t texels = 0;
  int width = desc_.width, height = desc_.height;
  while (width > 0 && height > 0) {
    texels += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (!desc_.mipmapped || (width == 1 && height == 1)) break;
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
  return texels * bytesPerTexel(desc_.format);
}

}  // namespace halfshadow::gl
