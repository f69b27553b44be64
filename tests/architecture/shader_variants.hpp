// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The shader variants that tests compile: of what the techniques declare.
#pragma once

#include "device/shader_family.hpp"

namespace halfshadow::architecture {

/// One variant as a driver would get it, on a context with or without highp and derivatives.
struct ShaderVariant {
  std::string vertexFile, fragmentFile;
  std::vector<std::string> defines;
  bool highp = true, derivatives = true;
};

/// Of `family` so many that any two choices of two axes that can be taken together are in one of them.
std::vector<ShaderVariant> compiledVariants(const device::ShaderFamily& family);
/// Of all families.
const std::vector<ShaderVariant>& shaderVariants();

}  // namespace halfshadow::architecture
