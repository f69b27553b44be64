// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How far behind the casters receivers reach.
#pragma once

#include "planner/light_fit.hpp"
#include "scene/bounds.hpp"

namespace halfshadow::api {

/// Largest z in light space of the part of the box that lies inside the fitted view; 0 when none does. With
/// it the widest penumbra of a frame is known before anything is drawn.
double receiverFarDistance(const planner::LightFit& fit, const scene::Bounds& receiverWorld);

}  // namespace halfshadow::api
