// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "gl/allocation.hpp"
#include "gl/objects.hpp"

namespace halfshadow::gl {
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
  if (Status status = context.checkMemory(renderbuffer.byteCount(), what); !status) return status.error();
  renderbuffer.object_ = Object<ObjectKind::renderbuffer>::create(context);
  if (!renderbuffer.object_) return noNameError(context, what);
  const Functions& gl = context.functions();
  context.collectErrors();
  gl.bindRenderbuffer(GL_RENDERBUFFER, renderbuffer.name());
  gl.renderbufferStorage(GL_RENDERBUFFER, encodingOf(format).format, width, height);
  if (Status status = allocationStatus(context, what); !status) return status.error();
  renderbuffer.object_.setStoredBytes(renderbuffer.byteCount());
  return renderbuffer;
}

std::size_t Renderbuffer::byteCount() const {
  return encodingOf(format_).bytesPerPixel * static_cast<std::size_t>(width_) *
         static_cast<std::size_t>(height_);
}

Result<Framebuffer> Framebuffer::create(Context& context, const FramebufferAttachments& attachments) {
  Framebuffer framebuffer;
  framebuffer.object_ = Object<ObjectKind::framebuffer>::create(context);
  if (!framebuffer.object_) return noNameError(context, "Framebuffer");
  const Functions& gl = context.functions();
  context.collectErrors();
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
  if (context.lost()) return noNameError(context, "Framebuffer");
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    context.collectErrors();
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

Status checkHostFramebuffer(Context& context, std::uint32_t name) {
  const Functions& gl = context.functions();
  const std::string what = "the host's framebuffer " + std::to_string(name);
  // Binding a name that stands for nothing would make something of it.
  if (name != 0 && !gl.isFramebuffer(name))
    return Error{ErrorCode::invalidArgument, what + " does not exist; name one, or 0"};
  context.noteBindingsChanged();
  gl.bindFramebuffer(GL_FRAMEBUFFER, name);
  if (gl.checkFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return Error{ErrorCode::invalidArgument, what + " is not complete; attach what it lacks"};
  GLint depthBits = 0;
  gl.getIntegerv(GL_DEPTH_BITS, &depthBits);
  if (depthBits == 0) {
    return Error{ErrorCode::invalidArgument,
                 what + " has no depth; attach a depth buffer, without which nothing hides anything"};
  }
  return {};
}

}  // namespace halfshadow::gl
