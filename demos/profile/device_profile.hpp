// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Choices that depend on the device, measured on it.
#pragma once

#include "measure/measurement_json.hpp"
#include "profile/interleaved.hpp"

namespace halfshadow::profile {

/// Which way of skipping the filter is fastest here, for a small and a large kernel of pcf-masked, and which
/// prefilter of occlusion textures: {"driver": {…}, "settings": [{"key", "value", "reason"}], "choices":
/// [{"setting", "value", "ms": {one time for each value}, "reason", …}]}. Errors: those of interleavedTimes.
Result<measure::Json> deviceProfile(measure::EngineSession& session, const scene::SceneDescription& scene,
                                    const InterleavedOptions& options);

}  // namespace halfshadow::profile
