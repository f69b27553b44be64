// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Every piece of OpenGL ES state that the engine touches, one small type each: Type, kName, initial, get,
/// set. Capture, restore, defaults and the hostile-host test are loops over StateList.
#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "gl/functions.hpp"

namespace halfshadow::gl::state {

inline constexpr int kTextureUnits = 8;      ///< the minimum of ES 2.0, and the most that the engine uses
inline constexpr int kVertexAttributes = 8;  ///< likewise

template <GLenum parameter, std::size_t count>
std::array<GLint, count> integers(const Functions& gl) {
  std::array<GLint, count> values{};
  gl.getIntegerv(parameter, values.data());
  return values;
}
template <GLenum parameter, std::size_t count>
std::array<GLfloat, count> floats(const Functions& gl) {
  std::array<GLfloat, count> values{};
  gl.getFloatv(parameter, values.data());
  return values;
}
template <GLenum... parameters>
std::array<GLint, sizeof...(parameters)> integerEach(const Functions& gl) {
  return {integers<parameters, 1>(gl)[0]...};
}

/// A mask of all ones, which is the initial value, does not fit a GLint: some drivers answer with the largest
/// one.
constexpr GLint stencilMaskOf(GLint answered) {
  return answered == 0x7fffffff ? -1 : answered;
}

struct ActiveTexture {
  using Type = GLint;
  static constexpr const char* kName = "active texture unit";
  static Type initial() { return GL_TEXTURE0; }
  static Type get(const Functions& gl) { return integers<GL_ACTIVE_TEXTURE, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) { gl.activeTexture(static_cast<GLenum>(value)); }
};

/// Both get and set leave `unit` active; ActiveTexture is put right by the loop over the list.
template <int unit>
struct TextureBinding2D {
  using Type = GLint;
  static constexpr const char* kName = "2D texture binding";
  static Type initial() { return 0; }
  static Type get(const Functions& gl) {
    gl.activeTexture(GL_TEXTURE0 + unit);
    return integers<GL_TEXTURE_BINDING_2D, 1>(gl)[0];
  }
  static void set(const Functions& gl, Type value) {
    gl.activeTexture(GL_TEXTURE0 + unit);
    gl.bindTexture(GL_TEXTURE_2D, static_cast<GLuint>(value));
  }
};

struct ArrayBuffer {
  using Type = GLint;
  static constexpr const char* kName = "array buffer binding";
  static Type initial() { return 0; }
  static Type get(const Functions& gl) { return integers<GL_ARRAY_BUFFER_BINDING, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) {
    gl.bindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(value));
  }
};

struct ElementArrayBuffer {
  using Type = GLint;
  static constexpr const char* kName = "element array buffer binding";
  static Type initial() { return 0; }
  static Type get(const Functions& gl) { return integers<GL_ELEMENT_ARRAY_BUFFER_BINDING, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) {
    gl.bindBuffer(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLuint>(value));
  }
};

/// Array of one vertex attribute. set changes the array buffer binding.
template <GLuint index>
struct AttributeArray {
  struct Type {
    GLint enabled = 0, components = 4, type = GL_FLOAT, normalized = 0, strideBytes = 0, buffer = 0;
    void* pointer = nullptr;
    bool operator==(const Type&) const = default;
  };
  static constexpr const char* kName = "vertex attribute array";
  static Type initial() { return {}; }
  static Type get(const Functions& gl) {
    Type value;
    gl.getVertexAttribiv(index, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &value.enabled);
    gl.getVertexAttribiv(index, GL_VERTEX_ATTRIB_ARRAY_SIZE, &value.components);
    gl.getVertexAttribiv(index, GL_VERTEX_ATTRIB_ARRAY_TYPE, &value.type);
    gl.getVertexAttribiv(index, GL_VERTEX_ATTRIB_ARRAY_NORMALIZED, &value.normalized);
    gl.getVertexAttribiv(index, GL_VERTEX_ATTRIB_ARRAY_STRIDE, &value.strideBytes);
    gl.getVertexAttribiv(index, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &value.buffer);
    gl.getVertexAttribPointerv(index, GL_VERTEX_ATTRIB_ARRAY_POINTER, &value.pointer);
    return value;
  }
  static void set(const Functions& gl, const Type& value) {
    gl.bindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(value.buffer));
    gl.vertexAttribPointer(index, value.components, static_cast<GLenum>(value.type),
                           static_cast<GLboolean>(value.normalized), value.strideBytes, value.pointer);
    if (value.enabled) {
      gl.enableVertexAttribArray(index);
    } else {
      gl.disableVertexAttribArray(index);
    }
  }
};

struct FramebufferBinding {
  using Type = GLint;
  static constexpr const char* kName = "framebuffer binding";
  static Type initial() { return 0; }
  static Type get(const Functions& gl) { return integers<GL_FRAMEBUFFER_BINDING, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) {
    gl.bindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(value));
  }
};

struct RenderbufferBinding {
  using Type = GLint;
  static constexpr const char* kName = "renderbuffer binding";
  static Type initial() { return 0; }
  static Type get(const Functions& gl) { return integers<GL_RENDERBUFFER_BINDING, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) {
    gl.bindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(value));
  }
};

struct CurrentProgram {
  using Type = GLint;
  static constexpr const char* kName = "current program";
  static Type initial() { return 0; }
  static Type get(const Functions& gl) { return integers<GL_CURRENT_PROGRAM, 1>(gl)[0]; }
  static void set(const Functions& gl, Type value) {
    // A program that its owner deleted while it was current is gone once another one is used.
    const bool exists = value == 0 || gl.isProgram(static_cast<GLuint>(value));
    gl.useProgram(exists ? static_cast<GLuint>(value) : 0);
  }
};

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

template <typename Units, typename Attributes>
struct MakeList;
template <int... units, int... attributes>
struct MakeList<std::integer_sequence<int, units...>, std::integer_sequence<int, attributes...>> {
  // Captured first to last, set last to first: the selectors (active unit, array buffer) come first because
  // the entries that follow them disturb them. The framebuffer comes last: drivers clamp stencil values to
  // the bits of the bound one.
  using Type = std::tuple<
      ActiveTexture, TextureBinding2D<units>..., ArrayBuffer,
      AttributeArray<static_cast<GLuint>(attributes)>..., ElementArrayBuffer, CurrentProgram, Viewport,
      ScissorBox, Enable<GL_BLEND>, Enable<GL_CULL_FACE>, Enable<GL_DEPTH_TEST>, Enable<GL_DITHER, true>,
      Enable<GL_POLYGON_OFFSET_FILL>, Enable<GL_SAMPLE_ALPHA_TO_COVERAGE>, Enable<GL_SAMPLE_COVERAGE>,
      Enable<GL_SCISSOR_TEST>, Enable<GL_STENCIL_TEST>, BlendFunc, BlendEquation, BlendColor, ColorMask,
      DepthFunc, DepthMask, DepthRange, StencilFunc<GL_FRONT>, StencilFunc<GL_BACK>, StencilOps<GL_FRONT>,
      StencilOps<GL_BACK>, StencilWriteMask<GL_FRONT>, StencilWriteMask<GL_BACK>, CullFaceMode, FrontFace,
      PolygonOffset, SampleCoverage, ClearColor, ClearDepth, ClearStencil, PixelStore<GL_PACK_ALIGNMENT>,
      PixelStore<GL_UNPACK_ALIGNMENT>, RenderbufferBinding, FramebufferBinding>;
};

/// All of it.
using StateList = MakeList<std::make_integer_sequence<int, kTextureUnits>,
                           std::make_integer_sequence<int, kVertexAttributes>>::Type;

/// The values of a whole list.
template <typename List>
struct ValuesOf;
template <typename... States>
struct ValuesOf<std::tuple<States...>> {
  using Type = std::tuple<typename States::Type...>;
};
using StateValues = ValuesOf<StateList>::Type;

inline constexpr std::size_t kStateCount = std::tuple_size_v<StateList>;

/// Calls `visitor.template operator()<State, index>()` for each entry, first to last.
template <typename Visitor>
void forEachState(Visitor&& visitor) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visitor.template operator()<std::tuple_element_t<i, StateList>, i>(), ...);
  }
  (std::make_index_sequence<kStateCount>());
}
/// The same, last to first.
template <typename Visitor>
void forEachStateReversed(Visitor&& visitor) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visitor.template operator()<std::tuple_element_t<kStateCount - 1 - i, StateList>, kStateCount - 1 - i>(),
     ...);
  }
  (std::make_index_sequence<kStateCount>());
}

/// Reads every value; the state is the same afterwards.
StateValues captureState(const Functions& gl);
void applyState(const Functions& gl, const StateValues& values);
/// Initial values, with the host-sized ones (viewport, scissor box) taken from `host`.
StateValues initialState(const StateValues& host);

}  // namespace halfshadow::gl::state
