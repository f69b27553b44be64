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
