// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

#include "scenes/gltf_accessors.hpp"
#include "scenes/gltf_animation.hpp"

namespace halfshadow::scenes {
namespace {
std::string nodeName(const tinygltf::Model& model, std::size_t node) {
  const std::string& name = model.nodes[node].name;
  return "node " + std::to_string(node) + (name.empty() ? "" : " '" + name + "'");
}

bool isFinite(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

/// Copies numbers[0 … size) to target when the array is there; false when its length is wrong.
bool copyArray(const std::vector<double>& numbers, std::size_t size, double* target) {
  if (numbers.empty()) return true;
  if (numbers.size() != size) return false;
  std::copy(numbers.begin(), numbers.end(), target);
  return true;
}

Result<LocalTransform> restTransform(const tinygltf::Model& model, std::size_t index) {
  const tinygltf::Node& node = model.nodes[index];
  LocalTransform local;
  local.hasMatrix = !node.matrix.empty();
  if (!copyArray(node.matrix, 16, &local.matrix[0].x) ||
      !copyArray(node.translation, 3, &local.translation.x) ||
      !copyArray(node.rotation, 4, &local.rotation.x) || !copyArray(node.scale, 3, &local.scale.x)) {
    return malformed(nodeName(model, index) +
                     " has a transform of the wrong length; use 16 numbers for a matrix, "
                     "3 for a translation or scale, 4 for a rotation");
  }
  return local;
}

Result<glm::dmat4> parentFromNode(const tinygltf::Model& model, std::size_t index,
                                  const LocalTransform& local) {
  if (local.hasMatrix) return local.matrix;
  const double length = glm::length(local.rotation);
  if (!(length > 0.0) || !std::isfinite(length)) {
    return malformed(nodeName(model, index) + " has a rotation of length zero; give a unit quaternion");
  }
  const glm::dvec4 q = local.rotation / length;
  return glm::scale(
      glm::translate(glm::dmat4(1.0), local.translation) * glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z)),
      local.scale);
}

/// Parents, or an error where a child does not exist, has two parents, or is its own ancestor.
Result<std::vector<int>> parentsOf(const tinygltf::Model& model, std::vector<std::size_t>& parentsFirst) {
  std::vector<int> parent(model.nodes.size(), -1);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const int child : model.nodes[i].children) {
      if (child < 0 || static_cast<std::size_t>(child) >= model.nodes.size()) {
        return malformed(nodeName(model, i) + " has child " + std::to_string(child) +
                         ", which does not exist");
      }
      if (parent[child] != -1) {
        return malformed(nodeName(model, child) + " is the child of two nodes; nodes must form a tree");
      }
      parent[child] = static_cast<int>(i);
    }
  }
  for (std::size_t i = 0; i < parent.size(); ++i) {
    if (parent[i] == -1) parentsFirst.push_back(i);
  }
  for (std::size_t next = 0; next < parentsFirst.size(); ++next) {
    const std::vector<int>& children = model.nodes[parentsFirst[next]].children;
    parentsFirst.insert(parentsFirst.end(), children.begin(), children.end());
  }
  if (parentsFirst.size() != parent.size()) {
    return malformed("the node hierarchy contains a cycle; remove the child that is its own ancestor");
  }
  return parent;
}

/// KHR_node_visibility, without the ancestors'.
char isVisible(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_node_visibility");
  if (found == node.extensions.end() || !found->second.IsObject()) return 1;
  const tinygltf::Value& visible = found->second.Get("visible");
  return !visible.IsBool() || visible.Get<bool>();
}
}  // namespace

Result<Pose> poseOf(const tinygltf::Model& model, const GltfOptions& options,
                    std::vector<std::string>& notes) {
  Pose pose;
  std::vector<std::size_t> parentsFirst;
  Result<std::vector<int>> parent = parentsOf(model, parentsFirst);
  if (!parent) return parent.error();
  pose.parent = std::move(parent).value();

  Movable movable;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Result<LocalTransform> rest = restTransform(model, i);
    if (!rest) return rest.error();
    movable.local.push_back(*rest);
    movable.weights.push_back(model.nodes[i].weights);
    movable.isVisible.push_back(isVisible(model.nodes[i]));
  }
  for (const tinygltf::Mesh& mesh : model.meshes) movable.meshWeights.push_back(mesh.weights);
  const int count = static_cast<int>(model.animations.size());
  const bool isRest = options.animationIndex == -1 || (options.animationIndex == 0 && count == 0);
  if (!isRest && (options.animationIndex < 0 || options.animationIndex >= count)) {
    return Error{ErrorCode::invalidArgument, "animation " + std::to_string(options.animationIndex) +
                                                 " does not exist; the file has " + std::to_string(count)};
  }
  if (!std::isfinite(options.animationTimeSeconds)) {
    return Error{ErrorCode::invalidArgument, "the animation time is NaN or infinite; give seconds"};
  }
  if (!isRest) {
    const Status status = applyAnimation(model, model.animations[options.animationIndex],
                                         options.animationTimeSeconds, movable, notes);
    if (!status) return status.error();
  }
  pose.worldFromNode.resize(model.nodes.size());
  pose.isVisible.resize(model.nodes.size());
  for (const std::size_t i : parentsFirst) {
    const Result<glm::dmat4> own = parentFromNode(model, i, movable.local[i]);
    if (!own) return own.error();
    const int above = pose.parent[i];
    pose.worldFromNode[i] = above < 0 ? *own : pose.worldFromNode[above] * *own;
    if (!isFinite(pose.worldFromNode[i])) {
      return malformed(nodeName(model, i) +
                       " has a transform that is NaN, infinite or overflows; give finite numbers");
    }
    pose.isVisible[i] = movable.isVisible[i] && (above < 0 || pose.isVisible[above]);
  }
  pose.weights = std::move(movable.weights);
  pose.meshWeights = std::move(movable.meshWeights);
  return pose;
}

Result<std::vector<glm::dmat4>> jointMatrices(const tinygltf::Model& model, const Pose& pose, int skinIndex) {
  const std::string what = "skin " + std::to_string(skinIndex);
  if (skinIndex < 0 || static_cast<std::size_t>(skinIndex) >= model.skins.size()) {
    return malformed(what + " does not exist; the file has " + std::to_string(model.skins.size()));
  }
  const tinygltf::Skin& skin = model.skins[skinIndex];
  AccessorValues inverseBind;
  if (skin.inverseBindMatrices >= 0) {
    Result<AccessorValues> read = readAccessor(
        model, skin.inverseBindMatrices, {.name = "inverse bind matrices of " + what, .components = 16});
    if (!read) return read.error();
    if (read->count < skin.joints.size()) {
      return malformed(what + " has " + std::to_string(skin.joints.size()) + " joints but only " +
                       std::to_string(read->count) + " inverse bind matrices");
    }
    inverseBind = std::move(read).value();
  }
  std::vector<glm::dmat4> worldFromBind;
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const int joint = skin.joints[i];
    if (joint < 0 || static_cast<std::size_t>(joint) >= model.nodes.size()) {
      return malformed(what + " names joint " + std::to_string(joint) + ", which does not exist");
    }
    const glm::dmat4 jointFromBind =
        inverseBind.count == 0 ? glm::dmat4(1.0) : glm::make_mat4(inverseBind[i]);
    worldFromBind.push_back(pose.worldFromNode[joint] * jointFromBind);
  }
  if (worldFromBind.empty()) return malformed(what + " has no joints; remove it or give it some");
  return worldFromBind;
}

}  // namespace halfshadow::scenes
