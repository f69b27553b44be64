// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/skips.hpp"

namespace halfshadow::planner {

std::string_view skipCode(SkipReason reason) {
  switch (reason) {
#define HALFSHADOW_SKIP_CODE(name, code, text) \
  case SkipReason::name:                       \
    return code;
    HALFSHADOW_SKIP_LIST(HALFSHADOW_SKIP_CODE)
#undef HALFSHADOW_SKIP_CODE
  }
  return "unknown";
}

std::string_view skipText(SkipReason reason) {
  switch (reason) {
#define HALFSHADOW_SKIP_TEXT(name, code, text) \
  case SkipReason::name:                       \
    return text;
    HALFSHADOW_SKIP_LIST(HALFSHADOW_SKIP_TEXT)
#undef HALFSHADOW_SKIP_TEXT
  }
  return "unknown";
}

std::string skipName(const Skip& skip) {
  const std::string light = "light " + std::to_string(skip.light), id = std::to_string(skip.id);
  switch (skip.subject) {
    case Skip::Subject::caster:
      return "caster " + id + (skip.amongLights ? " for " + light : "");
    case Skip::Subject::receiver:
      return "receiver " + id;
    case Skip::Subject::light:
      break;
  }
  return light;
}

}  // namespace halfshadow::planner
