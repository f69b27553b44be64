// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Poisson-disc tap patterns.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace halfshadow::techniques {

/// `count` points of the unit disc, as far apart as a best-candidate search finds, deterministic.
/// Based on: Mitchell, "Spectrally Optimal Sampling for Distribution Ray Tracing", 1991, section 4.
std::vector<glm::vec2> poissonDisc(int count);

/// The macro that unrolls the taps in a shader: "HS_POISSON_TAPS(TAP) TAP(x, y) …". Found once for each
/// count.
const std::string& poissonTapsDefine(int count);

}  // namespace halfshadow::techniques
