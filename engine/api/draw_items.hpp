// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What techniques see of the engine's objects.
#pragma once

#include "api/engine_state.hpp"

namespace halfshadow::api {

techniques::DrawItem drawItem(const EngineObject& object);

/// The object as a receiver; `castsForSome`: it is among the casters of some light. One that casts nothing
/// is cut to what the camera sees where its triangles are too wide for the rasteriser; casters keep their
/// vertices, which their shadow volumes share. Errors: outOfMemory.
Result<techniques::DrawItem> receiverItem(gl::Context& context, const EngineObject& object, bool castsForSome,
                                          const techniques::View& view, const scene::Camera& camera);

}  // namespace halfshadow::api
