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
/// Enums and numbers. Errors: invalidArgument.
Status checkFrameDesc(const RenderDesc& desc);
/// Errors: invalidArgument.
Status checkTarget(const TargetDesc& target, const device::Limits& limits);
/// Whether shading reads visibilities from the screen: of several lights, or of one where a program that does
/// both is too large.
enum class Shading { together, apart };
/// What the pass that evaluates visibility writes.
techniques::ReceiverOutput receiverOutput(const RenderDesc& desc, Shading shading);
/// Lights whose visibility that pass evaluates: an image of one value a pixel shows the first alone.
std::size_t drawnLights(const RenderDesc& desc, Shading shading, std::size_t lightCount);
/// How the receivers of one of so many lights reach the pass's target.
techniques::ReceiverTarget receiverTarget(std::size_t light, std::size_t drawn);
/// Asks for the same picture, in the same place; timing apart.
bool sameFrame(const RenderDesc& a, const RenderDesc& b);

}  // namespace halfshadow::api
