// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "faulty_gl.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <tuple>

#include "engine_fixture.hpp"
#include "gl/functions.hpp"

namespace halfshadow::test {
namespace {
GLenum pendingError = GL_NO_ERROR;

struct Inside {
  Inside() { ++faultyDriver().inside; }
  ~Inside() { --faultyDriver().inside; }
};

/// "Texture" of glGenTextures, glDeleteTextures; "Program" of glCreateProgram.
std::string kindOf(std::string_view name) {
  for (const std::string_view verb : {"glGen", "glDelete", "glCreate"}) {
    if (name.starts_with(verb)) name.remove_prefix(verb.size());
  }
  if (name.ends_with("EXT")) name.remove_suffix(3);
  if (name.ends_with("ies")) return std::string(name.substr(0, name.size() - 3)) + "y";
  if (name.ends_with("s")) name.remove_suffix(1);
  return std::string(name);
}

void nameMade(std::string_view function, GLuint name) {
  if (name != 0) faultyDriver().alive[kindOf(function)].insert(name);
}

/// Deleting the name 0 deletes nothing.
void nameDeleted(std::string_view function, GLuint name, bool really) {
  if (name == 0) return;
  faultyDriver().strangers += faultyDriver().alive[kindOf(function)].erase(name) == 0;
  if (!really) faultyDriver().left[kindOf(function)].insert(name);
}

/// What glGen… and glDelete… name in their arguments.
template <typename... Arguments>
void keepNames(std::string_view function, bool really, Arguments... arguments) {
  const std::tuple<Arguments...> all(arguments...);
  const bool deletes = function.starts_with("glDelete");
  if constexpr (sizeof...(Arguments) == 1) {
    if constexpr (std::is_same_v<std::tuple_element_t<0, std::tuple<Arguments...>>, GLuint>) {
      if (deletes) nameDeleted(function, std::get<0>(all), really);
    }
  } else if constexpr (sizeof...(Arguments) == 2) {
    using Last = std::tuple_element_t<1, std::tuple<Arguments...>>;
    if constexpr (std::is_same_v<Last, GLuint*> || std::is_same_v<Last, const GLuint*>) {
      const bool makes = function.starts_with("glGen");
      for (GLsizei i = 0; (makes || deletes) && i < std::get<0>(all); ++i) {
        if (makes) nameMade(function, std::get<1>(all)[i]);
        if (deletes) nameDeleted(function, std::get<1>(all)[i], really);
      }
    }
  }
}

void deleteNames(const FaultyDriver::Names& names) {
  const gl::Functions& gl = hostGl();
  for (const auto& [kind, some] : names) {
    for (const GLuint name : some) {
      if (kind == "Buffer") gl.deleteBuffers(1, &name);
      if (kind == "Framebuffer") gl.deleteFramebuffers(1, &name);
      if (kind == "Renderbuffer") gl.deleteRenderbuffers(1, &name);
      if (kind == "Texture") gl.deleteTextures(1, &name);
      if (kind == "Query") gl.deleteQueries(1, &name);
      if (kind == "Program") gl.deleteProgram(name);
      if (kind == "Shader") gl.deleteShader(name);
    }
  }
}

bool movesVertices(std::string_view name) {
  return name == "glBindBuffer" || name.starts_with("glVertexAttrib") ||
         name.ends_with("VertexAttribArray") || name.starts_with("glBufferData") ||
         name == "glBindVertexArray";
}

bool asks(std::string_view name) {
  return name.starts_with("glGet") || name.starts_with("glIs") || name.starts_with("glCheck") ||
         name == "glReadPixels";
}

/// A status query answers "no".
template <typename Tuple>
void refuseStatus(std::string_view name, const Tuple& arguments) {
  if constexpr (std::tuple_size_v<Tuple> == 3) {
    if constexpr (std::is_same_v<std::tuple_element_t<2, Tuple>, GLint*>) {
      if (name == "glGetShaderiv" || name == "glGetProgramiv") *std::get<2>(arguments) = 0;
    }
  }
}

template <typename Name, typename Result, typename... Arguments>
struct Faulty {
  static inline Result(GL_APIENTRYP driver)(Arguments...) = nullptr;
  static inline const char* name = "";
  static Result GL_APIENTRY call(Arguments... arguments) {
    const Inside inside;
    FaultyDriver& faulty = faultyDriver();
    if (faulty.gone) {
      ++faulty.callsAfterLoss;
      return Result();
    }
    if (faulty.fault != Fault::none && asks(name)) ++faulty.queries;
    if (std::string_view(name) == "glGetError") {
      if constexpr (std::is_same_v<Result, GLenum>) {
        if (pendingError != GL_NO_ERROR) {
          faulty.drawsAreUnsafe = false;  // the engine knows from here on
          return std::exchange(pendingError, GL_NO_ERROR);
        }
      }
      return driver(arguments...);
    } else {
      if (faulty.fault != Fault::none && faulty.calls++ == faulty.failingCall) {
        faulty.failedAt = name;
        faulty.drawsAreUnsafe = movesVertices(name);
        if (faulty.fault == Fault::outOfMemory) pendingError = GL_OUT_OF_MEMORY;
        if (faulty.fault == Fault::invalid) pendingError = GL_INVALID_OPERATION;
        if (faulty.fault == Fault::lost) {
          faulty.gone = true;
          if (faulty.onLost) faulty.onLost();
        }
        refuseStatus(name, std::tuple<Arguments...>(arguments...));
        // A deletion that does nothing leaks in the driver, not here.
        if (std::string_view(name).starts_with("glDelete")) keepNames(name, false, arguments...);
        return Result();
      }
      if (faulty.drawsAreUnsafe && std::string_view(name).starts_with("glDraw")) return Result();
      if constexpr (std::is_void_v<Result>) {
        driver(arguments...);
        keepNames(name, true, arguments...);
      } else {
        const Result result = driver(arguments...);
        if constexpr (std::is_same_v<Result, GLuint>) {
          if (std::string_view(name).starts_with("glCreate")) nameMade(name, result);
        }
        return result;
      }
    }
  }
};
template <typename Name, typename Result, typename... Arguments>
void* faultyFunction(const char* name, Result(GL_APIENTRYP)(Arguments...), void* driver) {
  using Function = Faulty<Name, Result, Arguments...>;
  if (driver == nullptr) return nullptr;
  Function::driver = reinterpret_cast<Result(GL_APIENTRYP)(Arguments...)>(driver);
  Function::name = name;
  return reinterpret_cast<void*>(&Function::call);
}

void* load(const char* name, void* user) {
  const Inside inside;
  void* driver = static_cast<HeadlessContext*>(user)->getProcAddress(name);
  const std::string_view wanted(name);
#define HALFSHADOW_FAULTY_CORE(member, glName) \
  struct Name_##member {};                     \
  if (wanted == #glName)                       \
    return faultyFunction<Name_##member>(#glName, static_cast<decltype(&::glName)>(nullptr), driver);
  HALFSHADOW_GL_CORE_FUNCTIONS(HALFSHADOW_FAULTY_CORE)
#undef HALFSHADOW_FAULTY_CORE
#define HALFSHADOW_FAULTY_OPTIONAL(member, glName, type) \
  struct Name_##member {};                               \
  if (wanted == glName) return faultyFunction<Name_##member>(glName, static_cast<type>(nullptr), driver);
  HALFSHADOW_GL_OPTIONAL_FUNCTIONS(HALFSHADOW_FAULTY_OPTIONAL)
#undef HALFSHADOW_FAULTY_OPTIONAL
  return driver;
}
}  // namespace

const char* faultName(Fault fault) {
  constexpr const char* kNames[] = {"none", "out of memory", "invalid", "dropped", "refused", "lost"};
  return kNames[static_cast<int>(fault)];
}

void FaultyDriver::arm(Fault what, std::uint64_t call) {
  fault = what;
  failingCall = call;
  calls = queries = 0;
  gone = false;
  callsAfterLoss = 0;
  failedAt = "";
}

void FaultyDriver::disarm() {
  fault = Fault::none;
  gone = false;
  drawsAreUnsafe = false;
  pendingError = GL_NO_ERROR;
  deleteNames(left);
  left.clear();
}

void FaultyDriver::endContext() {
  hostGl().useProgram(0);
  deleteNames(alive);
  alive.clear();
  strangers = 0;
}

std::size_t FaultyDriver::aliveCount() const {
  std::size_t count = 0;
  for (const auto& [kind, names] : alive) count += names.size();
  return count;
}

FaultyDriver& faultyDriver() {
  static FaultyDriver driver;
  return driver;
}

std::uint64_t faultStride(std::uint64_t bounded) {
  const char* asked = std::getenv("HALFSHADOW_TEST_FAULT_STRIDE");
  return asked ? std::max<std::uint64_t>(std::strtoull(asked, nullptr, 10), 1) : bounded;
}

std::vector<std::string> faultedTechniques(Engine& engine) {
  const char* asked = std::getenv("HALFSHADOW_TEST_TECHNIQUES");
  if (asked == nullptr) return techniquesBut(engine, {});
  std::vector<std::string> techniques;
  std::istringstream list(asked);
  for (std::string name; std::getline(list, name, ',');) techniques.push_back(name);
  return techniques;
}

EngineDesc faultyDesc(HostState hostState) {
  return {.getProcAddress = load, .getProcAddressUser = headless(), .hostState = hostState};
}

std::unique_ptr<Engine> makeFaultyEngine(HostState hostState) {
  Outcome outcome;
  std::unique_ptr<Engine> engine(Engine::create(faultyDesc(hostState), outcome));
  EXPECT_TRUE(outcome.ok()) << outcome.message;
  return engine;
}

}  // namespace halfshadow::test
