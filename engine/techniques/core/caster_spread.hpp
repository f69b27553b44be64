// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lights whose casters no single map tells apart: some beside the light or around it, others far from it.
#pragma once

#include <optional>

#include "techniques/core/light_scene.hpp"

namespace halfshadow::techniques {

/// `sampled` takes the light when its farthest caster is more than `widestRatio` times as far as the nearest,
/// along the light's axis and as far as the fit reaches; casters across the light's plane always are. Its
/// maps are seen from points of the light and hold one exact depth a texel.
std::optional<StandIn> sampledWhereCastersSpread(const LightScene& scene, double widestRatio);

}  // namespace halfshadow::techniques
