// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#pragma once

#include "outlines/tile_lists.hpp"

namespace halfshadow::outlines {

/// Whether every two casters of the list are separated along an axis of the light for all receivers of the
/// box. E before F along x is (tE - tP)(iF - iP) < (tF - tP)(iE - iP), which is linear in P, since the terms
/// in tP·iP cancel: what holds at the corners holds inside.
bool castersApart(std::span<const ListRecord> list, const TangentBox& receivers);

}  // namespace halfshadow::outlines
