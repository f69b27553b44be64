// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a host asked of a frame, checked and in the engine's own words.
#pragma once

#include "base/error.hpp"
#include "device/capabilities.hpp"
#include "halfshadow/types.hpp"
#include "scene/camera.hpp"
#include "techniques/core/receiver_shading.hpp"

namespace halfshadow::api {

scene::Camera toCamera(const CameraDesc& desc);
/// Errors: invalidArgument.
Status checkTarget(const TargetDesc& target, const device::Limits& limits);
/// What the pass that evaluates visibility writes: with several lights, shading reads it from the screen.
techniques::ReceiverOutput receiverOutput(const RenderDesc& desc, std::size_t lightCount);
/// Asks for the same picture, in the same place; timing apart.
bool sameFrame(const RenderDesc& a, const RenderDesc& b);

}  // namespace halfshadow::api
