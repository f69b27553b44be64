// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_materials.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/gltf_accessors.hpp"

namespace halfshadow::scenes {
namespace {
/// Of alphaMode BLEND: what is at least half there counts as there.
constexpr float kBlendCutoff = 0.5f;

scene::ImageSampling samplingOf(const tinygltf::Model& model, int texture) {
  scene::ImageSampling sampling;
  if (texture < 0 || static_cast<std::size_t>(texture) >= model.textures.size()) return sampling;
  const int index = model.textures[texture].sampler;
  if (index < 0 || static_cast<std::size_t>(index) >= model.samplers.size()) return sampling;
  const tinygltf::Sampler& sampler = model.samplers[index];
  const auto wrapOf = [](int wrap) {
    if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return ImageWrap::clampToEdge;
    return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? ImageWrap::mirroredRepeat : ImageWrap::repeat;
  };
  sampling.wrapU = wrapOf(sampler.wrapS);
  sampling.wrapV = wrapOf(sampler.wrapT);
  if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) sampling.filter = ImageFilter::nearest;
  return sampling;
}

float cutoffOf(const tinygltf::Material& source) {
  if (source.alphaMode == "BLEND") return kBlendCutoff;
  if (source.alphaMode != "MASK" || !std::isfinite(source.alphaCutoff)) return 0.0f;
  // Above 1 everything is cut away, also what has no alpha of its own.
  return static_cast<float>(std::max(source.alphaCutoff, 0.0));
}

/// Base colour, or the diffuse one of KHR_materials_pbrSpecularGlossiness where a material has that; files of
/// before 2021 do.
struct BaseColor {
  std::vector<double> factor;
  int texture = -1, set = 0;
  const tinygltf::Value* transform = nullptr;  ///< KHR_texture_transform; null: none
};

const tinygltf::Value* objectIn(const tinygltf::Value& value, const char* key) {
  const tinygltf::Value& found = value.Get(key);
  return found.IsObject() ? &found : nullptr;
}

BaseColor diffuseColorOf(const tinygltf::Value& extension) {
  BaseColor base{.factor = {1, 1, 1, 1}};
  const tinygltf::Value& factor = extension.Get("diffuseFactor");
  for (int c = 0; c < 4 && factor.IsArray() && factor.ArrayLen() == 4; ++c) {
    if (factor.Get(c).IsNumber())
      base.factor[static_cast<std::size_t>(c)] = factor.Get(c).GetNumberAsDouble();
  }
  const tinygltf::Value* texture = objectIn(extension, "diffuseTexture");
  if (texture == nullptr) return base;
  base.texture = indexIn(texture->Get("index"));
  if (const int set = indexIn(texture->Get("texCoord")); set >= 0) base.set = set;
  const tinygltf::Value* extensions = objectIn(*texture, "extensions");
  if (extensions != nullptr) base.transform = objectIn(*extensions, "KHR_texture_transform");
  return base;
}

BaseColor baseColorOf(const tinygltf::Material& source) {
  const auto extension = source.extensions.find("KHR_materials_pbrSpecularGlossiness");
  if (extension != source.extensions.end() && extension->second.IsObject())
    return diffuseColorOf(extension->second);
  const tinygltf::TextureInfo& texture = source.pbrMetallicRoughness.baseColorTexture;
  BaseColor base{source.pbrMetallicRoughness.baseColorFactor, texture.index, texture.texCoord};
  const auto found = texture.extensions.find("KHR_texture_transform");
  if (found != texture.extensions.end() && found->second.IsObject()) base.transform = &found->second;
  return base;
}

/// One an image, whatever materials show it.
class AlphaPyramids {
 public:
  std::shared_ptr<const scene::AlphaPyramid> of(const std::shared_ptr<const scene::Image>& image) {
    std::shared_ptr<const scene::AlphaPyramid>& made = made_[image];
    if (!made) made = std::make_shared<const scene::AlphaPyramid>(*image);
    return made;
  }

 private:
  std::map<std::shared_ptr<const scene::Image>, std::shared_ptr<const scene::AlphaPyramid>> made_;
};
}  // namespace

TextureCoordinates textureCoordinatesOf(const tinygltf::Material& material) {
  const BaseColor base = baseColorOf(material);
  TextureCoordinates result{.set = base.set};
  if (base.transform == nullptr) return result;
  const tinygltf::Value& transform = *base.transform;
  const auto pair = [&](const char* key, glm::dvec2 otherwise) {
    const tinygltf::Value& value = transform.Get(key);
    if (!value.IsArray() || value.ArrayLen() != 2 || !value.Get(0).IsNumber() || !value.Get(1).IsNumber())
      return otherwise;
    return glm::dvec2(value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble());
  };
  const glm::dvec2 offset = pair("offset", glm::dvec2(0.0)), scale = pair("scale", glm::dvec2(1.0));
  const tinygltf::Value& rotation = transform.Get("rotation");
  const double angle = rotation.IsNumber() ? rotation.GetNumberAsDouble() : 0.0;
  const double c = std::cos(angle), s = std::sin(angle);
  // Counter-clockwise as seen, with v downward.
  result.imageFromFile =
      glm::dmat3x2(c * scale.x, -s * scale.x, s * scale.y, c * scale.y, offset.x, offset.y);
  if (const int set = indexIn(transform.Get("texCoord")); set >= 0) result.set = set;
  return result;
}

std::vector<int> baseColorTextures(const tinygltf::Model& model) {
  std::vector<int> textures;
  for (const tinygltf::Material& source : model.materials) textures.push_back(baseColorOf(source).texture);
  return textures;
}

std::vector<GltfMaterial> materialsOf(const tinygltf::Model& model, GltfImages& images) {
  std::vector<GltfMaterial> materials;
  AlphaPyramids pyramids;
  for (const tinygltf::Material& source : model.materials) {
    GltfMaterial result{.blends = source.alphaMode == "BLEND"};
    scene::Material& material = result.material;
    const BaseColor base = baseColorOf(source);
    const std::vector<double>& factor = base.factor;
    material.baseColor = glm::vec4(1.0f);
    for (int c = 0; c < 4 && factor.size() == 4; ++c) {
      material.baseColor[c] = std::isfinite(factor[c]) ? static_cast<float>(factor[c]) : 1.0f;
    }
    material.doubleSided = source.doubleSided;
    material.alphaCutoff = cutoffOf(source);
    if (base.texture >= 0) {
      material.baseColorImage = images.ofTexture(base.texture);
      material.sampling = samplingOf(model, base.texture);
      if (material.baseColorImage && material.alphaCutoff > 0.0f)
        result.imageAlpha = pyramids.of(material.baseColorImage);
    }
    materials.push_back(std::move(result));
  }
  return materials;
}

}  // namespace halfshadow::scenes
