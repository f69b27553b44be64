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

namespace halfshadow::scenes {
namespace {
struct LocalTransform {
  glm::dvec3 translation{0.0};
  glm::dvec4 rotation{0, 0, 0, 1};  ///< x, y, z, w as in the file
  glm::dvec3 scale{1.0};
  glm::dmat4 matrix{1.0};
  bool hasMatrix = false;
};

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
  if (local.hasMatrix && !(std::abs(glm::determinant(glm::dmat3(local.matrix))) > 0.0)) {
    return malformed(nodeName(model, index) + " has a singular matrix; give it three independent axes");
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

/// Where a time lies among key times: keys `before` and `before` + 1, `share` of the way from the first.
struct KeyPlace {
  std::size_t before = 0;
  double share = 0.0;
  double spanSeconds = 0.0;
};

KeyPlace placeAmong(const AccessorValues& times, double seconds) {
  const std::vector<double>& keys = times.numbers;
  if (seconds <= keys.front()) return {};
  if (seconds >= keys.back()) return {.before = keys.size() - 1};
  const auto after =
      static_cast<std::size_t>(std::upper_bound(keys.begin(), keys.end(), seconds) - keys.begin());
  const double span = keys[after] - keys[after - 1];
  return {.before = after - 1, .share = (seconds - keys[after - 1]) / span, .spanSeconds = span};
}

glm::dvec4 slerp(const glm::dvec4& a, glm::dvec4 b, double share) {
  double cosine = glm::dot(a, b);
  if (cosine < 0.0) b = -b, cosine = -cosine;
  if (cosine > 0.9995) return glm::mix(a, b, share);  // sines of tiny angles lose their digits
  const double angle = std::acos(cosine);
  return (a * std::sin((1 - share) * angle) + b * std::sin(share * angle)) / std::sin(angle);
}

/// `width` numbers at an instant. Based on: glTF 2.0 specification, appendix C (interpolation).
std::vector<double> interpolated(const std::string& mode, const AccessorValues& output, std::size_t width,
                                 const KeyPlace& place, bool isRotation) {
  const bool isCubic = mode == "CUBICSPLINE";
  const auto at = [&](std::size_t key, std::size_t part) {  // part: 0 in-tangent, 1 value, 2 out-tangent
    return output.numbers.data() + (isCubic ? (key * 3 + part) * width : key * width);
  };
  const double* first = at(place.before, 1);
  std::vector<double> result(first, first + width);
  if (place.share <= 0.0 || mode == "STEP") return result;
  const double* second = at(place.before + 1, 1);
  const double t = place.share;
  if (isRotation && !isCubic) {
    const glm::dvec4 q = slerp(glm::make_vec4(first), glm::make_vec4(second), t);
    return {q.x, q.y, q.z, q.w};
  }
  const double* leaving = at(place.before, 2);
  const double* arriving = at(place.before + 1, 0);
  for (std::size_t i = 0; i < width; ++i) {
    if (!isCubic) {
      result[i] = first[i] + (second[i] - first[i]) * t;
      continue;
    }
    const double t2 = t * t, t3 = t2 * t;
    result[i] = (2 * t3 - 3 * t2 + 1) * first[i] + (t3 - 2 * t2 + t) * place.spanSeconds * leaving[i] +
                (3 * t2 - 2 * t3) * second[i] + (t3 - t2) * place.spanSeconds * arriving[i];
  }
  return result;
}

struct Sampled {
  std::vector<LocalTransform>& local;
  std::vector<std::vector<double>>& weights;
};

Status applyChannel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                    std::size_t channelIndex, double seconds, Sampled target,
                    std::vector<std::string>& notes) {
  const tinygltf::AnimationChannel& channel = animation.channels[channelIndex];
  const std::string what = "channel " + std::to_string(channelIndex) + " of the animation";
  if (channel.target_node == -1) return {};
  if (channel.target_node < 0 || static_cast<std::size_t>(channel.target_node) >= model.nodes.size()) {
    return malformed(what + " moves node " + std::to_string(channel.target_node) + ", which does not exist");
  }
  if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size()) {
    return malformed(what + " uses sampler " + std::to_string(channel.sampler) + ", which does not exist");
  }
  const tinygltf::AnimationSampler& sampler = animation.samplers[channel.sampler];
  const std::string& path = channel.target_path;
  const bool isRotation = path == "rotation", isWeights = path == "weights";
  if (!isRotation && !isWeights && path != "translation" && path != "scale") {
    notes.push_back(what + " moves '" + path.substr(0, 40) + "', which is not supported and was skipped");
    return {};
  }
  const std::string& mode = sampler.interpolation;
  if (mode != "STEP" && mode != "LINEAR" && mode != "CUBICSPLINE") {
    return malformed(what + " has the unknown interpolation '" + mode.substr(0, 40) + "'");
  }
  const Result<AccessorValues> times = readAccessor(model, sampler.input, {.name = "key times of " + what});
  if (!times) return times.error();
  if (times->count == 0 || !std::is_sorted(times->numbers.begin(), times->numbers.end())) {
    return malformed("the key times of " + what + " are missing or do not increase");
  }
  const std::size_t components = isWeights ? 1 : isRotation ? 4 : 3;
  const Result<AccessorValues> output =
      readAccessor(model, sampler.output, {.name = "values of " + what, .components = components});
  if (!output) return output.error();
  const std::size_t perKey = mode == "CUBICSPLINE" ? 3 : 1;
  const std::size_t keyed = times->count * perKey;
  const bool countsMatch =
      isWeights ? output->count % keyed == 0 && output->count > 0 : output->count == keyed;
  if (!countsMatch) {
    return malformed(what + " has " + std::to_string(output->count) + " values for " +
                     std::to_string(times->count) + " key times; export it again");
  }
  const std::size_t width = isWeights ? output->count / keyed : components;
  const std::vector<double> value =
      interpolated(mode, *output, width, placeAmong(*times, seconds), isRotation);
  LocalTransform& local = target.local[channel.target_node];
  if (isWeights) {
    target.weights[channel.target_node] = value;
  } else if (local.hasMatrix) {
    notes.push_back(what + " moves " + nodeName(model, channel.target_node) +
                    ", which has a matrix, and was skipped");
  } else if (isRotation) {
    local.rotation = glm::make_vec4(value.data());
  } else {
    (path == "scale" ? local.scale : local.translation) = glm::make_vec3(value.data());
  }
  return {};
}
}  // namespace

Result<Pose> poseOf(const tinygltf::Model& model, const GltfOptions& options,
                    std::vector<std::string>& notes) {
  Pose pose;
  std::vector<std::size_t> parentsFirst;
  Result<std::vector<int>> parent = parentsOf(model, parentsFirst);
  if (!parent) return parent.error();
  pose.parent = std::move(parent).value();

  std::vector<LocalTransform> local;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Result<LocalTransform> rest = restTransform(model, i);
    if (!rest) return rest.error();
    local.push_back(*rest);
    pose.weights.push_back(model.nodes[i].weights);
  }
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
    const tinygltf::Animation& animation = model.animations[options.animationIndex];
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
      const Status status =
          applyChannel(model, animation, i, options.animationTimeSeconds, {local, pose.weights}, notes);
      if (!status) return status.error();
    }
  }
  pose.worldFromNode.resize(model.nodes.size());
  pose.isScaledToNothing.resize(model.nodes.size());
  for (const std::size_t i : parentsFirst) {
    const Result<glm::dmat4> own = parentFromNode(model, i, local[i]);
    if (!own) return own.error();
    const int above = pose.parent[i];
    pose.worldFromNode[i] = above < 0 ? *own : pose.worldFromNode[above] * *own;
    if (!isFinite(pose.worldFromNode[i])) {
      return malformed(nodeName(model, i) +
                       " has a transform that is NaN, infinite or overflows; give finite numbers");
    }
    const glm::dvec3& s = local[i].scale;
    pose.isScaledToNothing[i] = s.x * s.y * s.z == 0.0 || (above >= 0 && pose.isScaledToNothing[above]);
  }
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
