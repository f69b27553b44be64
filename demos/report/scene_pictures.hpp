// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a report shows of a scene besides measurements.
#pragma once

#include <string>

#include "measure/measurement.hpp"

namespace halfshadow::report {

/// "20 objects, 1,234 triangles; light 2 × 2, 12 from the scene's middle."
std::string describeScene(const scene::SceneDescription& scene);

/// The lit image under one technique, on a renewed engine. Errors: those of EngineSession.
Result<measure::RgbaImage> renderShaded(measure::EngineSession& session, const scene::SceneDescription& scene,
                                        const measure::Configuration& configuration, int width, int height);

}  // namespace halfshadow::report
