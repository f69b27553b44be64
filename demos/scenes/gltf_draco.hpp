// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// KHR_draco_mesh_compression: primitives whose triangles and attributes are one encoded mesh (internal).
#pragma once

#include <tiny_gltf.h>

#include "scenes/gltf_json.hpp"

namespace halfshadow::scenes {

#ifdef HALFSHADOW_HAS_DRACO
inline constexpr bool kHasDraco = true;
#else
inline constexpr bool kHasDraco = false;
#endif

/// Gives the accessors of each such primitive buffers of their own. A build without decoder leaves primitives
/// to their uncompressed fallback. Errors: fileMalformed.
Status decodeDraco(Json& json, tinygltf::Model& model);

}  // namespace halfshadow::scenes
