// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// State types of the fixed-function stages. See state_list.hpp.
#pragma once

#include "gl/state_bindings.hpp"

namespace halfshadow::gl::state {

/// A mask of all ones, which is the initial value, does not fit a GLint: some drivers answer with the largest
/// one.
constexpr GLint stencilMaskOf(GLint answered) {
  return answered == 0x7fffffff ? -1 : answered;
}

/// The initial viewport and scissor box are the size of the host's window, which the engine cannot know:
/// with leaveDefaults the values found on entry are put back.
struct Viewport {
  using Type = std::array<GLint, 4>;
  static constexpr const char* kName = "viewport";
  static constexpr bool kInitialIsHostValue = true;
  static Type initial() { return {}; }
  static Type get(const Functions& gl) { return integers<GL_VIEWPORT, 4>(gl); }
  static void set(const Functions& gl, const Type& v) { gl.viewport(v[0], v[1], v[2], v[3]); }
};

struct ScissorBox {
  using Type = std::array<GLint, 4>;
  static constexpr const char* kName = "scissor box";
  static constexpr bool kInitialIsHostValue = true;
  static Type initial() { return {}; }
  static Type get(const Functions& gl) { return integers<GL_SCISSOR_BOX, 4>(gl); }
  static void set(const Functions& gl, const Type& v) { gl.scissor(v[0], v[1], v[2], v[3]); }
};

template <GLenum capability, bool initiallyOn = false>
struct Enable {
  using Type = GLint;
  static constexpr const char* kName = "glEnable flag";
  static Type initial() { return initiallyOn ? 1 : 0; }
  static Type get(const Functions& gl) { return gl.isEnabled(capability) ? 1 : 0; }
  static void set(const Functions& gl, Type value) {
    if (value) {
      gl.enable(capability);
    } else {
      gl.disable(capability);
    }
  }
};

struct BlendFunc {
  using Type = std::array<GLint, 4>;
  static constexpr const char* kName = "blend function";
  static Type initial() { return {GL_ONE, GL_ZERO, GL_ONE, GL_ZERO}; }
  static Type get(const Functions& gl) {
    return integerEach<GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA>(gl);
  }
  static void set(const Functions& gl, const Type& v) {
    gl.blendFuncSeparate(static_cast<GLenum>(v[0]), static_cast<GLenum>(v[1]), static_cast<GLenum>(v[2]),
                         static_cast<GLenum>(v[3]));
  }
};

struct BlendEquation {
  using Type = std::array<GLint, 2>;
  static constexpr const char* kName = "blend equation";
  static Type initial() { return {GL_FUNC_ADD, GL_FUNC_ADD}; }
  static Type get(const Functions& gl) {
    return integerEach<GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA>(gl);
  }
  static void set(const Functions& gl, const Type& v) {
    gl.blendEquationSeparate(static_cast<GLenum>(v[0]), static_cast<GLenum>(v[1]));
  }
};

struct BlendColor {
  using Type = std::array<GLfloat, 4>;
  static constexpr const char* kName = "blend color";
  static Type initial() { return {0, 0, 0, 0}; }
  static Type get(const Functions& gl) { return floats<GL_BLEND_COLOR, 4>(gl); }
  static void set(const Functions& gl, const Type& v) { gl.blendColor(v[0], v[1], v[2], v[3]); }
};

struct ColorMask {
  using Type = std::array<GLint, 4>;
  static constexpr const char* kName = "color mask";
  static Type initial() { return {1, 1, 1, 1}; }
  static Type get(const Functions& gl) { return integers<GL_COLOR_WRITEMASK, 4>(gl); }
  static void set(const Functions& gl, const Type& v) {
    gl.colorMask(v[0] != 0, v[1] != 0, v[2] != 0, v[3] != 0);
  }
};

struct DepthFunc {
  using Type = GLint;
  static constexpr const char* kName = "depth function";
  static Type initial() { return GL_LESS; }
  static Type get(const Functions& gl) { return integers<GL_DEPTH_FUNC, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.depthFunc(static_cast<GLenum>(value)); }
};

struct DepthMask {
  using Type = GLint;
  static constexpr const char* kName = "depth mask";
  static Type initial() { return 1; }
  static Type get(const Functions& gl) { return integers<GL_DEPTH_WRITEMASK, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.depthMask(value != 0); }
};

struct DepthRange {
  using Type = std::array<GLfloat, 2>;
  static constexpr const char* kName = "depth range";
  static Type initial() { return {0, 1}; }
  static Type get(const Functions& gl) { return floats<GL_DEPTH_RANGE, 2>(gl); }
  static void set(const Functions& gl, const Type& v) { gl.depthRangef(v[0], v[1]); }
};

/// Drivers clamp the reference to the bits of the bound framebuffer, some when it is set, some when it is
/// read.
template <GLenum face>
struct StencilFunc {
  using Type = std::array<GLint, 3>;  ///< function, reference, read mask
  static constexpr const char* kName = "stencil function";
  static Type initial() { return {GL_ALWAYS, 0, -1}; }
  static Type get(const Functions& gl) {
    Type value;
    if constexpr (face == GL_FRONT) {
      value = integerEach<GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK>(gl);
    } else {
      value = integerEach<GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK>(gl);
    }
    value[2] = stencilMaskOf(value[2]);
    return value;
  }
  static void set(const Functions& gl, const Type& v) {
    gl.stencilFuncSeparate(face, static_cast<GLenum>(v[0]), v[1], static_cast<GLuint>(v[2]));
  }
};

template <GLenum face>
struct StencilOps {
  using Type = std::array<GLint, 3>;  ///< stencil fail, depth fail, pass
  static constexpr const char* kName = "stencil operations";
  static Type initial() { return {GL_KEEP, GL_KEEP, GL_KEEP}; }
  static Type get(const Functions& gl) {
    if constexpr (face == GL_FRONT) {
      return integerEach<GL_STENCIL_FAIL, GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_PASS_DEPTH_PASS>(gl);
    } else {
      return integerEach<GL_STENCIL_BACK_FAIL, GL_STENCIL_BACK_PASS_DEPTH_FAIL,
                         GL_STENCIL_BACK_PASS_DEPTH_PASS>(gl);
    }
  }
  static void set(const Functions& gl, const Type& v) {
    gl.stencilOpSeparate(face, static_cast<GLenum>(v[0]), static_cast<GLenum>(v[1]),
                         static_cast<GLenum>(v[2]));
  }
};

template <GLenum face>
struct StencilWriteMask {
  using Type = GLint;
  static constexpr const char* kName = "stencil write mask";
  static Type initial() { return -1; }
  static Type get(const Functions& gl) {
    constexpr GLenum kParameter = face == GL_FRONT ? GL_STENCIL_WRITEMASK : GL_STENCIL_BACK_WRITEMASK;
    return stencilMaskOf(integers<kParameter, 1>(gl)[0]);
  }
  static void set(const Functions& gl, Type value) {
    gl.stencilMaskSeparate(face, static_cast<GLuint>(value));
  }
};

struct CullFaceMode {
  using Type = GLint;
  static constexpr const char* kName = "cull face mode";
  static Type initial() { return GL_BACK; }
  static Type get(const Functions& gl) { return integers<GL_CULL_FACE_MODE, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.cullFace(static_cast<GLenum>(value)); }
};

struct FrontFace {
  using Type = GLint;
  static constexpr const char* kName = "front face";
  static Type initial() { return GL_CCW; }
  static Type get(const Functions& gl) { return integers<GL_FRONT_FACE, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.frontFace(static_cast<GLenum>(value)); }
};

struct PolygonOffset {
  using Type = std::array<GLfloat, 2>;  ///< factor, units
  static constexpr const char* kName = "polygon offset";
  static Type initial() { return {0, 0}; }
  static Type get(const Functions& gl) {
    return {floats<GL_POLYGON_OFFSET_FACTOR, 1>(gl)[0], floats<GL_POLYGON_OFFSET_UNITS, 1>(gl)[0]};
  }
  static void set(const Functions& gl, const Type& v) { gl.polygonOffset(v[0], v[1]); }
};

struct SampleCoverage {
  using Type = std::array<GLfloat, 2>;  ///< value, invert
  static constexpr const char* kName = "sample coverage";
  static Type initial() { return {1, 0}; }
  static Type get(const Functions& gl) {
    return {floats<GL_SAMPLE_COVERAGE_VALUE, 1>(gl)[0], floats<GL_SAMPLE_COVERAGE_INVERT, 1>(gl)[0]};
  }
  static void set(const Functions& gl, const Type& v) { gl.sampleCoverage(v[0], v[1] != 0.0f); }
};

struct ClearColor {
  using Type = std::array<GLfloat, 4>;
  static constexpr const char* kName = "clear color";
  static Type initial() { return {0, 0, 0, 0}; }
  static Type get(const Functions& gl) { return floats<GL_COLOR_CLEAR_VALUE, 4>(gl); }
  static void set(const Functions& gl, const Type& v) { gl.clearColor(v[0], v[1], v[2], v[3]); }
};

struct ClearDepth {
  using Type = GLfloat;
  static constexpr const char* kName = "clear depth";
  static Type initial() { return 1; }
  static Type get(const Functions& gl) { return floats<GL_DEPTH_CLEAR_VALUE, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.clearDepthf(value); }
};

struct ClearStencil {
  using Type = GLint;
  static constexpr const char* kName = "clear stencil";
  static Type initial() { return 0; }
  static Type get(const Functions& gl) { return integers<GL_STENCIL_CLEAR_VALUE, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.clearStencil(value); }
};

template <GLenum parameter>
struct PixelStore {
  using Type = GLint;
  static constexpr const char* kName = "pixel store alignment";
  static Type initial() { return 4; }
  static Type get(const Functions& gl) { return integers<parameter, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.pixelStorei(parameter, value); }
};

}  // namespace halfshadow::gl::state
