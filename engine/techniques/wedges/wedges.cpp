// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges/wedges.hpp"

#include "techniques/wedge_volumes/wedge_passes.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::ResourceId;

/// Shared by both: wedges that live on between frames.
class WedgeTechnique : public Technique {
 public:
  void contextLost() override { cache_.contextLost(); }

 protected:
  Result<Wedges> wedgesOf(const LightFrame& frame) {
    auto volumes = cache_.update(frame);
    if (!volumes) return volumes.error();
    auto depth = declareReceiverDepth(frame);
    if (!depth) return depth.error();
    return Wedges{*volumes, *depth};
  }

 private:
  WedgeVolumeCache cache_;
};

class AdditiveWedges final : public WedgeTechnique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges",
        .paper = "Akenine-Moller, Assarsson 2002; Lengyel 2005; Forest et al. 2006, section 4.2",
        .summary = "the light's share that each silhouette covers, exactly per caster, summed",
        .guarantees = "exact for one convex caster seen from the light's centre; sums never clamp part-way",
        .knownFailures =
            "too dark where penumbrae of several casters overlap; silhouettes are those of the "
            "light's centre; a caster's shadow on itself is unreliable unless it is convex"};
    return info;
  }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    auto wedges = wedgesOf(frame);
    if (!wedges) return wedges.error();
    return declareAdditiveWedges(frame, *wedges);
  }
};

class ProbabilisticWedges final : public WedgeTechnique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges-probabilistic",
        .paper = "Assarsson, Dougherty, Mounier, Akenine-Moller 2003",
        .summary = "wedges per caster, multiplied as if casters were independent",
        .guarantees = "exact where one convex caster shadows a receiver; never darker than black",
        .knownFailures =
            "too light where casters side by side cover different parts of the light; silhouettes "
            "are those of the light's centre; a caster's shadow on itself is unreliable unless it is convex"};
    return info;
  }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    auto wedges = wedgesOf(frame);
    if (!wedges) return wedges.error();
    const ResourceId visibility = screenImage(frame, "wedge visibility");
    if (Status s = declareWholeCasters(frame, *wedges, visibility); !s) return s.error();
    if (wedges->volumes->pieces.batchCount > 0) {
      const ResourceId sums = screenImage(frame, "wedge sums");
      for (std::uint32_t batch = 0; batch < wedges->volumes->pieces.batchCount; ++batch) {
        if (Status s = declareBatch(frame, *wedges, batch, sums, visibility); !s) return s.error();
      }
    }
    return screenShading(visibility, 0.0f);
  }

 private:
  static std::vector<CasterRange> castersWhere(const WedgePieces& pieces, auto predicate) {
    std::vector<CasterRange> ranges;
    for (std::uint32_t i = 0; i < pieces.casters.size(); ++i) {
      if (!predicate(pieces.casters[i])) continue;
      if (!ranges.empty() && ranges.back().first + ranges.back().count == i) {
        ++ranges.back().count;
      } else {
        ranges.push_back({i, 1});
      }
    }
    return ranges;
  }

  /// Casters that are one piece need no sum: blending multiplies them.
  static Status declareWholeCasters(const LightFrame& frame, const Wedges& wedges, ResourceId visibility) {
    auto programs = piecePrograms(frame, {"HS_WEDGE_MULTIPLY"});
    if (!programs) return programs.error();
    framegraph::PassDesc pass{.name = wedgePassName(frame, "wedges of whole casters"),
                              .stage = framegraph::PassStage::receiverPrepass,
                              .reads = {wedges.depth.packed},
                              .writes = wedgeTargets(visibility, wedges.depth, InitialContent::clear,
                                                     wedges.volumes->lightEnclosed ? 0.0f : 1.0f)};
    pass.execute = [programs = *programs, wedges, &view = frame.view,
                    casters = castersWhere(wedges.volumes->pieces, [](const WedgeCaster& caster) {
                      return caster.pieceCount == 1;
                    })](framegraph::PassContext& context) {
      addVolumes(context, programs, wedges, view, casters, kMultiply, kStepsOfOne);
    };
    frame.graph.addPass(std::move(pass));
    return {};
  }

  static Status declareBatch(const LightFrame& frame, const Wedges& wedges, std::uint32_t batch,
                             ResourceId sums, ResourceId visibility) {
    auto programs = piecePrograms(frame, {});
    if (!programs) return programs.error();
    auto merge = frame.programs.get({"fullscreen.vert", "wedge_merge.frag", {}});
    if (!merge) return merge.error();
    const std::string number = std::to_string(batch);
    framegraph::PassDesc add{.name = wedgePassName(frame, "wedges of batch " + number),
                             .stage = framegraph::PassStage::receiverPrepass,
                             .reads = {wedges.depth.packed},
                             .writes = wedgeTargets(sums, wedges.depth, InitialContent::clear, 0.0f)};
    if (batch > 0) add.rebindReason = "casters of different batches may shadow the same receiver";
    add.execute = [programs = *programs, wedges, &view = frame.view,
                   casters = castersWhere(wedges.volumes->pieces, [batch](const WedgeCaster& caster) {
                     return caster.pieceCount > 1 && caster.batch == batch;
                   })](framegraph::PassContext& context) {
      addVolumes(context, programs, wedges, view, casters, kAdd, kStepsOfOne);
    };
    frame.graph.addPass(std::move(add));

    framegraph::PassDesc multiply{.name = wedgePassName(frame, "visibility of batch " + number),
                                  .stage = framegraph::PassStage::receiverPrepass,
                                  .reads = {sums}};
    multiply.writes = {
        {.resource = visibility, .point = AttachmentPoint::color, .initial = InitialContent::keep}};
    multiply.rebindReason = "one batch at a time is added up; all of them would not fit in memory";
    multiply.execute = [program = *merge, sums](framegraph::PassContext& context) {
      gl::Encoder& encoder = context.encoder;
      encoder.useProgram(*program);
      program->set(encoder.context(), "u_wedgeSteps", glm::vec4(kStepsOfOne, 0, 0, 0));
      const gl::TextureBinding binding{program->samplerUnit("u_sums"), &context.texture(sums)};
      encoder.bindTextures({&binding, 1});
      encoder.drawFullscreen({.blend = kMultiply});
    };
    frame.graph.addPass(std::move(multiply));
    return {};
  }
};
}  // namespace

std::unique_ptr<Technique> makeWedges() {
  return std::make_unique<AdditiveWedges>();
}
std::unique_ptr<Technique> makeWedgesProbabilistic() {
  return std::make_unique<ProbabilisticWedges>();
}

}  // namespace halfshadow::techniques
