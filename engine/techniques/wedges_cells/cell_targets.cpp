// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges_cells/cell_targets.hpp"

#include "techniques/parts/wedges/wedge_passes.hpp"

namespace halfshadow::techniques {
namespace {
/// A target and the draws into it.
struct CellTarget {
  framegraph::ResourceId image;
  struct Draw {
    std::uint32_t subLight = 0;
    std::array<bool, 4> channels{true, true, true, true};
  };
  std::vector<Draw> draws;
  bool upper = false;  ///< of eight cells, the upper four
};

std::vector<CellTarget> targetsOf(int cells) {
  std::vector<CellTarget> targets;
  if (cells == 4) {
    targets.emplace_back();
    for (std::uint32_t s = 0; s < outlines::kSubLights; ++s) {
      CellTarget::Draw draw{.subLight = s, .channels = {}};
      draw.channels[s] = true;
      targets[0].draws.push_back(draw);
    }
    return targets;
  }
  for (std::uint32_t s = 0; s < outlines::kSubLights; ++s) {
    for (int half = 0; half < cells / 16; ++half) {
      targets.push_back({.image = {}, .draws = {{.subLight = s}}, .upper = half == 1});
    }
  }
  return targets;
}

Status declareTarget(const LightFrame& frame, const CasterDraws& draws, const ReceiverDepth& depth,
                     const CellTarget& target, int cells, CellProduct product, const std::string& name) {
  std::vector<std::string> defines = {"HS_CELLS " + std::to_string(cells)};
  if (target.upper) defines.push_back("HS_UPPER_CELLS");
  if (product == CellProduct::fetched) defines.push_back("HS_USE_FETCH");
  auto programs = casterPrograms(frame, "list/caster_cells.frag", defines);
  if (!programs) return programs.error();
  framegraph::ClearValue lit;
  for (const CellTarget::Draw& draw : target.draws) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (draw.channels[c]) lit.color[c] = draws.lightEnclosed(draw.subLight) ? 0.0f : 1.0f;
    }
  }
  framegraph::PassDesc pass{.name = wedgePassName(frame, name),
                            .stage = framegraph::PassStage::receiverPrepass,
                            .reads = {depth.packed}};
  pass.writes = {{.resource = target.image,
                  .point = framegraph::AttachmentPoint::color,
                  .initial = framegraph::InitialContent::clear,
                  .clear = lit},
                 {.resource = depth.depthTest,
                  .point = framegraph::AttachmentPoint::depth,
                  .initial = framegraph::InitialContent::keep}};
  pass.execute = [programs = *programs, &draws, depth, &view = frame.screen, list = target.draws,
                  blend = product == CellProduct::blended ? kMultiply : gl::BlendState{}](
                     framegraph::PassContext& context) {
    for (const CellTarget::Draw& draw : list) {
      draws.draw(context, programs, depth, view,
                 {.subLight = draw.subLight, .blend = blend, .colorMask = draw.channels});
    }
  };
  frame.graph.addPass(std::move(pass));
  return {};
}

/// Eight targets and a base colour are more textures than a pass may read: their mean is taken first.
Result<framegraph::ResourceId> declareMean(const LightFrame& frame, std::span<const TextureRead> cells) {
  auto program = frame.programs.get({"screen/fullscreen.vert", "list/cell_mean.frag", {}});
  if (!program) return program.error();
  const framegraph::ResourceId mean = screenImage(frame, "mean of cells");
  framegraph::PassDesc pass{.name = wedgePassName(frame, "mean of cells"),
                            .stage = framegraph::PassStage::receiverPrepass};
  for (const TextureRead& target : cells) pass.reads.push_back(target.resource);
  pass.writes = {{.resource = mean,
                  .point = framegraph::AttachmentPoint::color,
                  .initial = framegraph::InitialContent::dontCare}};
  pass.execute = [program = *program,
                  cells = std::vector(cells.begin(), cells.end())](framegraph::PassContext& context) {
    context.encoder.useProgram(*program);
    std::vector<gl::TextureBinding> bindings;
    for (const TextureRead& target : cells) {
      bindings.push_back({program->samplerUnit(target.sampler), &context.texture(target.resource)});
    }
    context.encoder.bindTextures(bindings);
    context.encoder.drawFullscreen({});
  };
  frame.graph.addPass(std::move(pass));
  return mean;
}
}  // namespace

Result<ReceiverShading> declareCellTargets(const LightFrame& frame, CasterDraws& draws, int cells,
                                           CellProduct product) {
  static constexpr auto kQuarters = outlines::subLights();
  static constexpr std::array<gl::UniformKey, 8> kSamplers = {"u_cells0", "u_cells1", "u_cells2", "u_cells3",
                                                              "u_cells4", "u_cells5", "u_cells6", "u_cells7"};
  if (Status s = draws.update(frame, kQuarters, Batching::none); !s) return s.error();
  auto depth = declareReceiverDepth(frame, ReceiverAlpha::facets);
  if (!depth) return depth.error();
  std::vector<CellTarget> targets = targetsOf(cells);
  std::vector<TextureRead> textures;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const std::string name = "cells " + std::to_string(t);
    targets[t].image = screenImage(frame, name);
    if (Status s = declareTarget(frame, draws, *depth, targets[t], cells, product, name); !s) {
      return s.error();
    }
    textures.push_back({.sampler = kSamplers[t], .resource = targets[t].image});
  }
  if (targets.size() > 4) {
    auto mean = declareMean(frame, textures);
    if (!mean) return mean.error();
    textures = {{.sampler = kSamplers[0], .resource = *mean}};
  }
  ReceiverShading shading;
  shading.fragmentFile = "list/screen_cells.frag";
  shading.defines = {"HS_CELL_TARGETS " + std::to_string(textures.size()),
                     "HS_CELLS " + std::to_string(cells)};
  shading.forward = false;
  shading.mapFromWorld = heightFromWorld(frame);
  shading.textures = std::move(textures);
  return shading;
}

}  // namespace halfshadow::techniques
