// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/occlusion_textures/occlusion_textures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "techniques/core/caster_spread.hpp"
#include "techniques/occlusion_textures/occlusion_shaders.hpp"
#include "techniques/occlusion_textures/slice_passes.hpp"
#include "techniques/parts/screen/visibility_parts.hpp"

namespace halfshadow::techniques {
namespace {
/// An elongated light's kernel is covered by at most this many squares.
constexpr int kMostBoxes = 8;
/// Share of the casters' depth range that an occluder must be nearer than the receiver, and over which its
/// shadow then fades in: hides what 8 bits of mean depth leave of a surface's own shadow.
constexpr double kOwnSurfaceBias = 0.024;
/// The same of sub-lights, whose texels are twice as wide.
constexpr double kOwnSurfaceBiasOfParts = 0.048;

/// Farthest over nearest caster: beyond, slices are thick against what lies in them, and casters beside the
/// light leave the others too little of the map.
constexpr double kWidestSpread = 8.0;

/// Texels: a map whose widest kernel is narrower gets twice as many a side. Edges are known to about half a
/// texel, so that the errors of spheres27 and fence at h = .3 (12 and 17 texels) halve with it; from 20
/// texels on they fall by a quarter or less. Narrow kernels need few levels: twice the texels are no more
/// fetches.
constexpr double kNarrowKernel = 20.0;

constexpr device::UniformKey kSamplers[] = {"u_occlusion0", "u_occlusion1", "u_occlusion2", "u_occlusion3",
                                            "u_occlusion4", "u_occlusion5", "u_occlusion6", "u_occlusion7"};

enum class Preset { paper, tuned };
struct Choices {
  Preset preset = Preset::tuned;
  SliceFilter filter = SliceFilter::nbuffer;
  std::string combine;
  SliceOptions slicing;
  /// Who names a number of sub-lights wants its accuracy; `auto` weighs what it costs.
  bool oneSearch = false;
  bool paper() const { return preset == Preset::paper; }
};

Choices readChoices(const Settings& settings) {
  const auto choice = [&](const char* key) {
    return settings.choice(std::string("occlusion-textures.") + key);
  };
  Choices choices;
  choices.preset = choice("preset") == "paper" ? Preset::paper : Preset::tuned;
  std::string filter = choice("filter");
  if (filter == "auto") filter = settings.choice("occlusion_prefilter");
  choices.filter = filter == "sat"      ? SliceFilter::summedArea
                   : filter == "mipmap" ? SliceFilter::mipmap
                                        : SliceFilter::nbuffer;
  choices.combine = choice("combine");
  if (choices.combine == "auto") choices.combine = choices.paper() ? "product" : "sum";
  choices.oneSearch = settings.choice("sub_lights") == "auto";
  SliceOptions& slicing = choices.slicing;
  slicing.slices = settings.integer("occlusion-textures.slices");
  slicing.mapSize = settings.integer("occlusion-textures.map_size");
  if (choice("projection") == "orthographic") slicing.projection = SliceProjection::orthographic;
  const std::string center = choice("center");
  if (center == "behind" || (center == "auto" && choices.paper())) slicing.center = SliceCenter::behind;
  if (choices.paper() && choice("leak_fix") == "on") slicing.successors = SliceSuccessors::kept;
  return choices;
}

std::string filterDefine(SliceFilter filter) {
  switch (filter) {
    case SliceFilter::mipmap:
      return "HS_FILTER_MIPMAP";
    case SliceFilter::nbuffer:
      return "HS_FILTER_NBUFFER";
    case SliceFilter::summedArea:
      return "HS_FILTER_SAT";
  }
  return {};
}

Status checkTextureUnits(const LightScene& scene, std::size_t textures, const SliceOptions& slicing) {
  const bool textured = std::ranges::any_of(
      scene.receivers, [](const DrawItem& item) { return item.baseColorTexture != nullptr; });
  const std::size_t needed = textures + (textured ? 1 : 0);
  if (needed <= static_cast<std::size_t>(scene.capabilities.limits.fragmentTextureUnits)) return {};
  return Error{ErrorCode::invalidArgument,
               "occlusion-textures.slices=" + std::to_string(slicing.slices) + " needs " +
                   std::to_string(needed) + " texture units, but this device has " +
                   std::to_string(scene.capabilities.limits.fragmentTextureUnits) + "; choose fewer slices"};
}

class OcclusionTextures final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "occlusion-textures",
        .paper = "Eisemann, Décoret 2006",
        .summary =
            "casters in slices parallel to the light, prefiltered so that two fetches give the share of the "
            "light a slice covers",
        .guarantees =
            "cost depends neither on the light's size nor on the scene's complexity, but for drawing the "
            "slices; "
            "summed-area tables are exact",
        .knownFailures =
            "tuned: only what the centre of the light, or of one of four parts, sees casts a shadow, and "
            "occluders in the receiver's own "
            "slice "
            "blend with its surface; lights whose farthest caster is over 8 times as far as the nearest go "
            "to "
            "sampled; paper: surfaces across several slices count as independent, and casters "
            "shadow themselves"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    const auto choice = [](const char* key, const char* otherwise, std::vector<std::string> choices,
                           const char* text) {
      return SettingInfo{std::string("occlusion-textures.") + key,
                         SettingType::choice,
                         otherwise,
                         0,
                         0,
                         std::move(choices),
                         text};
    };
    return {
        choice("preset", "tuned", {"paper", "tuned"},
               "paper: binary slices on their far planes, multiplied; tuned: first hits with their mean "
               "depth, added"),
        {"occlusion-textures.slices",
         SettingType::integer,
         "4",
         4,
         16,
         {},
         "slices between the nearest and the farthest caster"},
        {"occlusion-textures.map_size",
         SettingType::integer,
         "256",
         64,
         1024,
         {},
         "side of the occlusion textures in texels; tuned: twice as many where the widest penumbra would be "
         "under 20 of them wide"},
        choice("filter", "auto", {"auto", "mipmap", "nbuffer", "sat"},
               "prefilter: hardware mipmaps, N-buffers, or exact summed-area tables; auto: "
               "occlusion_prefilter, the device profile's choice"),
        choice("combine", "auto", {"auto", "product", "sum", "max"},
               "how shares of slices become one; auto: product for paper, sum for tuned"),
        choice("projection", "perspective", {"perspective", "orthographic"}, "of the slices"),
        choice("center", "auto", {"auto", "light", "behind"},
               "of the perspective projection: the light's centre, or behind it as far as the paper puts "
               "it; auto: by preset"),
        choice("leak_fix", "off", {"off", "on"},
               "paper: also project each slice on the next one, which closes the gaps of thin occluders; "
               "tuned has no such gaps")};
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    if (readChoices(scene.settings).paper()) return std::nullopt;
    return sampledWhereCastersSpread(scene, kWidestSpread);
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return occlusionShaders(kMostBoxes); }
  SubLightUse subLightUse(const Settings& settings) const override {
    const Choices choices = readChoices(settings);
    // Other views than the light's own see the same in an orthographic projection, and the paper has one.
    const SliceOptions& slicing = choices.slicing;
    const bool fromLight =
        slicing.projection == SliceProjection::perspective && slicing.center == SliceCenter::light;
    return !choices.paper() && fromLight ? SubLightUse::automatic : SubLightUse::none;
  }
  planner::SubLightNeeds subLightNeeds(const Settings& settings, int) const override {
    // Means over texels need few of them in a penumbra; nine maps of 80 texels hold too little of its
    // casters.
    return {.mapSize = settings.integer("occlusion-textures.map_size"), .perSide = 2, .worthSplitting = 12.0};
  }
  std::vector<Fallback> fallbacks() const override {
    return {shadedApart(),
            shadedApart({{"sub_lights", "1"}}, "slices of the whole light"),
            shadedApart({{"sub_lights", "1"}, {"program_size", "parts"}},
                        "slices of the whole light, two a draw"),
            {.text = "a filter as wide as the penumbra", .technique = "pcss-mip"}};
  }
  std::unique_ptr<LightPlanner> newPlanner() const override;
};

class OcclusionPlanner final : public LightPlanner {
 public:
  Status plan(const LightScene& scene, PassPlan& plan) override {
    Choices choices = readChoices(scene.settings);
    choices.slicing.receiverFarDistance = scene.receiverFarDistance;
    choices.slicing.powersOfTwo = choices.filter == SliceFilter::mipmap;
    if (scene.subLights != nullptr) {
      choices.slicing.grid = scene.subLights->grid;
      choices.slicing.borderTexels = 1;  // the filters give each map a margin of its own
    }
    if (const int size = choices.slicing.mapSize; (size & (size - 1)) != 0) {
      return Error{ErrorCode::invalidArgument, "occlusion-textures.map_size=" + std::to_string(size) +
                                                   " is no power of two; choose 64, 128, 256, 512 or 1024"};
    }
    choices.slicing.mapSize = std::min(choices.slicing.mapSize * scene.fit().growth, kMostMapSize);
    if (Status s = findSpace(scene, choices); !s) return s;
    for (const int empty : space_->emptySlices) {
      plan.note(scene.name + " occlusion slice " + std::to_string(empty + 1),
                "no caster lies between its borders");
    }
    const SliceContent content = choices.paper() ? SliceContent::everything : SliceContent::nearestFaces;
    const SliceTextures slices = planSlices(scene, plan, *space_, content, choices.filter);
    if (Status s = checkTextureUnits(scene, slices.textures.size(), choices.slicing); !s) return s;
    auto filtered = planSliceFilter(scene, plan, *space_, slices, choices.filter);
    if (!filtered) return filtered.error();
    const std::size_t textures = filtered->textures.size();
    plan.shading = receiverShading(choices, *space_, slices, *filtered, {0, textures});
    const bool addsUp = !choices.paper() && choices.combine == "sum" && space_->grid.whole();
    if (hasProgramsInParts(scene) && addsUp && textures > 1 && textures <= kMostVisibilityParts) {
      std::vector<ReceiverShading> parts;
      for (std::size_t i = 0; i < textures; ++i)
        parts.push_back(receiverShading(choices, *space_, slices, *filtered, {i, 1}));
      planVisibilityParts(scene, plan, std::move(parts));
    }
    return {};
  }

 private:
  /// Kept from the last frame: finding the slices that hold casters looks at triangles.
  Status findSpace(const LightScene& scene, const Choices& choices) {
    const SliceOptions& asked = choices.slicing;
    if (space_ && contentKey_ == scene.contentKey && options_ == asked) return {};
    space_.reset();
    SliceOptions options = asked;
    auto made = makeSliceSpace(scene.fit(), scene.casterShapes, options, scene.subLights);
    // Coordinates of mediump could not tell the texels apart.
    const bool mayDouble = !choices.paper() && 2 * asked.mapSize <= kMostMapSize &&
                           scene.capabilities.has(device::Capability::highp);
    if (made && mayDouble && made->widestTexels < kNarrowKernel) {
      options.mapSize = 2 * asked.mapSize;
      auto twice = makeSliceSpace(scene.fit(), scene.casterShapes, options, scene.subLights);
      const glm::ivec2 side = twice ? filteredSize(*twice, choices.filter) : glm::ivec2(0);
      if (twice && std::max(side.x, side.y) <= scene.capabilities.limits.textureSize) made = std::move(twice);
    }
    if (!made) return made.error();
    space_ = std::move(made).value();
    contentKey_ = scene.contentKey;
    options_ = asked;
    return {};
  }

  static void addSubLights(const SliceSpace& space, bool oneSearch, ReceiverShading& shading) {
    if (space.grid.whole()) return;
    shading.defines.push_back("HS_SUB_LIGHTS_U " + std::to_string(space.grid.alongU));
    shading.defines.push_back("HS_SUB_LIGHTS_V " + std::to_string(space.grid.alongV));
    if (oneSearch) shading.defines.emplace_back("HS_ONE_SEARCH");
    shading.uniforms.set("u_subLightStep", glm::vec4(space.stepU, space.stepV));
    shading.uniforms.set("u_subLights", glm::vec4(space.alignedSlice, 0, 0, 0));
    shading.uniforms.set("u_tiles", glm::vec4(space.tiles, space.mapSize));
  }

  struct TextureRange {
    std::size_t first = 0, count = 0;
  };
  /// Of the slices in these of the textures.
  static ReceiverShading receiverShading(const Choices& choices, const SliceSpace& space,
                                         const SliceTextures& slices, const FilteredSlices& filtered,
                                         const TextureRange& range) {
    const auto perTexture = static_cast<std::size_t>(slices.slicesPerTexture);
    const std::size_t slots = range.count * perTexture;
    const double shorter = std::min(space.shape.x, space.shape.y);
    const int boxes = std::clamp(static_cast<int>(std::lround(1.0 / std::max(shorter, 1e-3))), 1, kMostBoxes);
    ReceiverShading shading;
    shading.fragmentFile = "occlusion/occlusion_textures.frag";
    shading.mapFromWorld = space.mapFromWorld;
    shading.defines = {"HS_SLOTS " + std::to_string(slots), "HS_TEXTURES " + std::to_string(range.count),
                       "HS_BOXES " + std::to_string(boxes), filterDefine(choices.filter),
                       choices.combine == "product" ? "HS_COMBINE_PRODUCT"
                       : choices.combine == "max"   ? "HS_COMBINE_MAX"
                                                    : "HS_COMBINE_SUM"};
    if (!choices.paper()) {
      shading.defines.push_back("HS_SLICE_DEPTH");
      shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
      const glm::dvec3 middle = 0.5 * (space.views.front().originWorld + space.views.back().originWorld);
      shading.itemUniforms = [origin = middle](const DrawItem& item, device::UniformList& uniforms) {
        const device::Cull hidden = hiddenFaces(item, origin);
        uniforms.set("u_innerSide",
                     hidden == device::Cull::none ? 0.0f : (hidden == device::Cull::back ? 1.0f : -1.0f));
      };
      if (slices.lastReceivers) {
        shading.defines.push_back("HS_LAST_RECEIVERS");
        shading.textures.push_back({.sampler = "u_lastReceivers", .resource = *slices.lastReceivers});
      }
      if (choices.filter == SliceFilter::summedArea) shading.defines.push_back("HS_SAT_SMOOTH");
    }
    if (space.ratio1 == 0.0) shading.defines.push_back("HS_CONCENTRIC");
    addSubLights(space, choices.oneSearch, shading);
    for (std::size_t i = 0; i < range.count; ++i) {
      shading.textures.push_back({.sampler = kSamplers[i], .resource = filtered.textures[range.first + i]});
    }
    const double ownBias = space.grid.whole() ? kOwnSurfaceBias : kOwnSurfaceBiasOfParts;
    std::vector<glm::vec4> borders;
    for (const Slice& slice :
         std::span(space.slices).subspan(std::min(range.first * perTexture, space.slices.size()))) {
      borders.emplace_back(slice.low, slice.high, 1.0 / (slice.high - slice.low),
                           ownBias * choices.slicing.slices);
    }
    // Channels without slice lie behind every receiver.
    borders.resize(slots, glm::vec4(1e4f, 1e4f, 0, 1));
    const glm::vec4 place(space.center, space.ratio0, space.ratio1);
    const glm::vec4 own(space.divisorScale, space.divisorConstant, space.sideScale, 0);
    const glm::vec4 shape(space.shape, std::max(shorter, 1.0 / boxes), 0);
    const glm::vec4 last(space.depthSlices, 0.5 * kOwnSurfaceBias, 0, 0);
    shading.uniforms.set("u_slices", borders);
    shading.uniforms.set("u_slicePlace", place);
    shading.uniforms.set("u_sliceOwn", own);
    shading.uniforms.set("u_occlusionLayout", filtered.layout);
    shading.uniforms.set("u_kernelShape", shape);
    shading.uniforms.set("u_lastRange", last);
    return shading;
  }

  std::uint64_t contentKey_ = 0;
  SliceOptions options_;
  std::optional<SliceSpace> space_;
};

std::unique_ptr<LightPlanner> OcclusionTextures::newPlanner() const {
  return std::make_unique<OcclusionPlanner>();
}
}  // namespace

std::unique_ptr<Technique> makeOcclusionTextures() {
  return std::make_unique<OcclusionTextures>();
}

}  // namespace halfshadow::techniques
