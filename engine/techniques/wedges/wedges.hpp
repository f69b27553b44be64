// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Penumbra wedges, added over all casters or combined as independent occluders.
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeWedges();
std::unique_ptr<Technique> makeWedgesProbabilistic();

}  // namespace halfshadow::techniques
