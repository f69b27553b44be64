// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "device/capabilities.hpp"

namespace halfshadow::device {
namespace {

struct Row {
  Capability capability;
  std::string_view name, text;
};
constexpr Row kRows[] = {
#define HALFSHADOW_CAPABILITY_ROW(name, option, text) {Capability::name, option, text},
    HALFSHADOW_CAPABILITY_LIST(HALFSHADOW_CAPABILITY_ROW)
#undef HALFSHADOW_CAPABILITY_ROW
};

}  // namespace

std::string_view capabilityName(Capability capability) {
  return kRows[static_cast<std::size_t>(capability)].name;
}

std::string_view capabilityText(Capability capability) {
  return kRows[static_cast<std::size_t>(capability)].text;
}

Result<Capability> capabilityFromName(std::string_view name) {
  std::string known;
  for (const Row& row : kRows) {
    if (row.name == name) return row.capability;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  return Error{ErrorCode::invalidArgument,
               "There is no capability \"" + std::string(name) + "\"; known are " + known + "."};
}

}  // namespace halfshadow::device
