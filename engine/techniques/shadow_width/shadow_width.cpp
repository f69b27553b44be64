// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_width/shadow_width.hpp"

#include <algorithm>
#include <bit>

#include "base/keys.hpp"
#include "techniques/core/caster_spread.hpp"
#include "techniques/parts/maps/light_blocks.hpp"
#include "techniques/parts/maps/map_shaders.hpp"
#include "techniques/shadow_width/attenuation.hpp"
#include "techniques/shadow_width/paper_width.hpp"
#include "techniques/shadow_width/signed_width.hpp"

namespace halfshadow::techniques {
namespace {
/// Farthest over nearest caster: distances at silhouettes have 8 bits, means over boxes mix casters that are
/// that far apart. Measured with a post under the light: .023 at 6, .040 at 11, .09 at 25.
constexpr double kWidestSpread = 8.0;

class ShadowWidth final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "shadow-width",
        .paper = "Kirsch, Doellner 2003; two-sided distances and widths from the light's size: Halfshadow",
        .summary =
            "penumbrae from the distance to the nearest silhouette in the light's map: two fetches a "
            "receiver, or one a sub-light",
        .guarantees =
            "two fetches per receiver whatever the scene, the light's size and the penumbra's width; of a "
            "split light two for lit and umbra receivers, at most one more a sub-light for others, at most "
            "two a "
            "sub-light for casters",
        .knownFailures =
            "casters seen through each other are one silhouette; a caster's shadow on itself is soft only "
            "where it leaves the silhouette; lights "
            "whose "
            "farthest caster is over 8 times as far as the nearest, or which see a caster behind a receiver "
            "that casts nothing, go to sampled"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {
        {"shadow-width.preset",
         SettingType::choice,
         "signed",
         0,
         0,
         {"paper", "signed"},
         "paper: penumbra inside the hard shadow, width map by iterated minimum; signed: both sides, widths "
         "from the light"},
        {"shadow-width.corners",
         SettingType::choice,
         "auto",
         0,
         0,
         {"auto", "off", "on"},
         "correct the straight edge's profile by the occupied share of the kernel; on: of each receiver's "
         "own, "
         "by a further fetch; auto: so too, but of a split light of the farthest receiver's, stored in the "
         "maps (signed)"},
        {"shadow-width.neighbours",
         SettingType::choice,
         "6",
         0,
         0,
         {"3", "6"},
         "texels compared per step of the width map (paper)"},
        {"shadow-width.build",
         SettingType::choice,
         "gpu",
         0,
         0,
         {"gpu", "cpu"},
         "where the width map is made; cpu reads the occlusion map back (paper)"},
        {"shadow-width.start",
         SettingType::integer,
         "256",
         4,
         256,
         {},
         "n of the width map's first difference 1/n: the penumbra is at most about n texels wide (paper)"},
        {"shadow-width.scale",
         SettingType::real,
         "0",
         0,
         1000,
         {},
         "c_scale: the larger, the narrower the penumbra; 0 takes it from the light's size (paper)"},
        {"shadow-width.offset",
         SettingType::real,
         "0.05",
         0,
         1,
         {},
         "c_bias: light added at the shadow's border (paper)"},
        {"shadow-width.attenuation",
         SettingType::choice,
         "arithmetic",
         0,
         0,
         {"arithmetic", "texture"},
         "attenuation computed, or looked up in a texture by a third, dependent fetch (paper)"},
        {"shadow-width.faces",
         SettingType::choice,
         "front",
         0,
         0,
         {"front", "back"},
         "faces of casters in the depth map: back hardens the edges where casters overlap, and no caster "
         "shadows itself (paper)"}};
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    // A light without size has no widths to get wrong; the paper's widths are its own.
    if (scene.fit().halfSize == glm::dvec2(0.0) || scene.settings.choice("shadow-width.preset") == "paper")
      return std::nullopt;
    if (auto spread = sampledWhereCastersSpread(scene, kWidestSpread)) return spread;
    if (!hasCastersBehindReceivers(scene)) return std::nullopt;
    return StandIn{
        "sampled",
        "caster-behind-receiver: a caster lies behind a receiver that casts nothing, and silhouettes "
        "seen from the light do not tell that it shadows others only"};
  }
  std::vector<ShaderFamily> shaderFamilies() const override {
    // Of the passes over the maps of a split light.
    const ShaderAxis tiles = flag("HS_TILES");
    ShaderAxis splits = subLightAxis();
    splits.erase(splits.begin());
    return joined(
        {{fullscreen("width/width_occlusion.frag", {depthAxis(), flag("HS_FARTHEST")}),
          fullscreen("width/width_minimum.frag", {values("HS_NEIGHBOURS", {3, 6})}),
          fullscreen("width/width_coverage.frag",
                     {depthAxis(), range("HS_SAMPLES_S", 1, 16, {1, 4, 16}),
                      range("HS_SAMPLES_T", 1, 16, {1, 4, 16}), flag("HS_LAST_RECEIVERS"), tiles}),
          fullscreen("width/width_seed.frag", {tiles}), fullscreen("width/width_flood.frag", {tiles}),
          fullscreen("width/width_box.frag", {tiles}), fullscreen("width/width_tile.frag"),
          fullscreen("width/width_finish.frag",
                     {tiles, {{}, {{"HS_BOXES"}}, {{"HS_BOXES", "HS_CORNER_SHARE"}, {"HS_TILES"}}}})},
         mapReceiverFamilies("width/shadow_width.frag", {{{},
                                                          {{"HS_CORNERS"}},
                                                          {{"HS_POINT_LIGHT"}},
                                                          {{"HS_PAPER"}},
                                                          {{"HS_PAPER", "HS_ATTENUATION_TEXTURE"}}},
                                                         castingAxis({"!HS_PAPER", "!HS_POINT_LIGHT"})}),
         mapReceiverFamilies("width/shadow_width.frag", {flag("HS_CORNERS"), castingAxis(), splits},
                             {.twoDraws = true, .filterTrustsClasses = true})});
  }
  SubLightUse subLightUse(const Settings& settings) const override {
    return settings.choice("shadow-width.preset") == "paper" ? SubLightUse::none : SubLightUse::automatic;
  }
  std::vector<Fallback> fallbacks() const override {
    return {shadedApart(),
            shadedApart({{"sub_lights", "1"}, {"shadow-width.corners", "off"}},
                        "one map of the whole light, no corners"),
            {.text = "a filter as wide as the penumbra", .technique = "pcss-mip"}};
  }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    return scene.settings.choice("shadow-width.preset") == "paper" ? planPaper(scene, plan)
                                                                   : planSigned(scene, plan);
  }

  static Status planSigned(const LightScene& scene, PassPlan& plan) {
    const LightDepth depth = planLightDepths(scene, plan, MapContent::casters);
    ReceiverShading& shading = plan.shading;
    shading = mapReceiverShading(scene, plan, depth, "width/shadow_width.frag");
    if (scene.fit().halfSize == glm::dvec2(0.0)) {
      shading.defines.push_back("HS_POINT_LIGHT");
      return {};
    }
    const WidthCorners corners = cornersFor(scene);
    const SignedWidthMap map = planSignedWidth(scene, plan, depth, corners);
    shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
    addSignedWidth(scene, shading, depth, map);
    if (depth.subLights == nullptr)
      addHorizon(scene, depth, shading);
    else
      addPenumbraBounds(scene, plan, depth, shading);
    shading.filterTrustsClasses = depth.subLights != nullptr;
    if (corners == WidthCorners::receivers) {
      shading.defines.push_back("HS_CORNERS");
      addWidthBoxes(shading, map);
    }
    return {};
  }

  static WidthCorners cornersFor(const LightScene& scene) {
    const std::string& asked = scene.settings.choice("shadow-width.corners");
    if (asked == "off") return WidthCorners::off;
    return asked == "auto" && scene.subLights != nullptr ? WidthCorners::stored : WidthCorners::receivers;
  }

  static Status planPaper(const LightScene& scene, PassPlan& plan) {
    const bool backFaces = scene.settings.choice("shadow-width.faces") == "back";
    const LightDepth depth = planLightDepth(scene, scene.center, plan,
                                            backFaces ? MapContent::castersFarthest : MapContent::casters);
    const int neighbours = scene.settings.choice("shadow-width.neighbours") == "3" ? 3 : 6;
    const WidthBuild build =
        scene.settings.choice("shadow-width.build") == "cpu" ? WidthBuild::cpu : WidthBuild::gpu;
    const std::vector<WidthStep> steps = widthSteps(neighbours, scene.settings.integer("shadow-width.start"));
    const framegraph::ResourceId width = planPaperWidth(scene, plan, depth, steps, build);

    ReceiverShading& shading = plan.shading;
    shading = mapReceiverShading(scene, plan, depth, "width/shadow_width.frag");
    shading.defines.push_back("HS_PAPER");
    shading.textures.push_back({.sampler = "u_widthMap", .resource = width});
    Attenuation constants{.scale = scene.settings.real("shadow-width.scale"),
                          .bias = scene.settings.real("shadow-width.offset")};
    // Shadow depth 1 is the distance from the nearest caster to the farthest receiver of the map.
    const MapSpace& space = depth.space;
    const double farthest = std::max(scene.receiverFarDistance, scene.fit().farDistance);
    const double range = std::max(farthest - space.nearDistance, 1e-6 * farthest);
    if (constants.scale == 0.0)
      constants.scale = scaleOfLight(scene, space, range, constants.bias, steps.front().differenceBytes);
    if (scene.settings.choice("shadow-width.attenuation") == "texture") {
      shading.defines.push_back("HS_ATTENUATION_TEXTURE");
      shading.textures.push_back({.sampler = "u_attenuationMap", .own = addAttenuationMap(plan, constants)});
    }
    const glm::vec4 uniform(space.nearDistance / range, constants.scale, 1.0 + constants.bias,
                            space.depthUnit);
    shading.uniforms.set("u_attenuation", uniform);
    return {};
  }

  /// c_scale with which the light is gone where the inner half of its penumbra ends, for occluders at the
  /// farthest caster and receivers at the map's end.
  static double scaleOfLight(const LightScene& scene, const MapSpace& space, double range, double bias,
                             int differenceBytes) {
    const double kernelTexels =
        std::min(space.kernelTexelsPerDepth.x, space.kernelTexelsPerDepth.y) * space.nearDistance;
    const double farthest = std::max(scene.receiverFarDistance, scene.fit().farDistance);
    const double widthPerDepth =
        0.5 * kernelTexels * range / (scene.fit().farDistance * farthest) * differenceBytes / 255.0;
    // A light without size leaves a hard edge: the bound keeps c_scale a number of fp16. The largest width
    // that the map can hold, 1, is dark at every depth, else a coarse start difference would leave no umbra.
    return (1.0 + bias) * std::clamp(1.0 / std::max(widthPerDepth, 1e-9), 1.0, 1024.0);
  }

  /// Each light has its own: constants follow from its size and place.
  static std::uint32_t addAttenuationMap(PassPlan& plan, const Attenuation& constants) {
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    return plan.addTexture({.name = "attenuation",
                            .desc = {.width = kAttenuationSide,
                                     .height = kAttenuationSide,
                                     .format = device::TextureFormat::luminance8,
                                     .filter = device::TextureFilter::linear},
                            .key = combineKeys(bits(constants.scale), bits(constants.bias)),
                            .pixels = [constants] {
                              return std::make_shared<const std::vector<std::uint8_t>>(
                                  attenuationTable(constants));
                            }});
  }
};
}  // namespace

std::unique_ptr<Technique> makeShadowWidth() {
  return std::make_unique<ShadowWidth>();
}

}  // namespace halfshadow::techniques
