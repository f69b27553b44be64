// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The node tree of a glTF file at one instant (internal).
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scenes/gltf_file.hpp"
#include "scenes/gltf_loader.hpp"

namespace halfshadow::scenes {

struct Pose {
  std::vector<glm::dmat4> worldFromNode;         ///< finite
  std::vector<std::vector<double>> weights;      ///< of morph targets, per node; empty = the mesh's own
  std::vector<std::vector<double>> meshWeights;  ///< per mesh: its own, or what an animation sets
  std::vector<char> isVisible;                   ///< per node: neither it nor an ancestor is hidden
  std::vector<int> parent;                       ///< per node, -1 = root
};

/// Checks that the nodes form trees, samples the animation and multiplies the transforms out.
Result<Pose> poseOf(const tinygltf::Model& model, const GltfOptions& options,
                    std::vector<std::string>& notes);

/// worldFromJoint · inverse bind matrix for each joint of a skin.
Result<std::vector<glm::dmat4>> jointMatrices(const tinygltf::Model& model, const Pose& pose, int skinIndex);

}  // namespace halfshadow::scenes
