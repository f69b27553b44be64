// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What is made of the extensions that a glTF file uses (internal).
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf_json.hpp"

namespace halfshadow::scenes {

/// Fails where the file requires an extension without which it would be drawn wrong: one sentence that names
/// it and says what to do. Asked before anything else of the file is read.
Status checkRequiredExtensions(const Json& json);

/// One sentence for each extension that the file uses and that may change its shadows without being honoured,
/// with the names of what uses it.
std::vector<std::string> unhonouredExtensions(Json& json);

}  // namespace halfshadow::scenes
