// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a technique would not plan.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "techniques/core/technique.hpp"

namespace halfshadow::api {

/// Casters that a technique could not plan: they are not tried again in every frame.
struct Refusal {
  const techniques::Technique* technique = nullptr;
  std::vector<std::uint32_t> casters;  ///< by index in the scene's lists
  std::uint64_t settings = 0;          ///< their revision
  std::string why;
};

}  // namespace halfshadow::api
