// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Words in which techniques and parts declare the variants of their shaders. No GL.
#pragma once

#include "device/shader_family.hpp"
#include "techniques/core/settings.hpp"

namespace halfshadow::techniques {
using device::ShaderAxis;
using device::ShaderFamily;

/// Set or not; set only where `needs` holds, see ShaderChoice.
ShaderAxis flag(std::string macro, std::vector<std::string> needs = {});
/// One of these.
ShaderAxis values(const std::string& macro, std::initializer_list<int> numbers);
/// Any whole number of the range; tests compile the named ones.
ShaderAxis range(const std::string& macro, int lowest, int highest, std::initializer_list<int> compiled);
/// Whatever the setting may be.
ShaderAxis range(const std::string& macro, const SettingInfo& setting, std::initializer_list<int> compiled);

ShaderFamily fullscreen(std::string fragmentFile, std::vector<ShaderAxis> axes = {});

/// Of programs that draw meshes: whether alpha cuts holes, with or without colours of vertices.
ShaderAxis alphaAxis();

/// HS_CASTING_RECEIVER, see ReceiverShading::selfReceivers.
ShaderAxis castingAxis(std::vector<std::string> needs = {});

/// What the surface of a receiver and the lights select of its programs, see ReceiverKind. compiled: by
/// tests.
std::vector<ShaderAxis> surfaceAxes(bool compiled);

/// As in the ReceiverShading.
struct ReceiverTraits {
  bool usesFacetPlane = false;
  bool twoDraws = false;  ///< with FilterSkip::stencil
  bool forward = true;
  bool filterTrustsClasses = false;
};
/// The variants of a visibility function: `axes` of its own, and those that all have: output, facet plane,
/// draw of two, and host's own main().
std::vector<ShaderFamily> receiverFamilies(const std::string& fragmentFile, const ReceiverTraits& traits,
                                           std::vector<ShaderAxis> axes = {});

std::vector<ShaderFamily> joined(std::initializer_list<std::vector<ShaderFamily>> lists);

}  // namespace halfshadow::techniques
