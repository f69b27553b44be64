// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The files with which anyone can check a measurement.
#pragma once

#include <filesystem>
#include <vector>

#include "measure/measurement.hpp"

namespace halfshadow::measure {

/// Makes the folder when it is missing and proves that files can be made in it. Errors: fileNotWritable.
Status prepareDumpFolder(const std::filesystem::path& folder);

/// Writes, each file atomically:
///  - geometry.obj: world-space triangles of all casters (`v`, `f`); receivers.obj: of the objects that cast
///    nothing, which must not occlude;
///  - light.json: center, half-extent vectors u and v, origin_lift (world units by which rays started above
///    casters' facets, as asked for; 0 otherwise);
///  - position.exr: RGBA, world position, A = 1 on receiver pixels; normal.exr: RGB;
///  - reference.exr and <technique>.exr: channel "V".
Status dumpMeasurement(const std::filesystem::path& folder, const scene::SceneDescription& scene,
                       const Truth& truth, const std::vector<TechniqueMeasurement>& techniques);

}  // namespace halfshadow::measure
