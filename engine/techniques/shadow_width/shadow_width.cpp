// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_width/shadow_width.hpp"

#include <algorithm>
#include <map>

#include "techniques/core/caster_spread.hpp"
#include "techniques/light_blocks/light_blocks.hpp"
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
            "receiver",
        .guarantees =
            "two fetches per receiver whatever the scene, the light's size and the penumbra's width",
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
         "on",
         0,
         0,
         {"off", "on"},
         "correct the straight edge's profile by the occupied share of the kernel (signed)"},
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
  std::optional<StandIn> standIn(const LightFrame& frame) const override {
    // A light without size has no widths to get wrong; the paper's widths are its own.
    if (frame.fit.halfSize == glm::dvec2(0.0) || frame.settings.choice("shadow-width.preset") == "paper")
      return std::nullopt;
    if (auto spread = sampledWhereCastersSpread(frame, kWidestSpread)) return spread;
    if (!hasCastersBehindReceivers(frame)) return std::nullopt;
    return StandIn{
        "sampled",
        "caster-behind-receiver: a caster lies behind a receiver that casts nothing, and silhouettes "
        "seen from the light do not tell that it shadows others only"};
  }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    return frame.settings.choice("shadow-width.preset") == "paper" ? declarePaper(frame)
                                                                   : declareSigned(frame);
  }
  void contextLost() override { attenuationMaps_.clear(); }

 private:
  static Result<ReceiverShading> declareSigned(const LightFrame& frame) {
    auto depth = declareLightDepth(frame, MapContent::casters);
    if (!depth) return depth.error();
    ReceiverShading shading = mapReceiverShading(frame, *depth, "shadow_width.frag");
    if (frame.fit.halfSize == glm::dvec2(0.0)) {
      shading.defines.push_back("HS_POINT_LIGHT");
      return shading;
    }
    auto map = declareSignedWidth(frame, *depth);
    if (!map) return map.error();
    shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
    addSignedWidth(frame, shading, *depth, *map);
    if (frame.settings.choice("shadow-width.corners") == "on") {
      shading.defines.push_back("HS_CORNERS");
      addWidthBoxes(shading, *map);
    }
    return shading;
  }

  Result<ReceiverShading> declarePaper(const LightFrame& frame) {
    const bool backFaces = frame.settings.choice("shadow-width.faces") == "back";
    auto depth = declareLightDepth(frame, backFaces ? MapContent::castersFarthest : MapContent::casters);
    if (!depth) return depth.error();
    const int neighbours = frame.settings.choice("shadow-width.neighbours") == "3" ? 3 : 6;
    const WidthBuild build =
        frame.settings.choice("shadow-width.build") == "cpu" ? WidthBuild::cpu : WidthBuild::gpu;
    const std::vector<WidthStep> steps = widthSteps(neighbours, frame.settings.integer("shadow-width.start"));
    auto width = declarePaperWidth(frame, *depth, steps, build);
    if (!width) return width.error();

    ReceiverShading shading = mapReceiverShading(frame, *depth, "shadow_width.frag");
    shading.defines.push_back("HS_PAPER");
    shading.textures.push_back({.sampler = "u_widthMap", .resource = width->map});
    Attenuation constants{.scale = frame.settings.real("shadow-width.scale"),
                          .bias = frame.settings.real("shadow-width.offset")};
    // Shadow depth 1 is the distance from the nearest caster to the farthest receiver of the map.
    const MapSpace& space = depth->space;
    const double farthest = std::max(frame.receiverFarDistance, frame.fit.farDistance);
    const double range = std::max(farthest - space.nearDistance, 1e-6 * farthest);
    if (constants.scale == 0.0)
      constants.scale = scaleOfLight(frame, space, range, constants.bias, steps.front().differenceBytes);
    if (frame.settings.choice("shadow-width.attenuation") == "texture") {
      auto table = attenuationMap(frame, constants);
      if (!table) return table.error();
      shading.defines.push_back("HS_ATTENUATION_TEXTURE");
      shading.textures.push_back({.sampler = "u_attenuationMap", .texture = *table});
    }
    const glm::vec4 uniform(space.nearDistance / range, constants.scale, 1.0 + constants.bias,
                            space.depthUnit);
    shading.setUniforms = [uniform, inner = std::move(shading.setUniforms)](gl::Program& program,
                                                                            gl::Context& context) {
      inner(program, context);
      program.set(context, "u_attenuation", uniform);
    };
    return shading;
  }

  /// c_scale with which the light is gone where the inner half of its penumbra ends, for occluders at the
  /// farthest caster and receivers at the map's end.
  static double scaleOfLight(const LightFrame& frame, const MapSpace& space, double range, double bias,
                             int differenceBytes) {
    const double kernelTexels =
        std::min(space.kernelTexelsPerDepth.x, space.kernelTexelsPerDepth.y) * space.nearDistance;
    const double farthest = std::max(frame.receiverFarDistance, frame.fit.farDistance);
    const double widthPerDepth =
        0.5 * kernelTexels * range / (frame.fit.farDistance * farthest) * differenceBytes / 255.0;
    // A light without size leaves a hard edge: the bound keeps c_scale a number of fp16. The largest width
    // that the map can hold, 1, is dark at every depth, else a coarse start difference would leave no umbra.
    return (1.0 + bias) * std::clamp(1.0 / std::max(widthPerDepth, 1e-9), 1.0, 1024.0);
  }

  /// Each light has its own: constants follow from its size and place.
  struct AttenuationMap {
    gl::Texture texture;
    Attenuation constants;
  };

  /// Valid until the context is lost.
  Result<const gl::Texture*> attenuationMap(const LightFrame& frame, const Attenuation& constants) {
    AttenuationMap& map = attenuationMaps_[frame.lightIndex];
    const bool same = constants.scale == map.constants.scale && constants.bias == map.constants.bias;
    if (!map.texture || !same) {
      const std::vector<std::uint8_t> table = attenuationTable(constants);
      auto made = gl::Texture::create(frame.context,
                                      {.width = kAttenuationSide,
                                       .height = kAttenuationSide,
                                       .format = gl::TextureFormat::luminance8,
                                       .filter = gl::TextureFilter::linear},
                                      table.data());
      if (!made) return made.error();
      map = {std::move(made).value(), constants};
    }
    return static_cast<const gl::Texture*>(&map.texture);
  }

  std::map<int, AttenuationMap> attenuationMaps_;
};
}  // namespace

std::unique_ptr<Technique> makeShadowWidth() {
  return std::make_unique<ShadowWidth>();
}

}  // namespace halfshadow::techniques
