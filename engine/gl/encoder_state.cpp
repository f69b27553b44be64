// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What of Encoder turns draw states and attributes into calls.
#include "gl/encoder_cache.hpp"

namespace halfshadow::gl {
namespace {

GLenum glOf(Compare compare) {
  constexpr GLenum kTable[] = {GL_NEVER,   GL_LESS,   GL_LEQUAL,   GL_EQUAL,
                               GL_GREATER, GL_GEQUAL, GL_NOTEQUAL, GL_ALWAYS};
  return kTable[static_cast<int>(compare)];
}

GLenum glOf(BlendFactor factor) {
  constexpr GLenum kTable[] = {GL_ZERO,      GL_ONE,
                               GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR,
                               GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR,
                               GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA,
                               GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA};
  return kTable[static_cast<int>(factor)];
}

GLenum glOf(BlendEquation equation) {
  constexpr GLenum kTable[] = {GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN_EXT,
                               GL_MAX_EXT};
  return kTable[static_cast<int>(equation)];
}

GLenum glOf(StencilOp op) {
  constexpr GLenum kTable[] = {GL_KEEP,      GL_ZERO, GL_REPLACE, GL_INCR_WRAP,
                               GL_DECR_WRAP, GL_INCR, GL_DECR,    GL_INVERT};
  return kTable[static_cast<int>(op)];
}

struct AttributeEncoding {
  GLenum type;
  GLboolean normalized;
};
AttributeEncoding glOf(AttributeType type) {
  constexpr AttributeEncoding kTable[] = {{GL_FLOAT, GL_FALSE},
                                          {GL_UNSIGNED_BYTE, GL_TRUE},
                                          {GL_BYTE, GL_TRUE},
                                          {GL_UNSIGNED_SHORT, GL_TRUE},
                                          {GL_SHORT, GL_TRUE}};
  return kTable[static_cast<int>(type)];
}

}  // namespace

void Encoder::applyState(const DrawState& state) {
  Cache& cache = *cache_;
  const Functions& gl = context_.functions();
  // Writing depth without a test needs the test on, with ALWAYS: a disabled test also disables the write.
  const bool depthTest = state.depth.test != Compare::always || state.depth.write;
  cache.depthTest.set(gl, depthTest);
  if (depthTest) cache.depthFunc.set(gl, static_cast<GLint>(glOf(state.depth.test)));
  cache.depthMask.set(gl, state.depth.write);
  cache.cull.set(gl, state.cull != Cull::none);
  if (state.cull != Cull::none) cache.cullFace.set(gl, state.cull == Cull::back ? GL_BACK : GL_FRONT);

  cache.blend.set(gl, state.blend.enabled);
  if (state.blend.enabled) {
    const GLint equation = static_cast<GLint>(glOf(state.blend.equation));
    const GLint source = static_cast<GLint>(glOf(state.blend.source));
    const GLint destination = static_cast<GLint>(glOf(state.blend.destination));
    cache.blendEquation.set(gl, {equation, equation});
    cache.blendFunc.set(gl, {source, destination, source, destination});
  }

  cache.stencilTest.set(gl, state.stencil.enabled);
  if (state.stencil.enabled) {
    const StencilState& stencil = state.stencil;
    const auto func = [&](const StencilFace& face) {
      return std::array<GLint, 3>{static_cast<GLint>(glOf(face.test)), stencil.reference,
                                  static_cast<GLint>(stencil.readMask)};
    };
    const auto ops = [](const StencilFace& face) {
      return std::array<GLint, 3>{static_cast<GLint>(glOf(face.stencilFail)),
                                  static_cast<GLint>(glOf(face.depthFail)),
                                  static_cast<GLint>(glOf(face.pass))};
    };
    cache.stencilFuncFront.set(gl, func(stencil.front));
    cache.stencilFuncBack.set(gl, func(stencil.back));
    cache.stencilOpsFront.set(gl, ops(stencil.front));
    cache.stencilOpsBack.set(gl, ops(stencil.back));
    cache.stencilMaskFront.set(gl, static_cast<GLint>(stencil.writeMask));
    cache.stencilMaskBack.set(gl, static_cast<GLint>(stencil.writeMask));
  }

  cache.colorMask.set(gl, {state.colorMask[0], state.colorMask[1], state.colorMask[2], state.colorMask[3]});
  cache.scissorTest.set(gl, state.scissor.has_value());
  if (state.scissor) {
    cache.scissorBox.set(gl,
                         {state.scissor->x, state.scissor->y, state.scissor->width, state.scissor->height});
  }
  cache.depthRange.set(gl, {state.depthRange.x, state.depthRange.y});
  cache.polygonOffsetFill.set(gl, state.polygonOffset.has_value());
  if (state.polygonOffset) cache.polygonOffset.set(gl, {state.polygonOffset->x, state.polygonOffset->y});
}

void Encoder::applyAttributes(std::span<const AttributeBinding> attributes) {
  Cache::Bindings& bound = cache_->bound;
  const Functions& gl = context_.functions();
  std::array<bool, state::kVertexAttributes> used{};
  for (const AttributeBinding& binding : attributes) {
    const auto index = static_cast<std::size_t>(binding.attribute);
    used[index] = true;
    const Cache::Attribute wanted{binding.buffer->name(), binding.components, binding.type,
                                  binding.strideBytes, binding.offsetBytes};
    if (bound.attributes[index] == wanted) continue;
    if (bound.arrayBuffer != wanted.buffer) gl.bindBuffer(GL_ARRAY_BUFFER, wanted.buffer);
    bound.arrayBuffer = wanted.buffer;
    const AttributeEncoding encoding = glOf(binding.type);
    gl.vertexAttribPointer(static_cast<GLuint>(index), wanted.components, encoding.type, encoding.normalized,
                           wanted.strideBytes, bufferOffset(wanted.offsetBytes));
    bound.attributes[index] = wanted;
  }
  for (std::size_t index = 0; index < used.size(); ++index) {
    if (bound.attributeEnabled[index] == used[index]) continue;
    bound.attributeEnabled[index] = used[index];
    if (used[index]) {
      gl.enableVertexAttribArray(static_cast<GLuint>(index));
    } else {
      gl.disableVertexAttribArray(static_cast<GLuint>(index));
    }
  }
}

}  // namespace halfshadow::gl
