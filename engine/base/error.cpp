// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "base/error.hpp"

namespace halfshadow {

std::string_view errorName(ErrorCode code) {
  switch (code) {
#define HALFSHADOW_ERROR_NAME(name, NAME, text) \
  case ErrorCode::name:                         \
    return #name;
    HALFSHADOW_ERROR_LIST(HALFSHADOW_ERROR_NAME)
#undef HALFSHADOW_ERROR_NAME
  }
  return "internal";
}

std::string_view errorText(ErrorCode code) {
  switch (code) {
#define HALFSHADOW_ERROR_TEXT(name, NAME, text) \
  case ErrorCode::name:                         \
    return text;
    HALFSHADOW_ERROR_LIST(HALFSHADOW_ERROR_TEXT)
#undef HALFSHADOW_ERROR_TEXT
  }
  return "unknown error";
}

}  // namespace halfshadow
