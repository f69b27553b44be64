// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges_blended/vbuffer_targets.hpp"

#include <algorithm>

#include "techniques/parts/wedges/wedge_passes.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::ResourceId;

constexpr gl::BlendState kLargest{.enabled = true,
                                  .equation = gl::BlendEquation::max,
                                  .source = gl::BlendFactor::one,
                                  .destination = gl::BlendFactor::one};
using Reads = std::vector<TextureRead>;

/// Declares the passes of one light, batch by batch.
class VbufferPasses {
 public:
  VbufferPasses(const LightFrame& frame, const CasterDraws& draws, const ReceiverDepth& depth,
                const VbufferRequest& request)
      : frame_(frame), draws_(draws), depth_(depth), request_(request) {
    share_ = screenImage(frame, "vBuffer shares");
    if (draws.batchCount() < 2) return;
    both_ = screenImage(frame, "vBuffer overlap");
    for (int q = 0; q < 4; ++q) sides_[q] = screenImage(frame, "vBuffer sides " + std::to_string(q));
    if (request.merge == SideMerge::core) excess_ = screenImage(frame, "vBuffer excess of sides");
    if (!request.centres) return;
    // Two of each, read and written in turn.
    for (int axis = 0; axis < 2; ++axis) {
      for (int turn = 0; turn < (request.merge == SideMerge::fetch ? 1 : 2); ++turn) {
        centres_[axis][turn] =
            screenImage(frame, "vBuffer centres " + std::to_string(axis) + (turn ? " in turn" : ""));
      }
    }
  }
  ResourceId share() const { return share_; }

  Status declare() {
    const std::uint32_t batches = std::max(draws_.batchCount(), 1u);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
      if (batch > 0) {
        if (Status s = findOverlap(batch); !s) return s;
      }
      // Nothing is blended with the last batch. Centres are weighed by the shares before.
      const bool last = batch + 1 == batches;
      for (int axis = 0; axis < (request_.centres && !last ? 2 : 0); ++axis) {
        if (Status s = mergeCentres(batch, axis); !s) return s;
      }
      if (Status s = mergeShare(batch); !s) return s;
      for (int quadrant = 0; quadrant < (last ? 0 : 4); ++quadrant) {
        if (Status s = mergeSides(batch, quadrant); !s) return s;
      }
    }
    return {};
  }

 private:
  /// A pass of caster draws.
  struct Pass {
    std::string name;
    ResourceId target;
    std::uint32_t batch = 0;
    std::vector<std::string> defines;
    gl::BlendState blend;
    Reads reads;
    InitialContent initial = InitialContent::keep;  ///< the first batch clears
    float clear = 0.0f;
    ResourceId copied{};  ///< drawn into the target first
    /// Two draws, of two quadrants each, whose sides are sides 0 and 1: eight texture units hold no more.
    bool halves = false;
  };

  Reads sideReads() const {
    return {{.sampler = "u_sides0", .resource = sides_[0]},
            {.sampler = "u_sides1", .resource = sides_[1]},
            {.sampler = "u_sides2", .resource = sides_[2]},
            {.sampler = "u_sides3", .resource = sides_[3]},
            {.sampler = "u_share", .resource = share_}};
  }
  /// The centres that hold `batch`.
  ResourceId centres(int axis, std::uint32_t batch) const {
    return centres_[axis][request_.merge == SideMerge::fetch ? 0 : batch % 2];
  }

  Status findOverlap(std::uint32_t batch) {
    Pass pass{.name = "overlap",
              .target = both_,
              .batch = batch,
              .defines = {"HS_BLEND 0"},
              .blend = kAdd,
              .reads = sideReads(),
              .initial = InitialContent::clear};
    if (request_.centres) {
      pass.halves = true;
      pass.defines.push_back("HS_CENTRES");
      pass.reads.push_back({.sampler = "u_centreX", .resource = centres(0, batch - 1)});
      pass.reads.push_back({.sampler = "u_centreY", .resource = centres(1, batch - 1)});
    }
    return add(pass);
  }

  Status mergeShare(std::uint32_t batch) {
    Pass pass{.name = "shares",
              .target = share_,
              .batch = batch,
              .defines = {"HS_BLEND 1"},
              .blend = kAdd,
              .reads = {}};
    if (batch > 0) {
      pass.defines.push_back("HS_MERGED");
      pass.reads = {{.sampler = "u_both", .resource = both_}};
    }
    if (draws_.lightEnclosed(0)) pass.clear = 1.0f;
    return add(pass);
  }

  Status mergeCentres(std::uint32_t batch, int axis) {
    Pass pass{.name = "centres " + std::to_string(axis),
              .target = centres(axis, batch),
              .batch = batch,
              .defines = {"HS_BLEND " + std::to_string(3 + axis), "HS_CENTRES"},
              .blend = {},
              .reads = {},
              .clear = 0.5f};
    if (batch == 0) return add(pass);
    pass.defines.push_back("HS_MERGED");
    pass.reads = sideReads();
    pass.reads.push_back({.sampler = "u_both", .resource = both_});
    if (request_.merge == SideMerge::fetch) {
      pass.defines.push_back("HS_USE_FETCH");
      return add(pass);
    }
    pass.halves = true;
    pass.copied = centres(axis, batch - 1);
    pass.initial = InitialContent::dontCare;
    if (axis == 0) {
      pass.reads.push_back({.sampler = "u_centreX", .resource = pass.copied});
    } else {
      pass.reads.push_back({.sampler = "u_centreY", .resource = pass.copied});
    }
    return add(pass);
  }

  Status mergeSides(std::uint32_t batch, int quadrant) {
    const std::string name = "sides " + std::to_string(quadrant);
    std::vector<std::string> defines = {"HS_BLEND 2", "HS_QUADRANT " + std::to_string(quadrant)};
    if (request_.merge == SideMerge::fetch) defines.push_back("HS_USE_FETCH");
    // Casters of the first batch meet nothing: adding is uniting.
    const gl::BlendState blend = request_.merge == SideMerge::minmax ? kLargest
                                 : request_.merge == SideMerge::core ? kAdd
                                                                     : gl::BlendState{};
    Pass pass{.name = name,
              .target = sides_[quadrant],
              .batch = batch,
              .defines = defines,
              .blend = blend,
              .reads = {}};
    if (request_.merge != SideMerge::core || batch == 0) return add(pass);
    pass.name += " excess";
    pass.target = excess_;
    pass.defines.push_back("HS_MERGED");
    pass.reads = {{.sampler = "u_sides0", .resource = sides_[quadrant]}};
    pass.initial = InitialContent::clear;
    if (Status s = add(pass); !s) return s;
    return addExcess(name, sides_[quadrant], batch);
  }

  Status addExcess(const std::string& name, ResourceId target, std::uint32_t batch) {
    auto program = frame_.programs.get({"screen/fullscreen.vert", "list/vbuffer_add.frag", {}});
    if (!program) return program.error();
    framegraph::PassDesc pass = describe(name, target, batch);
    pass.reads = {excess_};
    pass.writes = {{.resource = target, .point = AttachmentPoint::color, .initial = InitialContent::keep}};
    pass.execute = [program = *program, excess = excess_](framegraph::PassContext& context) {
      drawImage(context, *program, excess, kAdd);
    };
    frame_.graph.addPass(std::move(pass));
    return {};
  }

  static void drawImage(framegraph::PassContext& context, gl::Program& program, ResourceId image,
                        const gl::BlendState& blend) {
    context.encoder.useProgram(program);
    const gl::TextureBinding binding{program.samplerUnit("u_source"), &context.texture(image)};
    context.encoder.bindTextures({&binding, 1});
    context.encoder.drawFullscreen({.blend = blend});
  }

  framegraph::PassDesc describe(const std::string& name, ResourceId target, std::uint32_t batch) const {
    return {.name = wedgePassName(frame_, name + " of batch " + std::to_string(batch)),
            .stage = framegraph::PassStage::receiverPrepass,
            .rebindReason = target == excess_ ? "one target serves the rectangles of all quadrants"
                            : batch > 0       ? "casters of different batches may shadow the same receiver"
                                              : ""};
  }

  /// Sides of the second half take the place of the first's.
  static Reads secondHalf(Reads reads, const ResourceId (&sides)[4]) {
    for (TextureRead& read : reads) {
      if (read.resource == sides[0])
        read.resource = sides[2];
      else if (read.resource == sides[1])
        read.resource = sides[3];
    }
    return reads;
  }

  Status add(Pass request) {
    if (request.halves) request.defines.push_back("HS_HALVES");
    framegraph::PassDesc pass = describe(request.name, request.target, request.batch);
    pass.reads = {depth_.packed};
    for (const TextureRead& read : request.reads) pass.reads.push_back(read.resource);
    framegraph::ClearValue clear;
    std::fill_n(clear.color, 4, request.clear);
    pass.writes = {
        {.resource = request.target,
         .point = AttachmentPoint::color,
         .initial = request.batch == 0 ? InitialContent::clear : request.initial,
         .clear = clear},
        {.resource = depth_.depthTest, .point = AttachmentPoint::depth, .initial = InitialContent::keep}};
    auto programs = casterPrograms(frame_, "list/caster_blend.frag", request.defines);
    if (!programs) return programs.error();
    gl::Program* copy = nullptr;
    if (request.copied.valid()) {
      auto linked = frame_.programs.get({"screen/fullscreen.vert", "list/vbuffer_add.frag", {}});
      if (!linked) return linked.error();
      copy = *linked;
    }
    pass.execute = [programs = *programs, copy, &draws = draws_, depth = depth_, &view = frame_.screen,
                    request, second = secondHalf(request.reads, sides_)](framegraph::PassContext& context) {
      if (copy) drawImage(context, *copy, request.copied, {});
      const auto draw = [&](const Reads& reads, const std::array<bool, 4>& quadrants) {
        const auto bind = [&](gl::Program& program) {
          for (const TextureRead& read : reads) {
            const gl::TextureBinding binding{program.samplerUnit(read.sampler),
                                             &context.texture(read.resource)};
            context.encoder.bindTextures({&binding, 1});
          }
        };
        draws.draw(context, programs, depth, view,
                   {.batch = request.batch, .blend = request.blend, .colorMask = quadrants, .prepare = bind});
      };
      if (!request.halves) return draw(request.reads, {true, true, true, true});
      draw(request.reads, {true, true, false, false});
      draw(second, {false, false, true, true});
    };
    frame_.graph.addPass(std::move(pass));
    return {};
  }

  const LightFrame& frame_;
  const CasterDraws& draws_;
  ReceiverDepth depth_;
  VbufferRequest request_;
  ResourceId share_, both_, excess_;
  ResourceId sides_[4], centres_[2][2];
};
}  // namespace

Result<ReceiverShading> declareVbufferTargets(const LightFrame& frame, CasterDraws& draws,
                                              const VbufferRequest& request) {
  if (Status s = draws.update(frame, {&outlines::kWholeLight, 1}, Batching::disjoint); !s) return s.error();
  auto depth = declareReceiverDepth(frame, ReceiverAlpha::facets);
  if (!depth) return depth.error();
  VbufferPasses passes(frame, draws, *depth, request);
  if (Status s = passes.declare(); !s) return s.error();
  return shareShading(frame, passes.share());
}

}  // namespace halfshadow::techniques
