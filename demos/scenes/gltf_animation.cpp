// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_animation.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "scenes/gltf_accessors.hpp"

namespace halfshadow::scenes {
namespace {
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

/// What a channel sets.
struct ChannelTarget {
  enum class What {
    nothing,
    translation,
    rotation,
    scale,
    weights,
    meshWeights,
    visible
  } what = What::nothing;
  std::size_t index = 0;  ///< of the node or mesh
};
using What = ChannelTarget::What;

What whatOf(std::string_view path) {
  if (path == "translation") return What::translation;
  if (path == "rotation") return What::rotation;
  if (path == "scale") return What::scale;
  return path == "weights" ? What::weights : What::nothing;
}

/// "/nodes/3/translation" and the like; What::nothing of other pointers.
ChannelTarget pointedAt(std::string_view pointer) {
  const auto indexBehind = [&](std::string_view array, std::size_t& index) {
    if (!pointer.starts_with(array)) return false;
    const char* first = pointer.data() + array.size();
    const auto [end, error] = std::from_chars(first, pointer.data() + pointer.size(), index);
    if (error != std::errc() || end == pointer.data() + pointer.size() || *end != '/') return false;
    pointer.remove_prefix(static_cast<std::size_t>(end - pointer.data()) + 1);
    return true;
  };
  ChannelTarget target;
  if (indexBehind("/nodes/", target.index)) {
    target.what = pointer == "extensions/KHR_node_visibility/visible" ? What::visible : whatOf(pointer);
  } else if (indexBehind("/meshes/", target.index) && pointer == "weights") {
    target.what = What::meshWeights;
  }
  return target;
}

/// Of a channel under KHR_animation_pointer; empty when there is none.
std::string pointerOf(const tinygltf::AnimationChannel& channel) {
  const auto found = channel.target_extensions.find("KHR_animation_pointer");
  if (found == channel.target_extensions.end() || !found->second.IsObject()) return {};
  const tinygltf::Value& pointer = found->second.Get("pointer");
  return pointer.IsString() ? pointer.Get<std::string>() : std::string();
}

/// The channel's numbers at an instant.
Result<std::vector<double>> valueOf(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                                    What target, double seconds, const std::string& what) {
  const std::string& mode = sampler.interpolation;
  if (mode != "STEP" && mode != "LINEAR" && mode != "CUBICSPLINE") {
    return malformed(what + " has the unknown interpolation '" + mode.substr(0, 40) + "'");
  }
  const Result<AccessorValues> times = readAccessor(model, sampler.input, {.name = "key times of " + what});
  if (!times) return times.error();
  if (times->count == 0 || !std::is_sorted(times->numbers.begin(), times->numbers.end())) {
    return malformed("the key times of " + what + " are missing or do not increase");
  }
  const bool isRotation = target == What::rotation;
  const bool isList = target == What::weights || target == What::meshWeights;
  const std::size_t components = isRotation ? 4 : isList || target == What::visible ? 1 : 3;
  const Result<AccessorValues> output =
      readAccessor(model, sampler.output, {.name = "values of " + what, .components = components});
  if (!output) return output.error();
  const std::size_t keyed = times->count * (mode == "CUBICSPLINE" ? 3 : 1);
  const bool countsMatch = isList ? output->count % keyed == 0 && output->count > 0 : output->count == keyed;
  if (!countsMatch) {
    return malformed(what + " has " + std::to_string(output->count) + " values for " +
                     std::to_string(times->count) + " key times; export it again");
  }
  const std::size_t width = isList ? output->count / keyed : components;
  return interpolated(mode, *output, width, placeAmong(*times, seconds), isRotation);
}

std::string nodeNamed(const tinygltf::Model& model, std::size_t node) {
  const std::string& name = model.nodes[node].name;
  return "node " + std::to_string(node) + (name.empty() ? "" : " '" + name + "'");
}

Status applyChannel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                    std::size_t channelIndex, double seconds, Movable& movable,
                    std::vector<std::string>& notes) {
  const tinygltf::AnimationChannel& channel = animation.channels[channelIndex];
  const std::string what = "channel " + std::to_string(channelIndex) + " of the animation";
  const bool isPointer = channel.target_path == "pointer";
  const std::string pointer = isPointer ? pointerOf(channel) : channel.target_path;
  if (!isPointer && channel.target_node == -1) return {};
  if (!isPointer &&
      (channel.target_node < 0 || static_cast<std::size_t>(channel.target_node) >= model.nodes.size())) {
    return malformed(what + " moves node " + std::to_string(channel.target_node) + ", which does not exist");
  }
  if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size()) {
    return malformed(what + " uses sampler " + std::to_string(channel.sampler) + ", which does not exist");
  }
  const ChannelTarget target =
      isPointer ? pointedAt(pointer)
                : ChannelTarget{whatOf(pointer), static_cast<std::size_t>(channel.target_node)};
  if (target.what == What::nothing) {
    notes.push_back(what + " moves '" + pointer.substr(0, 80) + "', which is not supported and was skipped");
    return {};
  }
  const std::size_t there = target.what == What::meshWeights ? model.meshes.size() : model.nodes.size();
  if (target.index >= there)
    return malformed(what + " moves '" + pointer.substr(0, 80) + "', which does not exist");
  const Result<std::vector<double>> value =
      valueOf(model, animation.samplers[channel.sampler], target.what, seconds, what);
  if (!value) return value.error();
  if (target.what == What::weights) {
    movable.weights[target.index] = *value;
  } else if (target.what == What::meshWeights) {
    movable.meshWeights[target.index] = *value;
  } else if (target.what == What::visible) {
    movable.isVisible[target.index] = value->front() != 0.0;
  } else if (LocalTransform& local = movable.local[target.index]; local.hasMatrix) {
    notes.push_back(what + " moves " + nodeNamed(model, target.index) +
                    ", which has a matrix, and was skipped");
  } else if (target.what == What::rotation) {
    local.rotation = glm::make_vec4(value->data());
  } else {
    (target.what == What::scale ? local.scale : local.translation) = glm::make_vec3(value->data());
  }
  return {};
}
}  // namespace

Status applyAnimation(const tinygltf::Model& model, const tinygltf::Animation& animation, double seconds,
                      Movable& movable, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < animation.channels.size(); ++i) {
    if (Status status = applyChannel(model, animation, i, seconds, movable, notes); !status) return status;
  }
  return {};
}

}  // namespace halfshadow::scenes
