// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/allocation.hpp"
#include "gl/objects.hpp"

namespace halfshadow::gl {
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
  if (!buffer.object_) return noNameError(context, "Buffer of " + std::to_string(bytes.size()) + " bytes");
  if (Status status = buffer.update(context, bytes); !status) return status.error();
  return buffer;
}

Status Buffer::update(Context& context, std::span<const std::byte> bytes) {
  const std::string what = "Buffer of " + std::to_string(bytes.size()) + " bytes";
  if (context.lost() || !object_) return noNameError(context, what);
  const Functions& gl = context.functions();
  const GLenum target = targetOf(target_);
  // A new buffer of 0 bytes still needs its storage defined once.
  const bool sameSize = defined_ && bytes.size() == byteCount_;
  if (!sameSize && bytes.size() > byteCount_) {
    if (Status status = context.checkMemory(bytes.size() - byteCount_, what); !status) return status;
  }
  context.noteBindingsChanged();
  gl.bindBuffer(target, name());
  context.uploads().bufferBytes += bytes.size();
  // Without the binding another buffer would be written.
  context.collectErrors();
  if (context.hasFaults()) return context.checkErrors(what.c_str());
  if (sameSize) {
    gl.bufferSubData(target, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
    return allocationStatus(context, what);
  }
  gl.bufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), usageOf(usage_));
  if (Status status = allocationStatus(context, what); !status) {
    defined_ = false;
    byteCount_ = 0;
    object_.setStoredBytes(0);
    return status;
  }
  defined_ = true;
  byteCount_ = bytes.size();
  object_.setStoredBytes(byteCount_);
  return {};
}

}  // namespace halfshadow::gl
