// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges/wedges.hpp"

#include "techniques/wedge_volumes/wedge_volumes.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::Attachment;
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::ResourceId;

/// Steps of full coverage. Sums over all casters hold up to 8 full coverings, those of one caster 4, each
/// way; a piece is rounded to a step.
constexpr float kStepsOfAll = 512.0f, kStepsOfOne = 1024.0f;

ReceiverShading screenShading(ResourceId image, float steps) {
  ReceiverShading shading;
  shading.fragmentFile = "screen_wedges.frag";
  shading.forward = false;
  shading.textures = {{.sampler = "u_wedges", .resource = image}};
  if (steps > 0.0f) shading.defines.push_back("HS_WEDGE_SUMS");
  shading.setUniforms = [steps](gl::Program& program, gl::Context& context) {
    program.set(context, "u_wedgeSteps", glm::vec4(steps, 0, 0, 0));
  };
  return shading;
}

ResourceId screenImage(const LightFrame& frame, const std::string& name) {
  return frame.graph.addResource({.name = "light " + std::to_string(frame.lightIndex) + " " + name,
                                  .width = frame.view.width,
                                  .height = frame.view.height});
}

std::vector<Attachment> targets(ResourceId color, const ReceiverDepth& depth, InitialContent initial,
                                float clear) {
  return {{.resource = color,
           .point = AttachmentPoint::color,
           .initial = initial,
           .clear = {.color = {clear, clear, clear, clear}}},
          {.resource = depth.depthTest, .point = AttachmentPoint::depth, .initial = InitialContent::keep}};
}

constexpr gl::BlendState kAdd{
    .enabled = true, .source = gl::BlendFactor::one, .destination = gl::BlendFactor::one};
constexpr gl::BlendState kMultiply{
    .enabled = true, .source = gl::BlendFactor::zero, .destination = gl::BlendFactor::srcColor};

/// What the passes of one light share.
struct Wedges {
  const WedgeVolumes* volumes = nullptr;
  ReceiverDepth depth;
};
struct PiecePrograms {
  gl::Program* beside = nullptr;
  gl::Program* beyond = nullptr;
};
Result<PiecePrograms> piecePrograms(const LightFrame& frame, std::vector<std::string> defines) {
  PiecePrograms programs;
  for (gl::Program** program : {&programs.beyond, &programs.beside}) {
    auto linked = frame.programs.get({"wedge_volume.vert", "wedge_piece.frag", defines});
    if (!linked) return linked.error();
    *program = *linked;
    defines.push_back("HS_WEDGE_CLIP");
  }
  return programs;
}

void addVolumes(framegraph::PassContext& context, const PiecePrograms& programs, const Wedges& wedges,
                const View& view, std::span<const CasterRange> casters, const gl::BlendState& blend,
                float steps) {
  for (const WedgePart part : {WedgePart::beyond, WedgePart::beside}) {
    gl::Program& program = part == WedgePart::beyond ? *programs.beyond : *programs.beside;
    context.encoder.useProgram(program);
    program.set(context.encoder.context(), "u_wedgeSteps", glm::vec4(steps, 0, 0, 0));
    drawWedgeVolumes(context, program, *wedges.volumes, wedges.depth, view, casters, part, {.blend = blend});
  }
}

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
  static std::string passName(const LightFrame& frame, const std::string& what) {
    return "light " + std::to_string(frame.lightIndex) + " " + what;
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
            "light's centre"};
    return info;
  }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    auto wedges = wedgesOf(frame);
    if (!wedges) return wedges.error();
    auto programs = piecePrograms(frame, {});
    if (!programs) return programs.error();
    const ResourceId sums = screenImage(frame, "wedge sums");
    framegraph::PassDesc pass{.name = passName(frame, "wedges"),
                              .stage = framegraph::PassStage::receiverPrepass,
                              .reads = {wedges->depth.packed},
                              .writes = targets(sums, wedges->depth, InitialContent::clear, 0.0f)};
    pass.execute = [programs = *programs, wedges = *wedges,
                    &view = frame.view](framegraph::PassContext& context) {
      const CasterRange all{0, static_cast<std::uint32_t>(wedges.volumes->pieces.casters.size())};
      addVolumes(context, programs, wedges, view, {&all, 1}, kAdd, kStepsOfAll);
    };
    frame.graph.addPass(std::move(pass));
    return screenShading(sums, kStepsOfAll);
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
            "are those of the light's centre"};
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
    framegraph::PassDesc pass{.name = passName(frame, "wedges of whole casters"),
                              .stage = framegraph::PassStage::receiverPrepass,
                              .reads = {wedges.depth.packed},
                              .writes = targets(visibility, wedges.depth, InitialContent::clear, 1.0f)};
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
    framegraph::PassDesc add{.name = passName(frame, "wedges of batch " + number),
                             .stage = framegraph::PassStage::receiverPrepass,
                             .reads = {wedges.depth.packed},
                             .writes = targets(sums, wedges.depth, InitialContent::clear, 0.0f)};
    if (batch > 0) add.rebindReason = "casters of different batches may shadow the same receiver";
    add.execute = [programs = *programs, wedges, &view = frame.view,
                   casters = castersWhere(wedges.volumes->pieces, [batch](const WedgeCaster& caster) {
                     return caster.pieceCount > 1 && caster.batch == batch;
                   })](framegraph::PassContext& context) {
      addVolumes(context, programs, wedges, view, casters, kAdd, kStepsOfOne);
    };
    frame.graph.addPass(std::move(add));

    framegraph::PassDesc multiply{.name = passName(frame, "visibility of batch " + number),
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
