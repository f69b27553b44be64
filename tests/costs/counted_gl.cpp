// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "counted_gl.hpp"

#include <string_view>

#include "engine_fixture.hpp"
#include "gl/functions.hpp"

namespace halfshadow::test {
namespace {
std::uint64_t calls = 0;

/// The driver's function behind one that counts; `Name` tells apart functions of one type.
template <typename Name, typename Result, typename... Arguments>
struct Counted {
  static inline Result (*driver)(Arguments...) = nullptr;
  static Result call(Arguments... arguments) {
    ++calls;
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
#define HALFSHADOW_COUNT_CORE(member, glName) \
  struct Name_##member {};                    \
  if (wanted == #glName) return counted<Name_##member>(static_cast<decltype(&::glName)>(nullptr), driver);
  HALFSHADOW_GL_CORE_FUNCTIONS(HALFSHADOW_COUNT_CORE)
#undef HALFSHADOW_COUNT_CORE
#define HALFSHADOW_COUNT_OPTIONAL(member, glName, type) \
  struct Name_##member {};                              \
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

}  // namespace halfshadow::test
