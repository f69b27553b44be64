// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of the shaders of maps.
#pragma once

#include "techniques/core/shader_families.hpp"

namespace halfshadow::techniques {

/// Of every shader that reads the map; see depthDefines().
ShaderAxis depthAxis();
/// Of what the passes of this folder draw.
std::vector<ShaderFamily> mapShaders();
/// Of those passes, and of a visibility function that samples the map.
/// HS_SUB_LIGHTS_U and HS_SUB_LIGHTS_V of readers of planLightDepths().
ShaderAxis subLightAxis();

std::vector<ShaderFamily> mapReceiverFamilies(const std::string& fragmentFile, std::vector<ShaderAxis> axes,
                                              ReceiverTraits traits = {});

}  // namespace halfshadow::techniques
