// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/functions.hpp"

namespace halfshadow::gl {
namespace {
template <typename Result, typename... Arguments>
Result GL_APIENTRY nothing(Arguments...) {
  return Result();
}
template <typename Result, typename... Arguments>
void disconnectOne(Result(GL_APIENTRYP& function)(Arguments...)) {
  if (function) function = &nothing<Result, Arguments...>;
}
}  // namespace

void Functions::disconnect() {
#define HALFSHADOW_GL_DISCONNECT(member, ...) disconnectOne(member);
  HALFSHADOW_GL_CORE_FUNCTIONS(HALFSHADOW_GL_DISCONNECT)
  HALFSHADOW_GL_OPTIONAL_FUNCTIONS(HALFSHADOW_GL_DISCONNECT)
#undef HALFSHADOW_GL_DISCONNECT
}

std::string Functions::load(const std::function<void*(const char* name)>& getProcAddress) {
  std::string missing;
#define HALFSHADOW_GL_LOAD_CORE(member, glName)                            \
  member = reinterpret_cast<decltype(&::glName)>(getProcAddress(#glName)); \
  if (!member) missing += (missing.empty() ? "" : " ") + std::string(#glName);
  HALFSHADOW_GL_CORE_FUNCTIONS(HALFSHADOW_GL_LOAD_CORE)
#undef HALFSHADOW_GL_LOAD_CORE
#define HALFSHADOW_GL_LOAD_OPTIONAL(member, glName, type) \
  member = reinterpret_cast<type>(getProcAddress(glName));
  HALFSHADOW_GL_OPTIONAL_FUNCTIONS(HALFSHADOW_GL_LOAD_OPTIONAL)
#undef HALFSHADOW_GL_LOAD_OPTIONAL
  return missing;
}

}  // namespace halfshadow::gl
