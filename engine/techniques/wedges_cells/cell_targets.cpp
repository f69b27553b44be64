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

void addTarget(const LightScene& scene, PassPlan& plan, const CasterDraws& draws, const ReceiverDepth& depth,
               const CellTarget& target, int cells, CellProduct product, const std::string& name) {
  std::vector<std::string> defines = {"HS_CELLS " + std::to_string(cells)};
  if (target.upper) defines.push_back("HS_UPPER_CELLS");
  if (product == CellProduct::fetched) defines.push_back("HS_USE_FETCH");
  framegraph::ClearValue lit;
  for (const CellTarget::Draw& draw : target.draws) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (draw.channels[c]) lit.color[c] = draws.lightEnclosed(draw.subLight) ? 0.0f : 1.0f;
    }
  }
  PlannedPass pass{.name = scene.name + " " + name, .stage = framegraph::PassStage::receiverPrepass};
  pass.writes = {{.resource = target.image,
                  .point = framegraph::AttachmentPoint::color,
                  .initial = framegraph::InitialContent::clear,
                  .clear = lit},
                 {.resource = depth.depthTest,
                  .point = framegraph::AttachmentPoint::depth,
                  .initial = framegraph::InitialContent::keep}};
  for (const CellTarget::Draw& draw : target.draws) {
    draws.addDraws(scene, plan, pass, depth,
                   {.subLight = draw.subLight,
                    .fragmentFile = "list/caster_cells.frag",
                    .defines = defines,
                    .blend = product == CellProduct::blended ? kMultiply : device::BlendState{},
                    .colorMask = draw.channels});
  }
  plan.passes.push_back(std::move(pass));
}

/// Eight targets and a base colour are more textures than a pass may read: their mean is taken first.
framegraph::ResourceId addMean(const LightScene& scene, PassPlan& plan,
                               const std::vector<TextureRead>& cells) {
  const framegraph::ResourceId mean = screenImage(scene, plan, "mean of cells");
  PlannedPass pass{.name = scene.name + " mean of cells", .stage = framegraph::PassStage::receiverPrepass};
  pass.writes = {{.resource = mean,
                  .point = framegraph::AttachmentPoint::color,
                  .initial = framegraph::InitialContent::dontCare}};
  pass.draws.push_back(
      {.program = plan.addProgram({"screen/fullscreen.vert", "list/cell_mean.frag", {}}), .textures = cells});
  plan.passes.push_back(std::move(pass));
  return mean;
}
}  // namespace

Status planCellTargets(const LightScene& scene, PassPlan& plan, LightLoops& loops, CasterDraws& draws,
                       int cells, CellProduct product) {
  static constexpr auto kQuarters = outlines::subLights();
  static constexpr std::array<device::UniformKey, 8> kSamplers = {
      "u_cells0", "u_cells1", "u_cells2", "u_cells3", "u_cells4", "u_cells5", "u_cells6", "u_cells7"};
  if (Status s = draws.update(scene, plan, loops, kQuarters, Batching::none); !s) return s;
  const ReceiverDepth depth = planReceiverDepth(scene, plan, ReceiverAlpha::facets);
  std::vector<CellTarget> targets = targetsOf(cells);
  std::vector<TextureRead> textures;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const std::string name = "cells " + std::to_string(t);
    targets[t].image = screenImage(scene, plan, name);
    addTarget(scene, plan, draws, depth, targets[t], cells, product, name);
    textures.push_back({.sampler = kSamplers[t], .resource = targets[t].image});
  }
  if (targets.size() > 4) textures = {{.sampler = kSamplers[0], .resource = addMean(scene, plan, textures)}};
  ReceiverShading& shading = plan.shading;
  shading.fragmentFile = "list/screen_cells.frag";
  shading.defines = {"HS_CELL_TARGETS " + std::to_string(textures.size()),
                     "HS_CELLS " + std::to_string(cells)};
  shading.forward = false;
  shading.mapFromWorld = heightFromWorld(scene);
  shading.textures = std::move(textures);
  return {};
}

}  // namespace halfshadow::techniques
