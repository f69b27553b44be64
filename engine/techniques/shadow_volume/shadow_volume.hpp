// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The technique "shadow-volume".
#pragma once

#include <memory>

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

/// Hard shadows of the light's centre, exact to the pixel: volumes counted on the screen for all lights in
/// one pass, one channel a light. Based on: Everitt, Kilgard, "Practical and Robust Stenciled Shadow Volumes
/// for Hardware-Accelerated Rendering", 2002; Aldridge, Woods, "Robust, Geometry-Independent Shadow Volumes",
/// 2004 (multiplicity of edges).
std::unique_ptr<Technique> makeShadowVolume();

}  // namespace halfshadow::techniques
