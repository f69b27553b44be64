// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges/wedges.hpp"

#include "techniques/core/light_rooms.hpp"
#include "techniques/parts/lists/own_receivers.hpp"
#include "techniques/parts/wedges/wedge_route.hpp"
#include "techniques/parts/wedges/wedge_shaders.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::ResourceId;

/// Receivers among the surfaces of one caster, which wedges of its silhouette do not shadow.
class OwnReceivers {
 public:
  explicit OwnReceivers(std::string tilesKey) : tilesKey_(std::move(tilesKey)) {}
  SettingInfo setting() const {
    return {tilesKey_,
            SettingType::integer,
            "128",
            1,
            kMaxTiles,
            {},
            "tiles of vertex lists along the longer side of what the shadows cover, seen from the light, for "
            "the surfaces of casters that are not convex"};
  }
  Result<ReceiverShading> addTo(Result<ReceiverShading> shading, const LightFrame& frame) {
    return withOwnReceivers(std::move(shading), frame, lists_[frame.lightIndex], tilesKey_,
                            {&outlines::kWholeLight, 1}, OwnSurfaces::hollow);
  }
  void contextLost() { lists_.clear(); }

 private:
  std::string tilesKey_;
  std::map<int, LightLists> lists_;
};

WedgeGroup castersWhere(const outlines::WedgePieces& pieces, auto predicate) {
  WedgeGroup group;
  for (std::uint32_t i = 0; i < pieces.casters.size(); ++i) {
    if (!predicate(pieces.casters[i])) continue;
    if (!group.empty() && group.back().first + group.back().count == i) {
      ++group.back().count;
    } else {
      group.push_back({i, 1});
    }
  }
  return group;
}

/// Casters that are one piece, which need no sum, then the batches of the others.
std::vector<WedgeGroup> wholeThenBatches(const outlines::WedgePieces& pieces) {
  std::vector<WedgeGroup> groups;
  groups.push_back(
      castersWhere(pieces, [](const outlines::WedgeCaster& caster) { return caster.pieceCount == 1; }));
  for (std::uint32_t batch = 0; batch < pieces.batchCount; ++batch) {
    groups.push_back(castersWhere(pieces, [batch](const outlines::WedgeCaster& caster) {
      return caster.pieceCount > 1 && caster.batch == batch;
    }));
  }
  return groups;
}

class AdditiveWedges final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges",
        .paper = "Akenine-Moller, Assarsson 2002; Lengyel 2005; Forest et al. 2006, section 4.2",
        .summary = "the light's share that each silhouette covers, exactly per caster, summed",
        .guarantees = "exact for one convex caster seen from the light's centre; sums never clamp part-way",
        .knownFailures =
            "too dark where penumbrae of several casters overlap; silhouettes are those of the "
            "light's centre; on a caster that is not convex, layers of it that overlap within a quadrant add "
            "up"};
    return info;
  }
  std::optional<StandIn> standIn(const LightScene& frame) const override { return standInForRooms(frame); }
  std::vector<SettingInfo> settings() const override {
    return {routeSetting("wedges.route"), own_.setting()};
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return wedgeShaders(); }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    return own_.addTo(routes_.declareSums(frame, frame.settings.choice("wedges.route")), frame);
  }
  void contextLost() override {
    routes_.contextLost();
    own_.contextLost();
  }

 private:
  WedgeRoutes routes_;
  OwnReceivers own_{"wedges.tiles"};
};

class ProbabilisticWedges final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges-probabilistic",
        .paper = "Assarsson, Dougherty, Mounier, Akenine-Moller 2003",
        .summary = "wedges per caster, multiplied as if casters were independent",
        .guarantees = "exact where one convex caster shadows a receiver; never darker than black",
        .knownFailures =
            "too light where casters side by side cover different parts of the light; silhouettes "
            "are those of the light's centre; on a caster that is not convex, layers of it that overlap "
            "within a quadrant add up"};
    return info;
  }
  std::optional<StandIn> standIn(const LightScene& frame) const override { return standInForRooms(frame); }
  std::vector<SettingInfo> settings() const override {
    return {routeSetting("wedges-probabilistic.route"), own_.setting()};
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return wedgeShaders(); }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    auto route = routes_.choose(frame, frame.settings.choice("wedges-probabilistic.route"), wholeThenBatches);
    if (!route) return route.error();
    const WedgeVolumes& volumes = route->volumes();
    const ResourceId visibility = screenImage(frame, "wedge visibility");
    const GroupTarget whole{
        .color = visibility, .clear = volumes.lightEnclosed ? 0.0f : 1.0f, .mix = WedgeMix::multiply};
    if (Status s = route->declareGroup(frame, 0, "wedges of whole casters", whole, {}); !s) return s.error();
    if (volumes.pieces.batchCount > 0 && !volumes.lightEnclosed) {
      const ResourceId sums = screenImage(frame, "wedge sums");
      for (std::uint32_t batch = 0; batch < volumes.pieces.batchCount; ++batch) {
        const char* again = batch > 0 ? "casters of different batches may shadow the same receiver" : "";
        if (Status s = route->declareGroup(frame, batch + 1, "wedges of batch " + std::to_string(batch),
                                           {.color = sums, .steps = kStepsOfOne}, again);
            !s) {
          return s.error();
        }
        if (Status s = declareMerge(frame, volumes, batch, sums, visibility); !s) return s.error();
      }
    }
    return own_.addTo(screenShading(frame, visibility, 0.0f), frame);
  }
  void contextLost() override {
    routes_.contextLost();
    own_.contextLost();
  }

 private:
  /// What the batch's casters can shadow on the screen.
  static std::vector<gl::Rect> touched(const LightFrame& frame, const WedgeVolumes& volumes,
                                       std::uint32_t batch) {
    const View& view = frame.screen;
    const glm::dmat4 clipFromLight = view.clipFromWorld * outlines::worldFromLight(volumes.plane);
    std::vector<gl::Rect> rects;
    for (const outlines::WedgeCaster& caster : volumes.pieces.casters) {
      if (caster.pieceCount < 2 || caster.batch != batch) continue;
      const auto corners = outlines::volumeHull(caster.extent, caster.extent.nearest, volumes.end());
      if (const auto rect = outlines::screenBounds(corners, clipFromLight, view.width, view.height))
        rects.push_back(*rect);
    }
    return outlines::disjointRects(std::move(rects));
  }

  static Status declareMerge(const LightFrame& frame, const WedgeVolumes& volumes, std::uint32_t batch,
                             ResourceId sums, ResourceId visibility) {
    auto merge = frame.programs.get({"screen/fullscreen.vert", "wedge/wedge_merge.frag", {}});
    if (!merge) return merge.error();
    framegraph::PassDesc multiply{
        .name = wedgePassName(frame, "visibility of batch " + std::to_string(batch)),
        .stage = framegraph::PassStage::receiverPrepass,
        .reads = {sums},
        .writes = {
            {.resource = visibility, .point = AttachmentPoint::color, .initial = InitialContent::keep}}};
    multiply.rebindReason = "one batch at a time is added up; all of them would not fit in memory";
    multiply.execute = [program = *merge, sums,
                        rects = touched(frame, volumes, batch)](framegraph::PassContext& context) {
      gl::Encoder& encoder = context.encoder;
      encoder.useProgram(*program);
      program->set(encoder.context(), "u_wedgeSteps", glm::vec4(kStepsOfOne, 0, 0, 0));
      const gl::TextureBinding binding{program->samplerUnit("u_sums"), &context.texture(sums)};
      encoder.bindTextures({&binding, 1});
      for (const gl::Rect& rect : rects) encoder.drawFullscreen({.blend = kMultiply, .scissor = rect});
    };
    frame.graph.addPass(std::move(multiply));
    return {};
  }

  WedgeRoutes routes_;
  OwnReceivers own_{"wedges-probabilistic.tiles"};
};
}  // namespace

std::unique_ptr<Technique> makeWedges() {
  return std::make_unique<AdditiveWedges>();
}
std::unique_ptr<Technique> makeWedgesProbabilistic() {
  return std::make_unique<ProbabilisticWedges>();
}

}  // namespace halfshadow::techniques
