// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What holds of every technique's plan, whatever it draws. The program links no GL: planning compiles without
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "plan_rig.hpp"
#include "scenes/builtin_scenes.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow::test {
namespace {

using framegraph::ResourceId;
using techniques::PassPlan;
using techniques::PlannedPass;
using techniques::TextureRead;

constexpr const char* kScenes[] = {"box", "contact", "sheets", "room"};

struct CapabilitySet {
  const char* name;
  std::vector<device::Capability> missing;
};
const std::vector<CapabilitySet>& capabilitySets() {
  static const std::vector<CapabilitySet> sets{{"all", {}},
                                               {"no highp", {device::Capability::highp}},
                                               {"no depth texture", {device::Capability::depthTexture}}};
  return sets;
}

std::vector<techniques::SettingInfo> settingsOf(const techniques::Technique& technique) {
  std::vector<techniques::SettingInfo> settings = techniques::commonSettings();
  for (techniques::SettingInfo& info : technique.settings()) settings.push_back(std::move(info));
  return settings;
}

/// Without highp lists have few rows: casters whose lists cannot fit are refused, and the engine takes
/// another technique.
bool refuses(const techniques::Technique& technique, PlanRig& rig) {
  if (rig.capabilities().has(device::Capability::highp)) return false;
  const auto planner = technique.newPlanner();
  const Planned tried = rig.plan(*planner);
  return !tried.status && tried.status.error().code == ErrorCode::outOfMemory;
}

/// Calls `check` with every technique that the capabilities support, in every scene.
template <typename Check>
void forAll(const Check& check) {
  for (const char* name : kScenes) {
    const auto description = scenes::makeBuiltinScene(name);
    ASSERT_TRUE(description) << description.error().message;
    for (const CapabilitySet& set : capabilitySets()) {
      for (const auto& technique : techniques::makeAllTechniques()) {
        SCOPED_TRACE(technique->info().id + " in " + name + ", capabilities: " + set.name);
        PlanRig rig(*description, capabilitiesWithout(set.missing), settingsOf(*technique));
        if (technique->support(rig.capabilities()).supported && !refuses(*technique, rig))
          check(*technique, rig);
      }
    }
  }
}

/// Images that a pass reads: as textures, by reading back, or by keeping what is in a target.
std::vector<ResourceId> imagesRead(const PlannedPass& pass) {
  std::vector<ResourceId> images;
  const auto add = [&](const std::vector<TextureRead>& textures) {
    for (const TextureRead& read : textures) {
      if (!read.own) images.push_back(read.resource);
    }
  };
  for (const techniques::PlannedDraw& draw : pass.draws) {
    add(draw.textures);
    if (const auto* receivers = std::get_if<techniques::ReceiversDraw>(&draw.what))
      add(receivers->shading.textures);
    if (const auto* back = std::get_if<techniques::ReadBackDraw>(&draw.what)) images.push_back(back->image);
  }
  for (const framegraph::Attachment& write : pass.writes) {
    if (write.initial == framegraph::InitialContent::keep) images.push_back(write.resource);
  }
  return images;
}

/// Passes in the order in which they run.
std::vector<const PlannedPass*> inOrder(const PassPlan& plan) {
  std::vector<const PlannedPass*> passes;
  for (const PlannedPass& pass : plan.passes) passes.push_back(&pass);
  std::ranges::stable_sort(passes, {}, [](const PlannedPass* pass) { return pass->stage; });
  return passes;
}

void checkReads(const PassPlan& plan) {
  std::set<std::uint32_t> written;
  for (const PlannedPass* pass : inOrder(plan)) {
    for (const ResourceId image : imagesRead(*pass)) {
      ASSERT_LT(image.index, plan.images.size()) << pass->name;
      EXPECT_TRUE(written.contains(image.index))
          << pass->name << " reads " << plan.images[image.index].name << ", which no earlier pass writes";
    }
    for (const framegraph::Attachment& write : pass->writes) {
      ASSERT_LT(write.resource.index, plan.images.size()) << pass->name;
      written.insert(write.resource.index);
    }
  }
  for (const TextureRead& read : plan.shading.textures) {
    if (read.own) continue;
    ASSERT_LT(read.resource.index, plan.images.size());
    EXPECT_TRUE(written.contains(read.resource.index))
        << "receivers read " << plan.images[read.resource.index].name << ", which no pass writes";
  }
}

void checkTextures(const PassPlan& plan, const std::vector<TextureRead>& textures) {
  for (const TextureRead& read : textures) {
    if (!read.own) continue;
    EXPECT_LT(*read.own, plan.textures.size());
  }
}

void checkBufferDraw(const PassPlan& plan, const techniques::BufferDraw& draw) {
  for (const techniques::BufferDraw::Attribute& attribute : draw.attributes)
    EXPECT_LT(attribute.buffer, plan.buffers.size());
  if (draw.indexType == device::IndexType::none) return;
  ASSERT_LT(draw.indices, plan.buffers.size());
  const std::size_t indexBytes = draw.indexType == device::IndexType::uint16 ? 2 : 4;
  EXPECT_LE((draw.first + draw.count) * indexBytes, plan.buffers[draw.indices].bytes->size());
}

/// Everything that a draw names is there.
void checkDraws(const PassPlan& plan) {
  checkTextures(plan, plan.shading.textures);
  for (const PlannedPass& pass : plan.passes) {
    SCOPED_TRACE(pass.name);
    EXPECT_LE(pass.drawsForAllLights.value_or(0), pass.draws.size());
    for (const techniques::PlannedDraw& draw : pass.draws) {
      checkTextures(plan, draw.textures);
      if (const auto* receivers = std::get_if<techniques::ReceiversDraw>(&draw.what)) {
        checkTextures(plan, receivers->shading.textures);
        continue;
      }
      EXPECT_LT(draw.program, plan.programs.size());
      if (const auto* buffers = std::get_if<techniques::BufferDraw>(&draw.what))
        checkBufferDraw(plan, *buffers);
    }
  }
}

/// Each name, or id, once; each image of a size that the device has.
void checkNames(const PassPlan& plan, const device::Limits& limits) {
  ASSERT_EQ(plan.imageIsShared.size(), plan.images.size());
  std::set<std::string> images, passes, textures;
  for (const framegraph::ResourceDesc& image : plan.images) {
    EXPECT_TRUE(images.insert(image.name).second) << image.name;
    EXPECT_TRUE(image.width > 0 && image.height > 0) << image.name;
    EXPECT_LE(std::max(image.width, image.height), limits.textureSize) << image.name;
  }
  for (const PlannedPass& pass : plan.passes) EXPECT_TRUE(passes.insert(pass.name).second) << pass.name;
  for (const techniques::PlannedTexture& texture : plan.textures) {
    EXPECT_TRUE(textures.insert(texture.name).second) << texture.name;
    EXPECT_NE(texture.key, 0u) << texture.name;
    const std::size_t texels = static_cast<std::size_t>(texture.desc.width) * texture.desc.height;
    EXPECT_EQ(texture.pixels()->size() % texels, 0u) << texture.name;
  }
  std::set<std::uint64_t> buffers;
  for (const techniques::PlannedBuffer& buffer : plan.buffers) {
    EXPECT_TRUE(buffers.insert(buffer.id).second);
    EXPECT_NE(buffer.key, 0u);
    EXPECT_NE(buffer.bytes, nullptr);
  }
}

void checkPlan(const Planned& planned, const device::Limits& limits) {
  ASSERT_TRUE(planned.status) << planned.status.error().message;
  EXPECT_FALSE(planned.plan.shading.fragmentFile.empty());
  checkReads(planned.plan);
  checkDraws(planned.plan);
  checkNames(planned.plan, limits);
}

/// Of what is kept from frame to frame: passes, textures and buffers.
std::map<std::string, std::uint64_t> contentKeys(const PassPlan& plan) {
  std::map<std::string, std::uint64_t> keys;
  for (const PlannedPass& pass : plan.passes) keys["pass " + pass.name] = pass.contentKey;
  for (const techniques::PlannedTexture& texture : plan.textures)
    keys["texture " + texture.name] = texture.key;
  for (const techniques::PlannedBuffer& buffer : plan.buffers)
    keys["buffer " + std::to_string(buffer.id)] = buffer.key;
  return keys;
}

TEST(Plans, AreWholeForEveryTechniqueAndCapability) {
  forAll([](const techniques::Technique& technique, PlanRig& rig) {
    const auto planner = technique.newPlanner();
    ASSERT_NE(planner, nullptr);
    checkPlan(rig.plan(*planner), rig.capabilities().limits);
  });
}

TEST(Plans, AreWholeForEveryChoiceOfASetting) {
  const auto description = scenes::makeBuiltinScene("box");
  ASSERT_TRUE(description);
  for (const auto& technique : techniques::makeAllTechniques()) {
    for (const techniques::SettingInfo& info : settingsOf(*technique)) {
      for (const std::string& choice : info.choices) {
        SCOPED_TRACE(technique->info().id + " with " + info.key + "=" + choice);
        PlanRig rig(*description, capabilitiesWithout({}), settingsOf(*technique));
        ASSERT_TRUE(rig.settings().set(info.key, choice));
        const auto planner = technique->newPlanner();
        checkPlan(rig.plan(*planner), rig.capabilities().limits);
      }
    }
  }
}

TEST(Plans, OfAnUnchangedSceneHaveTheSameContentKeys) {
  forAll([](const techniques::Technique& technique, PlanRig& rig) {
    const auto planner = technique.newPlanner();
    const Planned first = rig.plan(*planner), again = rig.plan(*planner);
    ASSERT_TRUE(first.status && again.status);
    EXPECT_EQ(contentKeys(first.plan), contentKeys(again.plan));
  });
}

// Every pass with a key keeps something of the casters, from all of their shapes.
TEST(Plans, OfAMovedCasterHaveOtherContentKeys) {
  forAll([](const techniques::Technique& technique, PlanRig& rig) {
    const auto planner = technique.newPlanner();
    const Planned first = rig.plan(*planner);
    rig.moveCaster();
    const Planned moved = rig.plan(*planner);
    ASSERT_TRUE(first.status && moved.status);
    std::map<std::string, std::uint64_t> before;
    for (const PlannedPass& pass : first.plan.passes) before[pass.name] = pass.contentKey;
    for (const PlannedPass& pass : moved.plan.passes) {
      if (pass.contentKey == 0) continue;
      EXPECT_NE(pass.contentKey, before[pass.name]) << pass.name << " keeps what it had";
    }
    // What has no keyed pass either draws every frame or sends the casters' shapes to the GPU again.
    const auto keyOfBuffers = [](const PassPlan& plan) {
      std::vector<std::uint64_t> keys;
      for (const techniques::PlannedBuffer& buffer : plan.buffers) keys.push_back(buffer.key);
      return keys;
    };
    if (first.plan.buffers.empty()) return;
    EXPECT_NE(keyOfBuffers(first.plan), keyOfBuffers(moved.plan));
  });
}

// Lists, wedges, volumes and the lists of casters' own surfaces take outlines from one place, each in its own
// coordinates.
TEST(Plans, ExtractEachSilhouetteOnceForAPointOfTheLight) {
  const std::map<std::string, std::uint64_t> points{{"shadow-volume", 1},
                                                    {"wedges", 1},
                                                    {"wedges-probabilistic", 1},
                                                    {"wedges-blended", 1},
                                                    {"wedges-cells", 4}};
  std::set<std::string> taken;
  forAll([&](const techniques::Technique& technique, PlanRig& rig) {
    const auto planner = technique.newPlanner();
    const auto extractedNow = [&] {
      const std::uint64_t before = rig.silhouettes().extracted();
      EXPECT_TRUE(rig.plan(*planner).status);
      return rig.silhouettes().extracted() - before;
    };
    const auto known = points.find(technique.info().id);
    if (known == points.end()) {
      EXPECT_EQ(extractedNow(), 0u);
      return;
    }
    taken.insert(known->first);
    rig.silhouettes() = {};  // forAll() may have planned already
    const std::uint64_t casters = techniques::placedCasters(rig.prepare(0)).size();
    // Lists leave out casters inside others, which none of these scenes has.
    EXPECT_EQ(extractedNow(), known->second * casters);
    EXPECT_EQ(extractedNow(), 0u) << "nothing changed";
    rig.moveCaster();
    EXPECT_EQ(extractedNow(), known->second) << "one caster moved";
    rig.moveLight();
    EXPECT_EQ(extractedNow(), known->second * casters) << "the light moved";
  });
  EXPECT_EQ(taken.size(), points.size());
}

TEST(Plans, OfTwoLightsShareOnlyWhatTheySayIsShared) {
  forAll([](const techniques::Technique& technique, PlanRig& rig) {
    const auto planner = technique.newPlanner(), other = technique.newPlanner();
    const Planned first = rig.plan(*planner, 0), second = rig.plan(*other, 1);
    ASSERT_TRUE(first.status && second.status);
    std::map<std::string, bool> shared;
    for (std::size_t i = 0; i < first.plan.images.size(); ++i)
      shared[first.plan.images[i].name] = first.plan.imageIsShared[i];
    for (std::size_t i = 0; i < second.plan.images.size(); ++i) {
      const auto known = shared.find(second.plan.images[i].name);
      if (known == shared.end()) continue;
      EXPECT_TRUE(known->second && second.plan.imageIsShared[i]) << known->first;
    }
  });
}

}  // namespace
}  // namespace halfshadow::test
