// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/context.hpp"

#include <algorithm>
#include <sstream>

#include "gl/host_state.hpp"
#include "gl/probes.hpp"

namespace halfshadow::gl {
namespace {

std::string stringOf(const Functions& gl, GLenum name) {
  const GLubyte* text = gl.getString(name);
  return text ? reinterpret_cast<const char*>(text) : "";
}

int integerOf(const Functions& gl, GLenum name, int fallback) {
  GLint value = fallback;
  gl.getIntegerv(name, &value);
  return value;
}

device::Limits readLimits(const Functions& gl) {
  device::Limits limits;
  limits.textureSize = integerOf(gl, GL_MAX_TEXTURE_SIZE, limits.textureSize);
  limits.renderbufferSize = integerOf(gl, GL_MAX_RENDERBUFFER_SIZE, limits.renderbufferSize);
  limits.varyingVectors = integerOf(gl, GL_MAX_VARYING_VECTORS, limits.varyingVectors);
  limits.subpixelBits = integerOf(gl, GL_SUBPIXEL_BITS, limits.subpixelBits);
  limits.vertexUniformVectors = integerOf(gl, GL_MAX_VERTEX_UNIFORM_VECTORS, limits.vertexUniformVectors);
  limits.fragmentUniformVectors =
      integerOf(gl, GL_MAX_FRAGMENT_UNIFORM_VECTORS, limits.fragmentUniformVectors);
  limits.fragmentTextureUnits = integerOf(gl, GL_MAX_TEXTURE_IMAGE_UNITS, limits.fragmentTextureUnits);
  limits.vertexTextureUnits = integerOf(gl, GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, limits.vertexTextureUnits);
  limits.vertexAttributes = integerOf(gl, GL_MAX_VERTEX_ATTRIBS, limits.vertexAttributes);
  return limits;
}

/// Major version of "OpenGL ES 3.2 …"; 0 when the text is of another form.
int majorVersion(const std::string& version) {
  constexpr std::string_view kPrefix = "OpenGL ES ";
  if (!version.starts_with(kPrefix) || version.size() <= kPrefix.size()) return 0;
  const char digit = version[kPrefix.size()];
  return digit >= '0' && digit <= '9' ? digit - '0' : 0;
}

const char* errorText(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an unknown GL error";
  }
}

}  // namespace

Result<std::unique_ptr<Context>> Context::create(const GetProcAddress& getProcAddress,
                                                 const ContextOptions& options) {
  std::unique_ptr<Context> context(new Context());
  const std::string missing = context->functions_.load(getProcAddress);
  if (!missing.empty()) {
    return Error{ErrorCode::driverMissing,
                 "getProcAddress does not find these OpenGL ES 2.0 entry points: " + missing +
                     "; give the loader of a current OpenGL ES 2.0 context."};
  }
  const Functions& gl = context->functions_;
  device::Capabilities& capabilities = context->capabilities_;
  capabilities.driver = {stringOf(gl, GL_VENDOR), stringOf(gl, GL_RENDERER), stringOf(gl, GL_VERSION),
                         stringOf(gl, GL_SHADING_LANGUAGE_VERSION)};
  if (capabilities.driver.version.empty()) {
    return Error{ErrorCode::driverMissing,
                 "No OpenGL ES context is current on this thread; make one current first."};
  }
  if (majorVersion(capabilities.driver.version) < 2) {
    return Error{ErrorCode::driverMissing, "The current context is \"" + capabilities.driver.version +
                                               "\"; OpenGL ES 2.0 or later is needed."};
  }
  std::istringstream words(stringOf(gl, GL_EXTENSIONS));
  for (std::string word; words >> word;) capabilities.extensions.push_back(word);
  std::sort(capabilities.extensions.begin(), capabilities.extensions.end());
  capabilities.limits = readLimits(gl);

  {
    const HostStateGuard guard(*context, HostStatePolicy::restore);
    probeCapabilities(*context, capabilities, options.forcedOff);
  }
  context->uploads_ = {};
  return context;
}

Status Context::checkErrors(const char* where) const {
  if (lost_)
    return Error{ErrorCode::contextLost, std::string(where) + ": the context was lost; create a new one."};
  std::string errors;
  // A lost context may answer with errors for ever.
  for (int i = 0; i < 32; ++i) {
    const GLenum error = functions_.getError();
    if (error == GL_NO_ERROR) break;
    errors += (errors.empty() ? "" : ", ") + std::string(errorText(error));
  }
  if (errors.empty()) return {};
  return Error{ErrorCode::driverFault, std::string(where) + ": the driver raised " + errors + "."};
}

}  // namespace halfshadow::gl
