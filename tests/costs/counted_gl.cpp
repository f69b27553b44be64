// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "counted_gl.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "engine_fixture.hpp"
#include "gl/functions.hpp"

namespace halfshadow::test {
namespace {
std::uint64_t calls = 0;

/// By function and, of those that set one of several, which.
std::map<std::string, std::string> state;
std::set<std::string> drawnStates;

constexpr std::array<std::string_view, 11> kStateFunctions{
    "glUseProgram", "glBlendFuncSeparate", "glBlendEquationSeparate", "glColorMask",
    "glDepthFunc",  "glDepthMask",         "glStencilOpSeparate",     "glCullFace",
    "glFrontFace",  "glPolygonOffset",     "glStencilMaskSeparate"};

template <typename... Arguments>
std::string written(Arguments... arguments) {
  std::ostringstream text;
  ((text << ' ' << +arguments), ...);
  return text.str();
}

/// What a call changes of the state in which the next draw happens; a draw keeps it.
template <typename... Arguments>
void follow(std::string_view name, Arguments... arguments) {
  if constexpr ((std::is_arithmetic_v<Arguments> && ...)) {
    if (name == "glEnable") state["capability" + written(arguments...)] = "on";
    if (name == "glDisable") state.erase("capability" + written(arguments...));
    if (name == "glStencilOpSeparate" || name == "glStencilMaskSeparate") {
      const std::string text = written(arguments...);
      state[std::string(name) + text.substr(0, text.find(' ', 1))] = text;
    } else if (std::ranges::find(kStateFunctions, name) != kStateFunctions.end()) {
      state[std::string(name)] = written(arguments...);
    }
  }
  if (name != "glDrawArrays" && name != "glDrawElements") return;
  std::string all;
  for (const auto& [key, value] : state) all += key + ':' + value + '\n';
  drawnStates.insert(std::move(all));
}

/// The driver's function behind one that counts; `Name` tells apart functions of one type.
template <typename Name, typename Result, typename... Arguments>
struct Counted {
  static inline Result (*driver)(Arguments...) = nullptr;
  static Result call(Arguments... arguments) {
    ++calls;
    follow(Name::function(), arguments...);
    return driver(arguments...);
  }
};
template <typename Name, typename Result, typename... Arguments>
void* counted(Result (*)(Arguments...), void* driver) {
  using Function = Counted<Name, Result, Arguments...>;
  if (driver == nullptr) return nullptr;
  Function::driver = reinterpret_cast<Result (*)(Arguments...)>(driver);
  return reinterpret_cast<void*>(&Function::call);
}

void* load(const char* name, void* user) {
  void* driver = static_cast<HeadlessContext*>(user)->getProcAddress(name);
  const std::string_view wanted(name);
#define HALFSHADOW_COUNT_CORE(member, glName)              \
  struct Name_##member {                                   \
    static std::string_view function() { return #glName; } \
  };                                                       \
  if (wanted == #glName) return counted<Name_##member>(static_cast<decltype(&::glName)>(nullptr), driver);
  HALFSHADOW_GL_CORE_FUNCTIONS(HALFSHADOW_COUNT_CORE)
#undef HALFSHADOW_COUNT_CORE
#define HALFSHADOW_COUNT_OPTIONAL(member, glName, type)   \
  struct Name_##member {                                  \
    static std::string_view function() { return glName; } \
  };                                                      \
  if (wanted == glName) return counted<Name_##member>(static_cast<type>(nullptr), driver);
  HALFSHADOW_GL_OPTIONAL_FUNCTIONS(HALFSHADOW_COUNT_OPTIONAL)
#undef HALFSHADOW_COUNT_OPTIONAL
  return driver;
}
}  // namespace

std::unique_ptr<Engine> makeCountedEngine() {
  Outcome outcome;
  std::unique_ptr<Engine> engine(Engine::create(
      {.getProcAddress = load, .getProcAddressUser = headless(), .hostState = HostState::leaveDirty},
      outcome));
  EXPECT_TRUE(outcome.ok()) << outcome.message;
  return engine;
}

std::uint64_t glCallCount() {
  return calls;
}

std::set<std::string> takeDrawnStates() {
  return std::exchange(drawnStates, {});
}

}  // namespace halfshadow::test
