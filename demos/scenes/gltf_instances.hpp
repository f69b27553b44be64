// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// EXT_mesh_gpu_instancing: one node that shows its mesh many times (internal).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

/// Transforms from each instance to its node; the identity alone for a node without the extension.
/// Errors: fileMalformed (`what` names the node).
Result<std::vector<glm::dmat4>> instancesOf(const tinygltf::Model& model, const tinygltf::Node& node,
                                            const std::string& what);

}  // namespace halfshadow::scenes
