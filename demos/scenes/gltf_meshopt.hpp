// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// EXT_meshopt_compression: buffer views of encoded vertices or indices (internal).
#pragma once

#include <tiny_gltf.h>

#include <string_view>

#include "scenes/gltf_json.hpp"

namespace halfshadow::scenes {

#ifdef HALFSHADOW_HAS_MESHOPT
inline constexpr bool kHasMeshopt = true;
#else
inline constexpr bool kHasMeshopt = false;
#endif

bool isMeshoptExtension(std::string_view name);
/// The extension's object on a buffer or buffer view, or null.
const Json* meshoptOf(const Json& element);
/// Puts what is decoded into buffers of its own. A build without decoder leaves buffer views to their
/// uncompressed fallback. Errors: fileMalformed.
Status decodeMeshopt(Json& json, tinygltf::Model& model);

}  // namespace halfshadow::scenes
