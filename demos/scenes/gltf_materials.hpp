// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// glTF materials as base colours and images (internal).
#pragma once

#include <string>
#include <vector>

#include "scene/scene_description.hpp"
#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

/// One per material of the file. Images that cannot be used leave a note and a plain colour.
std::vector<scene::Material> materialsOf(tinygltf::Model& model, std::vector<std::string>& notes);

}  // namespace halfshadow::scenes
