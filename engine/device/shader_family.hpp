// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Which variants of a pair of shader files there are. No GL.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "device/capabilities.hpp"
#include "device/program_variant.hpp"

namespace halfshadow::device {

/// What an axis may stand at.
struct ShaderChoice {
  /// All of these and none else of the axis. One that ends in '*' means every define that begins so.
  std::vector<std::string> defines{};
  /// What must hold besides: "NAME" or "NAME VALUE" is set, "!NAME" is not. HS_NO_HIGHP and HS_DERIVATIVES,
  /// which the context sets, may be named.
  std::vector<std::string> needs{};
  /// Tests compile it; false within a range of which they compile other values.
  bool compiled = true;
  bool operator==(const ShaderChoice&) const = default;
};

/// Choices that exclude each other. A macro belongs to one axis of its family.
using ShaderAxis = std::vector<ShaderChoice>;

/// A variant is one choice of each axis, such that what they need holds.
struct ShaderFamily {
  std::string vertexFile, fragmentFile;
  std::vector<ShaderAxis> axes{};
  bool operator==(const ShaderFamily&) const = default;
};

/// HS_NO_HIGHP and HS_DERIVATIVES, as assembleShader() sets them.
std::vector<std::string> contextDefines(const Capabilities& capabilities);
/// Why no variant of `family` has these defines, as a sentence that names the culprit; empty when one has.
std::string refusal(const ShaderFamily& family, const std::vector<std::string>& defines,
                    const std::vector<std::string>& contextDefines);
/// Errors: internal, when the variant is of none of the families.
Status checkVariant(std::span<const ShaderFamily> families, const ProgramVariant& variant,
                    const Capabilities& capabilities);

}  // namespace halfshadow::device
