// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Percentage closer filtering with a fixed kernel, grid or Poisson disc (Reeves et al. 1987; Evans
/// 2014, 3.2).
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makePcf();
/// The same image from fewer taps: a mask keeps the filter to where it can matter (Evans 2014, 4.3).
std::unique_ptr<Technique> makePcfMasked();

}  // namespace halfshadow::techniques
