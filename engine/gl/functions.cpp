// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/functions.hpp"

namespace halfshadow::gl {

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
