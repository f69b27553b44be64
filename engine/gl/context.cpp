// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/context.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

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
int majorVersionOf(const std::string& version) {
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
  if (Status s = context->open(getProcAddress, options); !s) return s.error();
  return context;
}

Status Context::reopen(const GetProcAddress& getProcAddress, const ContextOptions& options) {
  lost_ = false;
  capabilities_ = {};
  faults_.clear();
  noteBindingsChanged();
  Status opened = open(getProcAddress, options);
  if (!opened) markLost();
  return opened;
}

Status Context::open(const GetProcAddress& getProcAddress, const ContextOptions& options) {
  const std::string missing = functions_.load(getProcAddress);
  if (!missing.empty()) {
    return Error{ErrorCode::driverMissing,
                 "getProcAddress does not find these OpenGL ES 2.0 entry points: " + missing +
                     "; give the loader of a current OpenGL ES 2.0 context."};
  }
  const Functions& gl = functions_;
  capabilities_.driver = {stringOf(gl, GL_VENDOR), stringOf(gl, GL_RENDERER), stringOf(gl, GL_VERSION),
                          stringOf(gl, GL_SHADING_LANGUAGE_VERSION)};
  const std::string& version = capabilities_.driver.version;
  if (version.empty()) {
    return Error{ErrorCode::driverMissing,
                 "No OpenGL ES context is current on this thread; make one current first."};
  }
  majorVersion_ = majorVersionOf(version);
  if (majorVersion_ < 2) {
    return Error{ErrorCode::driverMissing,
                 "The current context is \"" + version + "\"; OpenGL ES 2.0 or later is needed."};
  }
  std::istringstream words(stringOf(gl, GL_EXTENSIONS));
  for (std::string word; words >> word;) capabilities_.extensions.push_back(word);
  std::sort(capabilities_.extensions.begin(), capabilities_.extensions.end());
  capabilities_.limits = readLimits(gl);
  {
    const HostStateGuard guard(*this, HostStatePolicy::restore);
    probeCapabilities(*this, capabilities_, options.forcedOff);
  }
  uploads_ = {};
  if (lost_) return checkErrors("Opening the context");
  return {};
}

void Context::markLost() {
  lost_ = true;
  functions_.disconnect();
}

bool Context::advertises(std::string_view extension) const {
  return std::binary_search(capabilities_.extensions.begin(), capabilities_.extensions.end(), extension);
}

GLenum Context::takeError() {
  constexpr GLenum kContextLost = 0x0507;  // of GL_KHR_robustness
  const GLenum error = functions_.getError();
  if (error == kContextLost) markLost();
  return lost_ ? GL_NO_ERROR : error;
}

void Context::collectErrors() {
  for (int i = 0; i < 32; ++i) {
    const GLenum error = takeError();
    if (error == GL_NO_ERROR) return;
    faultsAreMemory_ = faults_.empty() ? error == GL_OUT_OF_MEMORY : faultsAreMemory_;
    faults_ += (faults_.empty() ? "" : ", ") + std::string(errorText(error));
  }
}

void Context::dropFaults() {
  collectErrors();
  faults_.clear();
}

void Context::noteFault(const std::string& what) {
  if (faults_.empty()) faultsAreMemory_ = false;
  faults_ += (faults_.empty() ? "" : ", ") + what;
}

Status Context::checkMemory(std::uint64_t moreBytes, const std::string& what) {
  if (memoryLimit_ == 0 || storedBytes_ + moreBytes <= memoryLimit_) return {};
  limitReached_ = true;
  return Error{ErrorCode::outOfMemory, what + " would take " + std::to_string(storedBytes_ + moreBytes) +
                                           " bytes where setMemoryLimit allows " +
                                           std::to_string(memoryLimit_) +
                                           "; raise it, or choose smaller maps or a smaller target."};
}

Status Context::checkErrors(const char* where) {
  collectErrors();
  if (lost_) {
    return Error{ErrorCode::contextLost, std::string(where) +
                                             ": the context was lost; make a new one current and call "
                                             "contextRestored()."};
  }
  if (faults_.empty()) return {};
  const std::string errors = std::exchange(faults_, {});
  return Error{faultsAreMemory_ ? ErrorCode::outOfMemory : ErrorCode::driverFault,
               std::string(where) + ": the driver raised " + errors + "."};
}

}  // namespace halfshadow::gl
