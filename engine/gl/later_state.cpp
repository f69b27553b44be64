// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/later_state.hpp"

namespace halfshadow::gl {
namespace {
// Of OpenGL ES 3.0; the extensions of 2.0 that have the same share the values.
constexpr GLenum kVertexArrayBinding = 0x85B5, kSamplerBinding = 0x8919, kReadFramebuffer = 0x8CA8,
                 kReadFramebufferBinding = 0x8CAA, kPixelPackBuffer = 0x88EB, kPixelUnpackBuffer = 0x88EC,
                 kPixelPackBufferBinding = 0x88ED, kPixelUnpackBufferBinding = 0x88EF,
                 kAttributeDivisor = 0x88FE, kFeedbackPaused = 0x8E23, kFeedbackActive = 0x8E24;
// Row length, skipped rows, skipped pixels, of unpacking and of packing.
constexpr GLenum kPixelStoreNames[] = {0x0CF2, 0x0CF3, 0x0CF4, 0x0D02, 0x0D03, 0x0D04};
constexpr std::size_t kUnpackStores = 3;
// Rasterizer discard, primitive restart at the fixed index.
constexpr GLenum kFlagNames[] = {0x8C89, 0x8D69};

/// What the context has. Entry points are read where they are called: a context may be lost in between.
class Has {
 public:
  bool version3 = false, unpackRows = false, packRows = false;
  const PFNGLBINDVERTEXARRAYOESPROC* vertexArrays = nullptr;
  const PFNGLVERTEXATTRIBDIVISOREXTPROC* divisors = nullptr;
  void bindVertexArray(GLint name) const {
    if (vertexArrays) (*vertexArrays)(static_cast<GLuint>(name));
  }
  void setDivisor(GLuint attribute, GLint divisor) const {
    if (divisors) (*divisors)(attribute, static_cast<GLuint>(divisor));
  }
};

Has of(const Context& context) {
  const Functions& gl = context.functions();
  Has has;
  has.version3 = context.majorVersion() >= 3;
  has.unpackRows = has.version3 || context.advertises("GL_EXT_unpack_subimage");
  has.packRows = has.version3 || context.advertises("GL_NV_pack_subimage");
  // Loaders answer for names of extensions that the context does not have.
  if (has.version3) {
    if (gl.bindVertexArray) has.vertexArrays = &gl.bindVertexArray;
    if (gl.vertexAttribDivisor) has.divisors = &gl.vertexAttribDivisor;
  } else {
    if (context.advertises("GL_OES_vertex_array_object") && gl.bindVertexArrayOes)
      has.vertexArrays = &gl.bindVertexArrayOes;
    if (context.advertises("GL_EXT_instanced_arrays") && gl.vertexAttribDivisorExt)
      has.divisors = &gl.vertexAttribDivisorExt;
    else if (context.advertises("GL_ANGLE_instanced_arrays") && gl.vertexAttribDivisorAngle)
      has.divisors = &gl.vertexAttribDivisorAngle;
  }
  return has;
}

GLint integer(const Functions& gl, GLenum name) {
  GLint value = 0;
  gl.getIntegerv(name, &value);
  return value;
}

bool hasStore(const Has& has, std::size_t i) {
  return i < kUnpackStores ? has.unpackRows : has.packRows;
}

void setFlag(const Functions& gl, GLenum name, bool on) {
  if (on) {
    gl.enable(name);
  } else {
    gl.disable(name);
  }
}

bool feedbackRuns(const Functions& gl) {
  return integer(gl, kFeedbackActive) != 0 && integer(gl, kFeedbackPaused) == 0;
}
}  // namespace

void LaterState::capture(Context& context) {
  const Functions& gl = context.functions();
  const Has has = of(context);
  if (has.vertexArrays) vertexArray_ = integer(gl, kVertexArrayBinding);
  if (has.divisors) {
    // Of the default vertex array, which is the one that the engine draws with.
    has.bindVertexArray(0);
    for (std::size_t i = 0; i < divisors_.size(); ++i)
      gl.getVertexAttribiv(static_cast<GLuint>(i), kAttributeDivisor, &divisors_[i]);
    has.bindVertexArray(vertexArray_);
  }
  for (std::size_t i = 0; i < pixelStores_.size(); ++i) {
    if (hasStore(has, i)) pixelStores_[i] = integer(gl, kPixelStoreNames[i]);
  }
  if (!has.version3) return;
  unpackBuffer_ = integer(gl, kPixelUnpackBufferBinding);
  packBuffer_ = integer(gl, kPixelPackBufferBinding);
  readFramebuffer_ = integer(gl, kReadFramebufferBinding);
  const GLint activeUnit = integer(gl, GL_ACTIVE_TEXTURE);
  for (std::size_t unit = 0; unit < samplers_.size(); ++unit) {
    gl.activeTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    samplers_[unit] = integer(gl, kSamplerBinding);
  }
  gl.activeTexture(static_cast<GLenum>(activeUnit));
  for (std::size_t i = 0; i < flags_.size(); ++i) flags_[i] = gl.isEnabled(kFlagNames[i]) != 0;
  feedbackRuns_ = feedbackRuns(gl);
}

void LaterState::neutralize(Context& context) {
  const Functions& gl = context.functions();
  const Has has = of(context);
  if (has.version3 && gl.pauseTransformFeedback && feedbackRuns(gl)) gl.pauseTransformFeedback();
  has.bindVertexArray(0);
  for (GLuint i = 0; i < state::kVertexAttributes; ++i) has.setDivisor(i, 0);
  for (std::size_t i = 0; i < kPixelStores; ++i) {
    if (hasStore(has, i)) gl.pixelStorei(kPixelStoreNames[i], 0);
  }
  if (!has.version3) return;
  gl.bindBuffer(kPixelUnpackBuffer, 0);
  gl.bindBuffer(kPixelPackBuffer, 0);
  for (GLuint unit = 0; gl.bindSampler && unit < state::kTextureUnits; ++unit) gl.bindSampler(unit, 0);
  for (const GLenum flag : kFlagNames) gl.disable(flag);
}

void LaterState::restore(Context& context) const {
  const Functions& gl = context.functions();
  const Has has = of(context);
  for (GLuint i = 0; i < state::kVertexAttributes; ++i) has.setDivisor(i, divisors_[i]);
  has.bindVertexArray(vertexArray_);
  for (std::size_t i = 0; i < pixelStores_.size(); ++i) {
    if (hasStore(has, i)) gl.pixelStorei(kPixelStoreNames[i], pixelStores_[i]);
  }
  if (!has.version3) return;
  gl.bindBuffer(kPixelUnpackBuffer, static_cast<GLuint>(unpackBuffer_));
  gl.bindBuffer(kPixelPackBuffer, static_cast<GLuint>(packBuffer_));
  gl.bindFramebuffer(kReadFramebuffer, static_cast<GLuint>(readFramebuffer_));
  for (GLuint unit = 0; gl.bindSampler && unit < state::kTextureUnits; ++unit)
    gl.bindSampler(unit, static_cast<GLuint>(samplers_[unit]));
  for (std::size_t i = 0; i < flags_.size(); ++i) setFlag(gl, kFlagNames[i], flags_[i]);
  if (feedbackRuns_ && gl.resumeTransformFeedback) gl.resumeTransformFeedback();
}

}  // namespace halfshadow::gl
