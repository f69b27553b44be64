// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// KHR_lights_punctual as rectangles (internal).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_description.hpp"
#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

/// A light before the bounds are known, which it may be placed by.
struct PendingLight {
  std::string what;  ///< for messages, "light at node 3 'lamp'"
  glm::dmat4 worldFromNode{1.0};
  const tinygltf::Light* source = nullptr;
  std::optional<glm::dvec2> size;  ///< of extras.halfshadow; degrees across of directional lights
};

/// The light of a node that has one, or nothing. `what` names the node. Errors: fileMalformed.
Result<std::optional<PendingLight>> lightOf(const tinygltf::Model& model, const tinygltf::Node& node,
                                            const glm::dmat4& worldFromNode, const std::string& what);

/// Adds the lights to a scene that has its objects. Errors: fileMalformed.
Status addLights(const std::vector<PendingLight>& lights, scene::SceneDescription& scene);

/// extras.halfshadow, or null.
const tinygltf::Value* ownExtras(const tinygltf::Value& extras);

}  // namespace halfshadow::scenes
