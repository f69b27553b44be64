// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Move-only OpenGL ES objects. Each has an empty state (name 0), deletes its name when it owns one, and
/// forgets it silently after Context::markLost().
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "device/texture_desc.hpp"
#include "gl/context.hpp"

namespace halfshadow::gl {

enum class ObjectKind { texture, renderbuffer, framebuffer, buffer, program, query };

/// One GL name.
template <ObjectKind kind>
class Object {
 public:
  Object() = default;
  Object(Object&& other) noexcept
      : context_(std::exchange(other.context_, nullptr)),
        name_(std::exchange(other.name_, 0)),
        storedBytes_(std::exchange(other.storedBytes_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    if (this != &other) {
      reset();
      context_ = std::exchange(other.context_, nullptr);
      name_ = std::exchange(other.name_, 0);
      storedBytes_ = std::exchange(other.storedBytes_, 0);
    }
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() { reset(); }

  static Object create(Context& context);
  void reset();
  std::uint32_t name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  /// What its storage holds now, for Context::storedBytes().
  void setStoredBytes(std::uint64_t bytes);

 private:
  Context* context_ = nullptr;
  std::uint32_t name_ = 0;
  std::uint64_t storedBytes_ = 0;
};

using device::TextureDesc;
using device::TextureFilter;
using device::TextureFormat;
using device::TextureWrap;

std::size_t bytesPerTexel(TextureFormat format);

/// A 2D texture.
class Texture {
 public:
  Texture() = default;
  /// `pixels` may be null (undefined content), else tightly packed rows, bottom row first.
  /// Errors: invalidArgument (size 0 or above the limit, mipmapped and not a power of two), outOfMemory.
  static Result<Texture> create(Context& context, const TextureDesc& desc, const void* pixels = nullptr);
  /// A texture of the host's, never deleted here.
  static Texture wrap(std::uint32_t name, const TextureDesc& desc);
  /// Replaces a rectangle of level 0. Unpack alignment is handled.
  void update(Context& context, int x, int y, int width, int height, const void* pixels);
  void generateMipmaps(Context& context);
  /// Leaves the texture bound to a unit, which becomes the active one: for a host's own draws.
  void bind(Context& context, int unit) const;
  std::uint32_t name() const { return wrapped_ ? wrapped_ : object_.name(); }
  const TextureDesc& desc() const { return desc_; }
  std::size_t byteCount() const;
  explicit operator bool() const { return name() != 0; }

 private:
  Object<ObjectKind::texture> object_;
  std::uint32_t wrapped_ = 0;
  TextureDesc desc_;
};

enum class RenderbufferFormat { depth16, depth24, stencil8, depth24Stencil8, rgba4, rgb565 };

class Renderbuffer {
 public:
  Renderbuffer() = default;
  static Result<Renderbuffer> create(Context& context, int width, int height, RenderbufferFormat format);
  std::uint32_t name() const { return object_.name(); }
  RenderbufferFormat format() const { return format_; }
  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t byteCount() const;
  explicit operator bool() const { return name() != 0; }

 private:
  Object<ObjectKind::renderbuffer> object_;
  RenderbufferFormat format_ = RenderbufferFormat::depth16;
  int width_ = 0, height_ = 0;
};

struct FramebufferAttachments {
  const Texture* color = nullptr;
  const Texture* depthTexture = nullptr;
  const Renderbuffer* depth = nullptr;    ///< depth or packed depth-stencil
  const Renderbuffer* stencil = nullptr;  ///< a separate stencil renderbuffer
  int colorLevel = 0;
};

class Framebuffer {
 public:
  Framebuffer() = default;
  /// Errors: capabilityMissing when the combination is not complete (the status is in the message).
  static Result<Framebuffer> create(Context& context, const FramebufferAttachments& attachments);
  /// The host's framebuffer, 0 included; never deleted here.
  static Framebuffer wrap(std::uint32_t name, int width, int height);
  std::uint32_t name() const { return wrapped_ ? wrappedName_ : object_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }
  bool valid() const { return wrapped_ || object_; }

 private:
  Object<ObjectKind::framebuffer> object_;
  std::uint32_t wrappedName_ = 0;
  bool wrapped_ = false;
  int width_ = 0, height_ = 0;
};

/// Before a frame draws into a framebuffer of the host's, 0 included; leaves it bound. Errors:
/// invalidArgument (there is none of that name, it is not complete, or it has no depth).
Status checkHostFramebuffer(Context& context, std::uint32_t name);

enum class BufferTarget { vertex, index };
enum class BufferUsage { staticDraw, dynamicDraw, streamDraw };

class Buffer {
 public:
  Buffer() = default;
  static Result<Buffer> create(Context& context, BufferTarget target, std::span<const std::byte> bytes,
                               BufferUsage usage);
  /// Replaces the content (orphaning the storage when the size changes).
  Status update(Context& context, std::span<const std::byte> bytes);
  std::uint32_t name() const { return object_.name(); }
  std::size_t byteCount() const { return byteCount_; }
  explicit operator bool() const { return name() != 0; }

 private:
  Object<ObjectKind::buffer> object_;
  BufferTarget target_ = BufferTarget::vertex;
  BufferUsage usage_ = BufferUsage::staticDraw;
  std::size_t byteCount_ = 0;
  bool defined_ = false;  ///< it has storage, be it of 0 bytes
};

}  // namespace halfshadow::gl
