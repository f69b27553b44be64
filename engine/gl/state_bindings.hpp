// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// State types of bindings: textures, buffers, attributes, framebuffer, program. See state_list.hpp.
#pragma once

#include <array>

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

}  // namespace halfshadow::gl::state
