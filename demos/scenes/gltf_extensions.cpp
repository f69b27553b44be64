// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_extensions.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "scenes/gltf_decode.hpp"

namespace halfshadow::scenes {
namespace {
/// What is read and honoured here.
constexpr std::array<std::string_view, 12> kHonoured = {
    "KHR_lights_punctual",     "KHR_mesh_quantization",
    "KHR_texture_transform",   "KHR_draco_mesh_compression",
    "EXT_meshopt_compression", "KHR_meshopt_compression",
    "EXT_mesh_gpu_instancing", "KHR_node_visibility",
    "KHR_animation_pointer",   "EXT_texture_webp",
    "KHR_texture_basisu",  // named where an image is missing
    "MSFT_texture_dds"};

/// Colours, surfaces, names and behaviour: nothing that places or cuts geometry, or a light that casts.
constexpr std::array<std::string_view, 27> kHarmlessBeginnings = {"KHR_materials_",
                                                                  "KHR_xmp",
                                                                  "KHR_audio",
                                                                  "KHR_interactivity",
                                                                  "KHR_node_selectability",
                                                                  "KHR_node_hover",
                                                                  "KHR_physics_",
                                                                  "KHR_collision_",
                                                                  "KHR_environment_",
                                                                  "KHR_techniques_webgl",
                                                                  "EXT_lights_i",
                                                                  "EXT_mesh_feature",
                                                                  "EXT_instance_fea",
                                                                  "EXT_structural_",
                                                                  "EXT_feature_meta",
                                                                  "EXT_texture_avif",
                                                                  "EXT_texture_astc",
                                                                  "ADOBE_materials_",
                                                                  "MSFT_packing_",
                                                                  "MSFT_physics",
                                                                  "MSFT_audio",
                                                                  "VRM",
                                                                  "OMI_",
                                                                  "MOZ_",
                                                                  "HUBS_",
                                                                  "FB_",
                                                                  "CESIUM_"};

struct Meaning {
  std::string_view name;
  const char* where;     ///< the array whose elements use it
  const char* sentence;  ///< what follows from it
};
/// Known, and not honoured where they change shadows.
constexpr std::array<Meaning, 6> kUnhonoured = {{
    {"KHR_materials_transmission", "materials", "lets light through, but casts as if it were opaque"},
    {"KHR_materials_diffuse_transmission", "materials", "lets light through, but casts as if it were opaque"},
    {"KHR_materials_displacement", "materials", "moves its surface, but is taken as it is without"},
    {"MSFT_lod", "nodes", "has levels of detail, of which the finest is taken"},
    {"KHR_gaussian_splatting", "meshes", "consists of splats, which cast no shadow here"},
    {"EXT_mesh_primitive_restart", "meshes", "restarts its strips, which is not honoured"},
}};

bool isHonoured(std::string_view name) {
  return std::ranges::find(kHonoured, name) != kHonoured.end();
}
bool isHarmless(std::string_view name) {
  return std::ranges::any_of(kHarmlessBeginnings,
                             [&](std::string_view beginning) { return name.starts_with(beginning); });
}
bool isNamedApart(std::string_view name) {
  return std::ranges::find(kUnhonoured, name, &Meaning::name) != kUnhonoured.end();
}

/// 'first', 'second', 'third' and 4 more
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

std::string nameOf(const Json& element, std::size_t index, std::string_view array) {
  const Json* name = memberOf(element, "name");
  if (name != nullptr && name->is_string() && !name->get_ref<const std::string&>().empty())
    return "'" + name->get_ref<const std::string&>().substr(0, 60) + "'";
  std::string singular(array.substr(0, array.size() - (array == "meshes" ? 2 : 1)));
  return singular + " " + std::to_string(index);
}

bool usesIt(Json& element, const Meaning& meaning) {
  if (extensionOf(element, std::string(meaning.name).c_str()) != nullptr) return true;
  return std::ranges::any_of(elementsOf(element, "primitives"), [&](const Json* primitive) {
    return extensionOf(*primitive, std::string(meaning.name).c_str()) != nullptr;
  });
}
}  // namespace

Status checkRequiredExtensions(const Json& json) {
  for (const std::string& name : textsIn(json, "extensionsRequired")) {
    if (std::string missing = missingDecoder(name); !missing.empty()) return malformed(std::move(missing));
    if (isHonoured(name) || isHarmless(name) || isNamedApart(name)) continue;
    return malformed("it requires the extension '" + name +
                     "', which is not known here: without it the file would be drawn wrong; export it "
                     "without that extension");
  }
  return {};
}

std::vector<std::string> unhonouredExtensions(Json& json) {
  std::vector<std::string> sentences;
  for (const Meaning& meaning : kUnhonoured) {
    std::vector<std::string> names;
    const std::vector<Json*> elements = elementsOf(json, meaning.where);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (usesIt(*elements[i], meaning)) names.push_back(nameOf(*elements[i], i, meaning.where));
    }
    if (!names.empty()) {
      sentences.push_back(listed(names) + " (" + std::string(meaning.name) + ") " + meaning.sentence);
    }
  }
  for (const std::string& name : textsIn(json, "extensionsUsed")) {
    if (isHonoured(name) || isHarmless(name) || isNamedApart(name)) continue;
    sentences.push_back("the file uses the extension '" + name +
                        "', which is not known here: what it adds or moves is missing");
  }
  return sentences;
}

}  // namespace halfshadow::scenes
