// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "faulty_gl.hpp"

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

/// Names made by glGen…, glCreate… less those deleted.
template <typename Tuple>
void countNames(std::string_view name, const Tuple& arguments) {
  long sign = 0;
  if (name.starts_with("glGen") && name != "glGenerateMipmap") sign = 1;
  if (name.starts_with("glDelete")) sign = -1;
  if (name.starts_with("glCreate")) sign = 1;
  if (sign == 0) return;
  std::string kind(name.substr(name.find_first_of("GDC") == 2 ? 2 : 2));
  for (const char* verb : {"Gen", "Delete", "Create"}) {
    if (kind.starts_with(verb)) kind = kind.substr(std::string_view(verb).size());
  }
  if (kind.ends_with("s")) kind.pop_back();
  long count = 1;
  if constexpr (std::tuple_size_v<Tuple> == 2) {
    if constexpr (std::is_integral_v<std::tuple_element_t<0, Tuple>>)
      count = static_cast<long>(std::get<0>(arguments));
  } else if constexpr (std::tuple_size_v<Tuple> == 1) {
    // Deleting the name 0 deletes nothing.
    if (sign < 0 && std::get<0>(arguments) == 0) return;
  }
  faultyDriver().alive[kind] += sign * count;
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
        if (std::string_view(name).starts_with("glDelete"))
          countNames(name, std::tuple<Arguments...>(arguments...));
        return Result();
      }
      if (faulty.drawsAreUnsafe && std::string_view(name).starts_with("glDraw")) return Result();
      countNames(name, std::tuple<Arguments...>(arguments...));
      return driver(arguments...);
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
}

FaultyDriver& faultyDriver() {
  static FaultyDriver driver;
  return driver;
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
