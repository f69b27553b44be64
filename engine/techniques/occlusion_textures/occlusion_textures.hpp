// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Occlusion textures (Eisemann and Décoret 2006).
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeOcclusionTextures();

}  // namespace halfshadow::techniques
