// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Images of the report as data URIs.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/error.hpp"

namespace halfshadow::report {

/// |error| from which on an error map shows its full colour.
inline constexpr float kErrorMapLimit = 0.3f;

/// "data:image/png;base64,…" of 8-bit pixels. Errors: invalidArgument.
Result<std::string> pngUri(int width, int height, int channels, std::span<const std::uint8_t> pixels);

/// Visibility as grey, 0 black … 1 white; pixels that are no receivers are a flat tone. Errors:
/// invalidArgument (a length is not width · height).
Result<std::string> visibilityUri(int width, int height, std::span<const float> visibility,
                                  std::span<const std::uint8_t> receiver);

/// measured - truth: blue where too dark, red where too light, near white where right.
Result<std::string> errorMapUri(int width, int height, std::span<const float> measured,
                                std::span<const float> truth, std::span<const std::uint8_t> receiver);

/// CSS gradient of the same colours, from -kErrorMapLimit to +kErrorMapLimit.
std::string errorMapGradient();

}  // namespace halfshadow::report
