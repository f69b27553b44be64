// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variable penumbrae by quantised mask bands (Evans 2014, 4.4).
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makePcfQuantized();

}  // namespace halfshadow::techniques
