// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every technique's passes for scenes of odd shapes in odd places, without GL: whole plans, or a refusal with
// a sentence.
#include <algorithm>
#include <cmath>
#include <set>

#include "input_reader.hpp"
#include "plan_rig.hpp"
#include "scenes/shapes.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow::fuzz {
namespace {
using techniques::PassPlan;

/// A box with a face missing, two boxes that touch, a handful of loose triangles, …
std::shared_ptr<const scene::TriangleMesh> shapeOf(InputReader& reader) {
  const std::uint8_t kind = reader.byte();
  scenes::Shape shape;
  switch (kind % 8) {
    case 0:
      shape = scenes::boxShape({}, glm::dvec3(1.0));
      break;
    case 1:
      shape = scenes::boxShape({}, glm::dvec3(1.0));
      shape.indices.resize(30);
      break;
    case 2:
      shape = scenes::boxShape({}, glm::dvec3(1.0));
      shape.append(scenes::boxShape({1.5, 0.5, 0.0}, {0.5, 1.0, 0.25}));
      break;
    case 3:
      shape = scenes::icosphereShape({}, 1.0, 1);
      break;
    case 4:
      shape = scenes::planeShape({}, 2.0);
      break;
    case 5:
      shape = scenes::frustumShape({}, 1.0, 0.0, 2.0, 5);
      break;
    default:
      for (std::size_t i = 3 + 3 * reader.below(6); i > 0; --i) {
        const double x = reader.plainNumber(), y = reader.plainNumber(), z = reader.plainNumber();
        shape.indices.push_back(shape.addVertex({x, y, z}));
      }
  }
  auto built = scene::buildMesh({.positions = &shape.positions[0].x,
                                 .vertexCount = static_cast<std::uint32_t>(shape.positions.size()),
                                 .indices = shape.indices.data(),
                                 .indexCount = shape.indices.size()});
  if (!built) return nullptr;
  return std::make_shared<const scene::TriangleMesh>(std::move(*built));
}

scene::SceneDescription sceneOf(InputReader& reader) {
  scene::SceneDescription scene;
  const glm::dvec3 center(reader.plainNumber(), reader.plainNumber(), reader.plainNumber());
  const double half = std::abs(reader.plainNumber()), aspect = 1.0 + std::abs(reader.plainNumber());
  const auto light = scene::areaLightAimed(center, center + glm::dvec3(0.25, -1.0, 0.125), 2.0 * half,
                                           2.0 * half * aspect, {0, 1, 0});
  scene.lights.push_back(light ? *light : scene::AreaLight{.centerWorld = {0, 9, 0}});
  scene.camera = scene::Camera{.eyeWorld = {0, 5, 12}, .nearDistance = 0.5, .farDistance = 60.0};
  for (std::size_t i = 1 + reader.below(4); i > 0; --i) {
    scene::SceneObject object{.name = "object " + std::to_string(i), .mesh = shapeOf(reader)};
    const std::uint8_t kind = reader.byte();
    object.casts = (kind & 3) != 1;
    object.receives = (kind & 12) != 4;
    for (int axis = 0; axis < 3; ++axis)
      object.worldFromObject[axis][axis] = 0.125 + std::abs(reader.plainNumber());
    for (int axis = 0; axis < 3; ++axis) object.worldFromObject[3][axis] = reader.plainNumber();
    if ((kind & 64) != 0) object.worldFromObject[0][1] = 0.5;
    if (object.mesh) scene.objects.push_back(std::move(object));
  }
  scene.objects.push_back(scenes::groundObject());
  return scene;
}

void checkReads(const PassPlan& plan) {
  for (const techniques::TextureRead& read : plan.shading.textures) {
    require(read.own ? *read.own < plan.textures.size() : read.resource.index < plan.images.size(),
            "receivers read what there is not");
  }
  for (const techniques::PlannedPass& pass : plan.passes) {
    for (const framegraph::Attachment& write : pass.writes)
      require(write.resource.index < plan.images.size(), pass.name + " writes what there is not");
  }
}

void checkBuffers(const PassPlan& plan, const techniques::BufferDraw& draw) {
  for (const techniques::BufferDraw::Attribute& attribute : draw.attributes) {
    require(attribute.buffer < plan.buffers.size(), "a draw reads a buffer that there is not");
    if (draw.indexType != device::IndexType::none || draw.count == 0) continue;
    const std::size_t stride = static_cast<std::size_t>(attribute.strideBytes);
    require((draw.first + draw.count - 1) * stride + attribute.offsetBytes <
                plan.buffers[attribute.buffer].bytes->size(),
            "a draw reads vertices behind its buffer");
  }
  if (draw.indexType == device::IndexType::none) return;
  require(draw.indices < plan.buffers.size(), "a draw reads indices that there are not");
  const std::size_t size = draw.indexType == device::IndexType::uint16 ? 2 : 4;
  require((draw.first + draw.count) * size <= plan.buffers[draw.indices].bytes->size(),
          "a draw reads indices behind its buffer");
}

void checkUploads(const PassPlan& plan, const device::Limits& limits) {
  for (const framegraph::ResourceDesc& image : plan.images) {
    require(image.width > 0 && image.height > 0 && std::max(image.width, image.height) <= limits.textureSize,
            image.name + " has a size that the device has not");
  }
  for (const techniques::PlannedTexture& texture : plan.textures) {
    const techniques::Pixels pixels = texture.pixels();
    const std::size_t texels =
        static_cast<std::size_t>(texture.desc.width) * static_cast<std::size_t>(texture.desc.height);
    require(texels > 0 && pixels && pixels->size() % texels == 0 && !pixels->empty(),
            texture.name + " holds more or less than its size says");
    require(std::max(texture.desc.width, texture.desc.height) <= limits.textureSize,
            texture.name + " is larger than the device's textures");
  }
}

void checkPlan(const test::Planned& planned, const device::Limits& limits) {
  if (!planned.status) {
    require(planned.status.error().code != ErrorCode::internal && planned.status.error().message.size() > 10,
            "a refusal without a reason: " + planned.status.error().message);
    return;
  }
  checkReads(planned.plan);
  checkUploads(planned.plan, limits);
  for (const techniques::PlannedPass& pass : planned.plan.passes) {
    for (const techniques::PlannedDraw& draw : pass.draws) {
      if (const auto* buffers = std::get_if<techniques::BufferDraw>(&draw.what))
        checkBuffers(planned.plan, *buffers);
    }
  }
}

const std::vector<std::unique_ptr<techniques::Technique>>& allTechniques() {
  static const auto made = techniques::makeAllTechniques();
  return made;
}

void test(Input input) {
  InputReader reader(input);
  const techniques::Technique& technique = *allTechniques()[reader.below(allTechniques().size())];
  static const std::vector<device::Capability> kMissing[] = {
      {}, {device::Capability::highp}, {device::Capability::depthTexture}, {device::Capability::derivatives}};
  const device::Capabilities capabilities = test::capabilitiesWithout(kMissing[reader.below(4)]);
  if (!technique.support(capabilities).supported) return;
  std::vector<techniques::SettingInfo> settings = techniques::commonSettings();
  for (techniques::SettingInfo& info : technique.settings()) settings.push_back(std::move(info));
  std::vector<std::pair<std::string, std::string>> chosen = {{"map_size", "128"}};
  for (std::size_t i = reader.below(3); i > 0; --i) {
    const techniques::SettingInfo& info = settings[reader.below(settings.size())];
    if (!info.choices.empty()) chosen.emplace_back(info.key, info.choices[reader.below(info.choices.size())]);
  }
  test::PlanRig rig(sceneOf(reader), capabilities, settings);
  for (const auto& [key, value] : chosen) require(rig.settings().set(key, value).ok(), "a choice is refused");
  if (rig.prepare(0).casters.empty() || rig.prepare(0).center.fit.empty) return;  // engines plan nothing then
  const auto planner = technique.newPlanner();
  checkPlan(rig.plan(*planner), capabilities.limits);
  rig.moveCaster();
  checkPlan(rig.plan(*planner), capabilities.limits);
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  for (std::size_t technique = 0; technique < allTechniques().size(); ++technique) {
    for (const double half : {0.0, 1.0}) {
      InputWriter writer;
      writer.byte(technique).byte(0).byte(0);
      writer.numbers({0, 9, 0, half, 0});
      writer.byte(1);
      writer.byte(technique % 6).byte(0).numbers({1, 1, 1, 0, 2, 0});
      writer.byte(2).byte(0).numbers({1, 0.5, 1, 0.5, 4, 0.25});
      all.push_back(std::move(writer.bytes));
    }
  }
  return all;
}
}  // namespace

const Target& target() {
  static const Target made{.name = "light_plans", .test = test, .seeds = seeds, .largestInput = 256};
  return made;
}

}  // namespace halfshadow::fuzz
