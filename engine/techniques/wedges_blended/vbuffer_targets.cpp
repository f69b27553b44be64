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

constexpr device::BlendState kLargest{.enabled = true,
                                      .equation = device::BlendEquation::max,
                                      .source = device::BlendFactor::one,
                                      .destination = device::BlendFactor::one};
using Reads = std::vector<TextureRead>;

/// Plans the passes of one light, batch by batch.
class VbufferPasses {
 public:
  VbufferPasses(const LightScene& scene, PassPlan& plan, const CasterDraws& draws, const ReceiverDepth& depth,
                const VbufferRequest& request)
      : scene_(scene), plan_(plan), draws_(draws), depth_(depth), request_(request) {
    share_ = screenImage(scene, plan, "vBuffer shares");
    if (draws.batchCount() < 2) return;
    both_ = screenImage(scene, plan, "vBuffer overlap");
    for (int q = 0; q < 4; ++q) sides_[q] = screenImage(scene, plan, "vBuffer sides " + std::to_string(q));
    if (request.merge == SideMerge::core) excess_ = screenImage(scene, plan, "vBuffer excess of sides");
    if (!request.centres) return;
    // Two of each, read and written in turn.
    for (int axis = 0; axis < 2; ++axis) {
      for (int turn = 0; turn < (request.merge == SideMerge::fetch ? 1 : 2); ++turn) {
        centres_[axis][turn] =
            screenImage(scene, plan, "vBuffer centres " + std::to_string(axis) + (turn ? " in turn" : ""));
      }
    }
  }
  ResourceId share() const { return share_; }

  void addPasses() {
    const std::uint32_t batches = std::max(draws_.batchCount(), 1u);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
      if (batch > 0) findOverlap(batch);
      // Nothing is blended with the last batch. Centres are weighed by the shares before.
      const bool last = batch + 1 == batches;
      for (int axis = 0; axis < (request_.centres && !last ? 2 : 0); ++axis) mergeCentres(batch, axis);
      mergeShare(batch);
      for (int quadrant = 0; quadrant < (last ? 0 : 4); ++quadrant) mergeSides(batch, quadrant);
    }
  }

 private:
  /// A pass of caster draws.
  struct Pass {
    std::string name;
    ResourceId target;
    std::uint32_t batch = 0;
    std::vector<std::string> defines;
    device::BlendState blend;
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

  void findOverlap(std::uint32_t batch) {
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
    add(pass);
  }

  void mergeShare(std::uint32_t batch) {
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
    add(pass);
  }

  void mergeCentres(std::uint32_t batch, int axis) {
    Pass pass{.name = "centres " + std::to_string(axis),
              .target = centres(axis, batch),
              .batch = batch,
              .defines = {"HS_BLEND " + std::to_string(3 + axis), "HS_CENTRES"},
              .blend = {},
              .reads = {},
              .clear = 0.5f};
    if (batch == 0) {
      add(pass);
      return;
    }
    pass.defines.push_back("HS_MERGED");
    pass.reads = sideReads();
    pass.reads.push_back({.sampler = "u_both", .resource = both_});
    if (request_.merge == SideMerge::fetch) {
      pass.defines.push_back("HS_USE_FETCH");
      add(pass);
      return;
    }
    pass.halves = true;
    pass.copied = centres(axis, batch - 1);
    pass.initial = InitialContent::dontCare;
    if (axis == 0) {
      pass.reads.push_back({.sampler = "u_centreX", .resource = pass.copied});
    } else {
      pass.reads.push_back({.sampler = "u_centreY", .resource = pass.copied});
    }
    add(pass);
  }

  void mergeSides(std::uint32_t batch, int quadrant) {
    const std::string name = "sides " + std::to_string(quadrant);
    std::vector<std::string> defines = {"HS_BLEND 2", "HS_QUADRANT " + std::to_string(quadrant)};
    if (request_.merge == SideMerge::fetch) defines.push_back("HS_USE_FETCH");
    // Casters of the first batch meet nothing: adding is uniting.
    const device::BlendState blend = request_.merge == SideMerge::minmax ? kLargest
                                     : request_.merge == SideMerge::core ? kAdd
                                                                         : device::BlendState{};
    Pass pass{.name = name,
              .target = sides_[quadrant],
              .batch = batch,
              .defines = defines,
              .blend = blend,
              .reads = {}};
    if (request_.merge != SideMerge::core || batch == 0) {
      add(pass);
      return;
    }
    pass.name += " excess";
    pass.target = excess_;
    pass.defines.push_back("HS_MERGED");
    pass.reads = {{.sampler = "u_sides0", .resource = sides_[quadrant]}};
    pass.initial = InitialContent::clear;
    add(pass);
    addExcess(name, sides_[quadrant], batch);
  }

  void addExcess(const std::string& name, ResourceId target, std::uint32_t batch) {
    PlannedPass pass = describe(name, target, batch);
    pass.writes = {{.resource = target, .point = AttachmentPoint::color, .initial = InitialContent::keep}};
    pass.draws.push_back(imageDraw(excess_, kAdd));
    plan_.passes.push_back(std::move(pass));
  }

  PlannedDraw imageDraw(ResourceId image, const device::BlendState& blend) {
    PlannedDraw draw{.program = plan_.addProgram({"screen/fullscreen.vert", "list/vbuffer_add.frag", {}}),
                     .textures = {{.sampler = "u_source", .resource = image}}};
    draw.state.blend = blend;
    return draw;
  }

  PlannedPass describe(const std::string& name, ResourceId target, std::uint32_t batch) const {
    return {.name = scene_.name + " " + name + " of batch " + std::to_string(batch),
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

  void add(Pass request) {
    if (request.halves) request.defines.push_back("HS_HALVES");
    PlannedPass pass = describe(request.name, request.target, request.batch);
    framegraph::ClearValue clear;
    std::fill_n(clear.color, 4, request.clear);
    pass.writes = {
        {.resource = request.target,
         .point = AttachmentPoint::color,
         .initial = request.batch == 0 ? InitialContent::clear : request.initial,
         .clear = clear},
        {.resource = depth_.depthTest, .point = AttachmentPoint::depth, .initial = InitialContent::keep}};
    if (request.copied.valid()) pass.draws.push_back(imageDraw(request.copied, {}));
    const auto draw = [&](const Reads& reads, const std::array<bool, 4>& quadrants) {
      draws_.addDraws(scene_, plan_, pass, depth_,
                      {.batch = request.batch,
                       .fragmentFile = "list/caster_blend.frag",
                       .defines = request.defines,
                       .blend = request.blend,
                       .colorMask = quadrants,
                       .textures = reads});
    };
    if (!request.halves) {
      draw(request.reads, {true, true, true, true});
    } else {
      draw(request.reads, {true, true, false, false});
      draw(secondHalf(request.reads, sides_), {false, false, true, true});
    }
    plan_.passes.push_back(std::move(pass));
  }

  const LightScene& scene_;
  PassPlan& plan_;
  const CasterDraws& draws_;
  ReceiverDepth depth_;
  VbufferRequest request_;
  ResourceId share_, both_, excess_;
  ResourceId sides_[4], centres_[2][2];
};
}  // namespace

Status planVbufferTargets(const LightScene& scene, PassPlan& plan, LightLoops& loops, CasterDraws& draws,
                          const VbufferRequest& request) {
  if (Status s = draws.update(scene, plan, loops, {&outlines::kWholeLight, 1}, Batching::disjoint); !s)
    return s;
  const ReceiverDepth depth = planReceiverDepth(scene, plan, ReceiverAlpha::facets);
  VbufferPasses passes(scene, plan, draws, depth, request);
  passes.addPasses();
  plan.shading = shareShading(scene, passes.share());
  return {};
}

}  // namespace halfshadow::techniques
