// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/program.hpp"

#include <algorithm>
#include <cstdlib>
#include <glm/gtc/type_ptr.hpp>

#include "base/keys.hpp"
#include "gl/allocation.hpp"

namespace halfshadow::gl {
namespace {

constexpr VertexAttribute kAttributes[] = {
    VertexAttribute::position, VertexAttribute::normal, VertexAttribute::texcoord, VertexAttribute::extra0,
    VertexAttribute::extra1,   VertexAttribute::extra2, VertexAttribute::extra3,   VertexAttribute::extra4};

/// Log of a shader or a program, by the pair of entry points that reads it.
template <typename GetParameter, typename GetLog>
std::string infoLog(GetParameter getParameter, GetLog getLog, GLuint name) {
  GLint length = 0;
  getParameter(name, GL_INFO_LOG_LENGTH, &length);
  if (length <= 1) return "the driver gave no log";
  std::string log(static_cast<std::size_t>(length), '\0');
  GLsizei written = 0;
  getLog(name, length, &written, log.data());
  log.resize(static_cast<std::size_t>(std::clamp(written, 0, length)));
  return log;
}

std::string shaderLog(const Functions& gl, GLuint shader) {
  return infoLog(gl.getShaderiv, gl.getShaderInfoLog, shader);
}

std::string programLog(const Functions& gl, GLuint program) {
  return infoLog(gl.getProgramiv, gl.getProgramInfoLog, program);
}

/// A shader that lives as long as the link.
class Shader {
 public:
  Shader(const Functions& gl, GLenum stage) : gl_(gl), name_(gl.createShader(stage)) {}
  ~Shader() { gl_.deleteShader(name_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint name() const { return name_; }

  bool compile(std::string_view source) {
    const char* text = source.data();
    const GLint length = static_cast<GLint>(source.size());
    gl_.shaderSource(name_, 1, &text, &length);
    gl_.compileShader(name_);
    GLint compiled = GL_FALSE;
    gl_.getShaderiv(name_, GL_COMPILE_STATUS, &compiled);
    return compiled == GL_TRUE;
  }

 private:
  const Functions& gl_;
  GLuint name_;
};

std::string nameWithoutIndex(const char* name) {
  std::string text(name);
  if (text.ends_with("[0]")) text.resize(text.size() - 3);
  return text;
}

}  // namespace

const char* attributeName(VertexAttribute attribute) {
  switch (attribute) {
    case VertexAttribute::position:
      return "a_position";
    case VertexAttribute::normal:
      return "a_normal";
    case VertexAttribute::texcoord:
      return "a_texcoord";
    case VertexAttribute::extra0:
      return "a_extra0";
    case VertexAttribute::extra1:
      return "a_extra1";
    case VertexAttribute::extra2:
      return "a_extra2";
    case VertexAttribute::extra3:
      return "a_extra3";
    case VertexAttribute::extra4:
      return "a_extra4";
  }
  return "";
}

Result<Program> Program::link(Context& context, std::string_view vertexSource,
                              std::string_view fragmentSource, const std::vector<std::string>& samplerNames,
                              std::string_view label) {
  Program program;
  program.label_ = label;
  program.sourceKey_ = combineKeys(halfshadow::textKey(vertexSource), halfshadow::textKey(fragmentSource));
  program.object_ = Object<ObjectKind::program>::create(context);
  if (!program.object_) {
    return noNameError(context, "Program " + program.label_);
  }
  const Functions& gl = context.functions();
  const auto failure = [&](const char* step, const std::string& log) {
    return Error{ErrorCode::shaderFailed, "Program " + program.label_ + ": " + step + ": " + log};
  };
  Shader vertex(gl, GL_VERTEX_SHADER), fragment(gl, GL_FRAGMENT_SHADER);
  if (!vertex.compile(vertexSource)) {
    return failure("the vertex shader does not compile", shaderLog(gl, vertex.name()));
  }
  if (!fragment.compile(fragmentSource)) {
    return failure("the fragment shader does not compile", shaderLog(gl, fragment.name()));
  }
  gl.attachShader(program.name(), vertex.name());
  gl.attachShader(program.name(), fragment.name());
  for (const VertexAttribute attribute : kAttributes) {
    gl.bindAttribLocation(program.name(), static_cast<GLuint>(attribute), attributeName(attribute));
  }
  gl.linkProgram(program.name());
  GLint linked = GL_FALSE;
  gl.getProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (context.lost()) return noNameError(context, "Program " + program.label_);
  if (linked != GL_TRUE) return failure("the stages do not link", programLog(gl, program.name()));

  program.reflect(context, samplerNames);
  // It is kept, and with it what it was asked: no later frame would ask again.
  if (Status s = context.checkErrors(("Program " + program.label_).c_str()); !s) return s.error();
  return program;
}

void Program::reflect(Context& context, const std::vector<std::string>& samplerNames) {
  const Functions& gl = context.functions();
  GLint count = 0, longestName = 0;
  gl.getProgramiv(name(), GL_ACTIVE_UNIFORMS, &count);
  gl.getProgramiv(name(), GL_ACTIVE_UNIFORM_MAX_LENGTH, &longestName);
  std::vector<char> buffer(static_cast<std::size_t>(std::max(longestName, 1)) + 1);
  struct ActiveSampler {
    std::size_t rank;  // place in samplerNames
    std::uint32_t hash;
  };
  std::vector<ActiveSampler> samplers;
  bool isWhole = true;
  for (GLint i = 0; i < count; ++i) {
    GLsizei length = 0;
    GLint arraySize = 1;
    GLenum type = GL_FLOAT;
    buffer[0] = '\0';
    gl.getActiveUniform(name(), static_cast<GLuint>(i), static_cast<GLsizei>(buffer.size()), &length,
                        &arraySize, &type, buffer.data());
    isWhole = isWhole && buffer[0] != '\0';
    const std::string uniformName = nameWithoutIndex(buffer.data());
    Uniform uniform;
    uniform.hash = UniformKey::hashOf(uniformName);
    if (uniformName.starts_with(kTextKeyPrefix)) {
      textKey_ = std::strtoull(uniformName.c_str() + kTextKeyPrefix.size(), nullptr, 16);
      textKeyUniform_.hash = uniform.hash;
    }
    uniform.location = gl.getUniformLocation(name(), buffer.data());
    uniform.type = type;
    uniform.arraySize = arraySize;
    if (uniform.location < 0) continue;  // built-in
    if (type == GL_SAMPLER_2D || type == GL_SAMPLER_CUBE) {
      const auto place = std::find(samplerNames.begin(), samplerNames.end(), uniformName);
      samplers.push_back({static_cast<std::size_t>(place - samplerNames.begin()), uniform.hash});
    }
    uniforms_.push_back(std::move(uniform));
  }
  std::sort(uniforms_.begin(), uniforms_.end(),
            [](const Uniform& a, const Uniform& b) { return a.hash < b.hash; });
  std::stable_sort(samplers.begin(), samplers.end(),
                   [](const ActiveSampler& a, const ActiveSampler& b) { return a.rank < b.rank; });

  if (!isWhole) textKey_ = 0;  // a query was not answered: it is not known
  if (wrapped_ != 0) return;   // the host decides
  // A link happens at any time, also between useProgram and draw: the current program stays what it was.
  GLint current = 0;
  gl.getIntegerv(GL_CURRENT_PROGRAM, &current);
  gl.useProgram(name());
  // A program that was deleted while current is gone now.
  if (current != 0 && !gl.isProgram(static_cast<GLuint>(current))) current = 0;
  int unit = 0;
  for (const ActiveSampler& sampler : samplers) {
    Uniform& uniform = *findUniform(sampler.hash);
    uniform.samplerUnit = unit;
    std::vector<GLint> units(static_cast<std::size_t>(uniform.arraySize));
    for (GLint& element : units) element = unit++;
    gl.uniform1iv(uniform.location, uniform.arraySize, units.data());
  }
  gl.useProgram(static_cast<GLuint>(current));
}

Program Program::wrap(Context& context, std::uint32_t name) {
  Program program;
  program.wrapped_ = name;
  program.label_ = "the host's program " + std::to_string(name);
  program.reflect(context, {});
  return program;
}

void Program::setSampler(Context& context, UniformKey key, int unit) {
  Uniform* uniform = findUniform(key.hash);
  if (!uniform || context.lost() || uniform->samplerUnit == unit) return;
  uniform->samplerUnit = unit;
  context.functions().uniform1i(uniform->location, unit);
}

const Program::Uniform* Program::find(UniformKey key) const {
  return findUniform(key.hash);
}

const Program::Uniform* Program::findUniform(std::uint32_t hash) const {
  const auto place =
      std::lower_bound(uniforms_.begin(), uniforms_.end(), hash,
                       [](const Uniform& uniform, std::uint32_t h) { return uniform.hash < h; });
  return place != uniforms_.end() && place->hash == hash ? &*place : nullptr;
}

Program::Uniform* Program::findUniform(std::uint32_t hash) {
  return const_cast<Uniform*>(std::as_const(*this).findUniform(hash));
}

int Program::samplerUnit(UniformKey key) const {
  const Uniform* uniform = find(key);
  return uniform ? uniform->samplerUnit : -1;
}

Program::Uniform* Program::changed(Context& context, UniformKey key, const float* values, std::size_t count) {
  Uniform* uniform = findUniform(key.hash);
  if (!uniform || context.lost()) return nullptr;
  if (uniform->last.size() == count && std::equal(values, values + count, uniform->last.begin()))
    return nullptr;
  uniform->last.assign(values, values + count);
  ++context.uploads().uniforms;
  return uniform;
}

void Program::set(Context& context, UniformKey key, float value) {
  const Uniform* uniform = changed(context, key, &value, 1);
  if (!uniform) return;
  if (uniform->type == GL_INT || uniform->type == GL_BOOL) {
    context.functions().uniform1i(uniform->location, static_cast<GLint>(value));
  } else {
    context.functions().uniform1f(uniform->location, value);
  }
}

void Program::set(Context& context, UniformKey key, const glm::vec2& value) {
  setArray(context, key, &value, 1);
}

void Program::set(Context& context, UniformKey key, const glm::vec3& value) {
  if (const Uniform* uniform = changed(context, key, glm::value_ptr(value), 3)) {
    context.functions().uniform3fv(uniform->location, 1, glm::value_ptr(value));
  }
}

void Program::set(Context& context, UniformKey key, const glm::vec4& value) {
  setArray(context, key, &value, 1);
}

void Program::set(Context& context, UniformKey key, const glm::mat3& value) {
  if (const Uniform* uniform = changed(context, key, glm::value_ptr(value), 9)) {
    context.functions().uniformMatrix3fv(uniform->location, 1, GL_FALSE, glm::value_ptr(value));
  }
}

void Program::set(Context& context, UniformKey key, const glm::mat4& value) {
  if (const Uniform* uniform = changed(context, key, glm::value_ptr(value), 16)) {
    context.functions().uniformMatrix4fv(uniform->location, 1, GL_FALSE, glm::value_ptr(value));
  }
}

void Program::setArray(Context& context, UniformKey key, const glm::vec4* values, int count) {
  const float* floats = glm::value_ptr(*values);
  if (const Uniform* uniform = changed(context, key, floats, static_cast<std::size_t>(count) * 4)) {
    context.functions().uniform4fv(uniform->location, std::min(count, uniform->arraySize), floats);
  }
}

void Program::setArray(Context& context, UniformKey key, const glm::vec2* values, int count) {
  const float* floats = glm::value_ptr(*values);
  if (const Uniform* uniform = changed(context, key, floats, static_cast<std::size_t>(count) * 2)) {
    context.functions().uniform2fv(uniform->location, std::min(count, uniform->arraySize), floats);
  }
}

void Program::set(Context& context, const device::UniformList& uniforms) {
  for (const device::UniformList::Entry& entry : uniforms.entries()) {
    std::visit(
        [&](const auto& value) {
          if constexpr (requires { value.data(); }) {
            setArray(context, entry.key, value.data(), static_cast<int>(value.size()));
          } else {
            set(context, entry.key, value);
          }
        },
        entry.value);
  }
}

}  // namespace halfshadow::gl
