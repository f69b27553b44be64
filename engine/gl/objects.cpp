// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/objects.hpp"

namespace halfshadow::gl {
namespace {

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
  setStoredBytes(0);
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

template <ObjectKind kind>
void Object<kind>::setStoredBytes(std::uint64_t bytes) {
  if (context_) context_->noteStorage(storedBytes_, bytes);
  storedBytes_ = bytes;
}

template class Object<ObjectKind::texture>;
template class Object<ObjectKind::renderbuffer>;
template class Object<ObjectKind::framebuffer>;
template class Object<ObjectKind::buffer>;
template class Object<ObjectKind::program>;
template class Object<ObjectKind::query>;

}  // namespace halfshadow::gl
