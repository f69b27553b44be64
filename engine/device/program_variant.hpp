// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Which program: its files and what selects its variant. No GL.
#pragma once

#include <string>
#include <vector>

namespace halfshadow::device {

/// `defines` are "NAME" or "NAME VALUE" lines put in front, in order.
struct ProgramVariant {
  std::string vertexFile;
  std::string fragmentFile;
  std::vector<std::string> defines;
  auto operator<=>(const ProgramVariant&) const = default;
};

}  // namespace halfshadow::device
