// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/objects.hpp"

#include <algorithm>
#include <bit>

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

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// Errors that earlier calls left must not be blamed on the next one.
void drainErrors(const Functions& gl) {
  for (int i = 0; i < 32 && gl.getError() != GL_NO_ERROR; ++i) {
  }
}

Status allocationStatus(const Functions& gl, const std::string& what) {
  const GLenum error = gl.getError();
  if (error == GL_NO_ERROR) return {};
  drainErrors(gl);
  if (error == GL_OUT_OF_MEMORY) {
    return Error{ErrorCode::outOfMemory,
                 what + " does not fit into the driver's memory; ask for a smaller one."};
  }
  return Error{ErrorCode::capabilityMissing, what + " is refused by this driver (GL error " +
                                                 std::to_string(error) + "); choose another format."};
}

Error lostError(const std::string& what) {
  return {ErrorCode::contextLost, what + " cannot be made: the context was lost; create a new one."};
}

int& liveCount(Context& context, ObjectKind kind) {
  Context::LiveObjects& live = context.liveObjects();
  switch (kind) {
    case ObjectKind::texture:
      return live.textures;
    case ObjectKind::renderbuffer:
      return live.renderbuffers;
    case ObjectKind::framebuffer:
      return live.framebuffers;
    case ObjectKind::buffer:
      return live.buffers;
    case ObjectKind::program:
      return live.programs;
    case ObjectKind::query:
      return live.queries;
  }
  return live.textures;
}

}  // namespace

template <ObjectKind kind>
Object<kind> Object<kind>::create(Context& context) {
  Object object;
  if (context.lost()) return object;
  const Functions& gl = context.functions();
  GLuint name = 0;
  if constexpr (kind == ObjectKind::texture) gl.genTextures(1, &name);
  if constexpr (kind == ObjectKind::renderbuffer) gl.genRenderbuffers(1, &name);
  if constexpr (kind == ObjectKind::framebuffer) gl.genFramebuffers(1, &name);
  if constexpr (kind == ObjectKind::buffer) gl.genBuffers(1, &name);
  if constexpr (kind == ObjectKind::program) name = gl.createProgram();
  if constexpr (kind == ObjectKind::query) {
    if (gl.genQueries) gl.genQueries(1, &name);
  }
  if (name == 0) return object;
  object.context_ = &context;
  object.name_ = name;
  ++liveCount(context, kind);
  return object;
}

template <ObjectKind kind>
void Object<kind>::reset() {
  if (name_ == 0) return;
  --liveCount(*context_, kind);
  if (!context_->lost()) {
    const Functions& gl = context_->functions();
    const GLuint name = name_;
    if constexpr (kind == ObjectKind::texture) gl.deleteTextures(1, &name);
    if constexpr (kind == ObjectKind::renderbuffer) gl.deleteRenderbuffers(1, &name);
    if constexpr (kind == ObjectKind::framebuffer) gl.deleteFramebuffers(1, &name);
    if constexpr (kind == ObjectKind::buffer) gl.deleteBuffers(1, &name);
    if constexpr (kind == ObjectKind::program) gl.deleteProgram(name);
    if constexpr (kind == ObjectKind::query) gl.deleteQueries(1, &name);
    context_
        ->noteBindingsChanged();  // a deleted object that was bound leaves 0 behind, and its name is reused
  }
  context_ = nullptr;
  name_ = 0;
}

template class Object<ObjectKind::texture>;
template class Object<ObjectKind::renderbuffer>;
template class Object<ObjectKind::framebuffer>;
template class Object<ObjectKind::buffer>;
template class Object<ObjectKind::program>;
template class Object<ObjectKind::query>;

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
  if (desc.wrap == TextureWrap::repeat && !powersOfTwo) {
    return Error{ErrorCode::invalidArgument, what + " cannot repeat: OpenGL ES 2.0 needs powers of two."};
  }
  const bool filterNeedsMips = desc.filter != TextureFilter::nearest && desc.filter != TextureFilter::linear;
  if (filterNeedsMips && !desc.mipmapped) {
    return Error{ErrorCode::invalidArgument, what + " has a mip filter but no mipmaps; set mipmapped."};
  }
  Texture texture;
  texture.desc_ = desc;
  texture.object_ = Object<ObjectKind::texture>::create(context);
  if (!texture.object_) return lostError(what);

  const Functions& gl = context.functions();
  drainErrors(gl);
  context.noteBindingsChanged();
  gl.bindTexture(GL_TEXTURE_2D, texture.name());
  gl.pixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minFilterOf(desc.filter));
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magFilterOf(desc.filter));
  const GLint wrap = desc.wrap == TextureWrap::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);

  const TextureEncoding encoding = encodingOf(desc.format);
  int width = desc.width, height = desc.height;
  for (int level = 0;; ++level) {
    gl.texImage2D(GL_TEXTURE_2D, level, static_cast<GLint>(encoding.format), width, height, 0,
                  encoding.format, encoding.type, level == 0 ? pixels : nullptr);
    if (!desc.mipmapped || (width == 1 && height == 1)) break;
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
  if (Status status = allocationStatus(gl, what); !status) return status.error();
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

void Texture::generateMipmaps(Context& context) {
  if (context.lost() || !*this) return;
  context.noteBindingsChanged();
  context.functions().bindTexture(GL_TEXTURE_2D, name());
  context.functions().generateMipmap(GL_TEXTURE_2D);
}

void Texture::setFilter(Context& context, TextureFilter filter) {
  if (context.lost() || !*this || desc_.filter == filter) return;
  const Functions& gl = context.functions();
  context.noteBindingsChanged();
  gl.bindTexture(GL_TEXTURE_2D, name());
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minFilterOf(filter));
  gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magFilterOf(filter));
  desc_.filter = filter;
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

namespace {

struct RenderbufferEncoding {
  GLenum format;
  std::size_t bytesPerPixel;
};

RenderbufferEncoding encodingOf(RenderbufferFormat format) {
  switch (format) {
    case RenderbufferFormat::depth16:
      return {GL_DEPTH_COMPONENT16, 2};
    case RenderbufferFormat::depth24:
      return {GL_DEPTH_COMPONENT24_OES, 4};
    case RenderbufferFormat::stencil8:
      return {GL_STENCIL_INDEX8, 1};
    case RenderbufferFormat::depth24Stencil8:
      return {GL_DEPTH24_STENCIL8_OES, 4};
    case RenderbufferFormat::rgba4:
      return {GL_RGBA4, 2};
    case RenderbufferFormat::rgb565:
      return {GL_RGB565, 2};
  }
  return {GL_DEPTH_COMPONENT16, 2};
}

}  // namespace

Result<Renderbuffer> Renderbuffer::create(Context& context, int width, int height,
                                          RenderbufferFormat format) {
  const std::string what = "Renderbuffer of " + sizeText(width, height);
  const int limit = context.capabilities().limits.renderbufferSize;
  if (width <= 0 || height <= 0 || width > limit || height > limit) {
    return Error{ErrorCode::invalidArgument,
                 what + " is outside 1x1 to " + sizeText(limit, limit) + ", the limit of this driver."};
  }
  Renderbuffer renderbuffer;
  renderbuffer.format_ = format;
  renderbuffer.width_ = width;
  renderbuffer.height_ = height;
  renderbuffer.object_ = Object<ObjectKind::renderbuffer>::create(context);
  if (!renderbuffer.object_) return lostError(what);
  const Functions& gl = context.functions();
  drainErrors(gl);
  gl.bindRenderbuffer(GL_RENDERBUFFER, renderbuffer.name());
  gl.renderbufferStorage(GL_RENDERBUFFER, encodingOf(format).format, width, height);
  if (Status status = allocationStatus(gl, what); !status) return status.error();
  return renderbuffer;
}

std::size_t Renderbuffer::byteCount() const {
  return encodingOf(format_).bytesPerPixel * static_cast<std::size_t>(width_) *
         static_cast<std::size_t>(height_);
}

Result<Framebuffer> Framebuffer::create(Context& context, const FramebufferAttachments& attachments) {
  Framebuffer framebuffer;
  framebuffer.object_ = Object<ObjectKind::framebuffer>::create(context);
  if (!framebuffer.object_) return lostError("Framebuffer");
  const Functions& gl = context.functions();
  drainErrors(gl);
  context.noteBindingsChanged();
  gl.bindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  const auto adoptSize = [&](int width, int height) {
    if (framebuffer.width_ == 0) {
      framebuffer.width_ = width;
      framebuffer.height_ = height;
    }
  };
  std::string parts;
  if (attachments.color) {
    gl.framebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, attachments.color->name(),
                            attachments.colorLevel);
    adoptSize(std::max(1, attachments.color->desc().width >> attachments.colorLevel),
              std::max(1, attachments.color->desc().height >> attachments.colorLevel));
    parts += " color texture";
  }
  if (attachments.depthTexture) {
    const TextureDesc& desc = attachments.depthTexture->desc();
    gl.framebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                            attachments.depthTexture->name(), 0);
    if (desc.format == TextureFormat::depth24Stencil8) {
      gl.framebufferTexture2D(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_TEXTURE_2D,
                              attachments.depthTexture->name(), 0);
    }
    adoptSize(desc.width, desc.height);
    parts += " depth texture";
  }
  const auto attach = [&](GLenum point, const Renderbuffer& renderbuffer) {
    gl.framebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, renderbuffer.name());
    adoptSize(renderbuffer.width(), renderbuffer.height());
  };
  if (attachments.depth) {
    attach(GL_DEPTH_ATTACHMENT, *attachments.depth);
    parts += " depth renderbuffer";
    if (attachments.depth->format() == RenderbufferFormat::depth24Stencil8) {
      attach(GL_STENCIL_ATTACHMENT, *attachments.depth);
    }
  }
  if (attachments.stencil) {
    attach(GL_STENCIL_ATTACHMENT, *attachments.stencil);
    parts += " stencil renderbuffer";
  }
  const GLenum status = gl.checkFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    drainErrors(gl);
    const char* reason = status == GL_FRAMEBUFFER_UNSUPPORTED                     ? "unsupported"
                         : status == GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT         ? "incomplete attachment"
                         : status == GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT ? "no attachment"
                         : status == GL_FRAMEBUFFER_INCOMPLETE_DIMENSIONS ? "attachments of different sizes"
                                                                          : "unknown status";
    return Error{ErrorCode::capabilityMissing,
                 "Framebuffer with" + (parts.empty() ? " nothing" : parts) + " of " +
                     sizeText(framebuffer.width_, framebuffer.height_) + " is not complete: " + reason +
                     "; choose other formats or force the capability off."};
  }
  return framebuffer;
}

Framebuffer Framebuffer::wrap(std::uint32_t name, int width, int height) {
  Framebuffer framebuffer;
  framebuffer.wrapped_ = true;
  framebuffer.wrappedName_ = name;
  framebuffer.width_ = width;
  framebuffer.height_ = height;
  return framebuffer;
}

namespace {
GLenum targetOf(BufferTarget target) {
  return target == BufferTarget::vertex ? GL_ARRAY_BUFFER : GL_ELEMENT_ARRAY_BUFFER;
}
GLenum usageOf(BufferUsage usage) {
  switch (usage) {
    case BufferUsage::staticDraw:
      return GL_STATIC_DRAW;
    case BufferUsage::dynamicDraw:
      return GL_DYNAMIC_DRAW;
    case BufferUsage::streamDraw:
      return GL_STREAM_DRAW;
  }
  return GL_STATIC_DRAW;
}
}  // namespace

Result<Buffer> Buffer::create(Context& context, BufferTarget target, std::span<const std::byte> bytes,
                              BufferUsage usage) {
  Buffer buffer;
  buffer.target_ = target;
  buffer.usage_ = usage;
  buffer.object_ = Object<ObjectKind::buffer>::create(context);
  if (!buffer.object_) return lostError("Buffer of " + std::to_string(bytes.size()) + " bytes");
  // A new buffer of 0 bytes still needs its storage defined once.
  buffer.byteCount_ = bytes.size() + 1;
  if (Status status = buffer.update(context, bytes); !status) return status.error();
  return buffer;
}

Status Buffer::update(Context& context, std::span<const std::byte> bytes) {
  const std::string what = "Buffer of " + std::to_string(bytes.size()) + " bytes";
  if (context.lost() || !object_) return lostError(what);
  const Functions& gl = context.functions();
  const GLenum target = targetOf(target_);
  context.noteBindingsChanged();
  gl.bindBuffer(target, name());
  context.uploads().bufferBytes += bytes.size();
  if (bytes.size() == byteCount_) {
    gl.bufferSubData(target, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
    return {};
  }
  drainErrors(gl);
  gl.bufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), usageOf(usage_));
  if (Status status = allocationStatus(gl, what); !status) {
    byteCount_ = 0;
    return status;
  }
  byteCount_ = bytes.size();
  return {};
}

}  // namespace halfshadow::gl
