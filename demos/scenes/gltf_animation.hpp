// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What an animation of a glTF file sets at one instant (internal).
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

struct LocalTransform {
  glm::dvec3 translation{0.0};
  glm::dvec4 rotation{0, 0, 0, 1};  ///< x, y, z, w as in the file
  glm::dvec3 scale{1.0};
  glm::dmat4 matrix{1.0};
  bool hasMatrix = false;
};

/// What moves, by node, and morph weights of meshes.
struct Movable {
  std::vector<LocalTransform> local;
  std::vector<std::vector<double>> weights;      ///< per node; empty = the mesh's
  std::vector<std::vector<double>> meshWeights;  ///< per mesh
  std::vector<char> isVisible;                   ///< per node, without its ancestors
};

/// Sets what the animation's channels say at `seconds`, clamped to each channel's key times; targets of
/// KHR_animation_pointer as far as they move, show or hide geometry. What is not followed leaves a note.
/// Errors: fileMalformed.
Status applyAnimation(const tinygltf::Model& model, const tinygltf::Animation& animation, double seconds,
                      Movable& movable, std::vector<std::string>& notes);

}  // namespace halfshadow::scenes
