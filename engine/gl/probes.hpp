// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Renders and reads back to learn what the driver really does. Internal to Context::create.
#pragma once

#include "gl/context.hpp"

namespace halfshadow::gl {

/// Fills `states`, `probes` and `quirks` of `capabilities`, whose driver, limits and extensions are known.
/// `forcedOff` become device::ProbeOutcome::forcedOff; with highp among them the varying is measured at
/// mediump, as programs will use it. Leaves no object and no GL error behind; the caller guards the host's
/// state.
void probeCapabilities(Context& context, device::Capabilities& capabilities,
                       const std::vector<device::Capability>& forcedOff);

}  // namespace halfshadow::gl
