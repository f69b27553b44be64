// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_instances.hpp"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scenes/gltf_accessors.hpp"

namespace halfshadow::scenes {
namespace {
constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

/// One attribute of all instances; nothing where the node has none of this name.
Result<AccessorValues> attributeOf(const tinygltf::Model& model, const tinygltf::Value& attributes,
                                   const char* name, std::size_t components, const std::string& what) {
  const tinygltf::Value& accessor = attributes.Get(name);
  if (!accessor.IsNumber()) return AccessorValues{.components = components};
  return readAccessor(model, indexIn(accessor),
                      {.name = std::string(name) + " of the instances of " + what, .components = components});
}
}  // namespace

Result<std::vector<glm::dmat4>> instancesOf(const tinygltf::Model& model, const tinygltf::Node& node,
                                            const std::string& what) {
  const auto found = node.extensions.find(kExtension);
  if (found == node.extensions.end()) return std::vector<glm::dmat4>{glm::dmat4(1.0)};
  if (!found->second.IsObject() || !found->second.Get("attributes").IsObject()) {
    return malformed(what + " has " + kExtension + " without attributes; export it again");
  }
  const tinygltf::Value& attributes = found->second.Get("attributes");
  const auto translation = attributeOf(model, attributes, "TRANSLATION", 3, what),
             rotation = attributeOf(model, attributes, "ROTATION", 4, what),
             scale = attributeOf(model, attributes, "SCALE", 3, what);
  std::size_t count = 0;
  for (const auto* attribute : {&translation, &rotation, &scale}) {
    if (!*attribute) return attribute->error();
    if ((*attribute)->count == 0) continue;
    if (count != 0 && (*attribute)->count != count) {
      return malformed("the attributes of the instances of " + what +
                       " differ in their counts; export it again");
    }
    count = (*attribute)->count;
  }
  std::vector<glm::dmat4> instances;
  instances.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    glm::dmat4 nodeFromInstance(1.0);
    if (translation->count > 0) {
      const double* t = (*translation)[i];
      nodeFromInstance = glm::translate(nodeFromInstance, glm::dvec3(t[0], t[1], t[2]));
    }
    if (rotation->count > 0) {
      const double* r = (*rotation)[i];
      const glm::dvec4 q(r[0], r[1], r[2], r[3]);
      if (!(glm::length(q) > 0.0)) {
        return malformed("instance " + std::to_string(i) + " of " + what +
                         " has a rotation of length zero; give a unit quaternion");
      }
      const glm::dvec4 unit = q / glm::length(q);
      nodeFromInstance *= glm::mat4_cast(glm::dquat(unit.w, unit.x, unit.y, unit.z));
    }
    if (scale->count > 0) {
      const double* s = (*scale)[i];
      nodeFromInstance = glm::scale(nodeFromInstance, glm::dvec3(s[0], s[1], s[2]));
    }
    instances.push_back(nodeFromInstance);
  }
  return instances;
}

}  // namespace halfshadow::scenes
