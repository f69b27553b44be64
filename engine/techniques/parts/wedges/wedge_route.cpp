// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/wedge_route.hpp"

#include <algorithm>

namespace halfshadow::techniques {
namespace {
using framegraph::AttachmentPoint;
using framegraph::InitialContent;

/// Draws of whole receivers, and vertices that they process, up to which `auto` lets receivers carry the
/// silhouettes.
constexpr std::size_t kMostDraws = 64, kMostVertices = 65536;

std::vector<WedgeGroup> allTogether(const outlines::WedgePieces& pieces) {
  return {{{0, static_cast<std::uint32_t>(pieces.casters.size())}}};
}
bool hasHoles(const DrawItem& item) {
  return item.alphaMask != nullptr;
}
device::BlendState blendOf(WedgeMix mix) {
  return mix == WedgeMix::add ? kAdd : kMultiply;
}
std::vector<std::string> definesOf(WedgeMix mix) {
  if (mix == WedgeMix::multiply) return {"HS_WEDGE_MULTIPLY"};
  return {};
}
}  // namespace

SettingInfo routeSetting(const std::string& key) {
  return {
      key,
      SettingType::choice,
      "auto",
      0,
      0,
      {"auto", "screen", "receivers"},
      "screen draws wedges as volumes and reads the receivers' depth; receivers draws what is shadowed, "
      "silhouettes projected at its vertices, without depth texture and exact without highp; auto takes "
      "receivers for those of few triangles, and for others unless they need more than 64 draws, or any on "
      "devices with highp that snap vertices coarsely"};
}

void WedgeRoute::addGroup(const LightScene& scene, PassPlan& plan, std::size_t index, const std::string& name,
                          const GroupTarget& target, const std::string& again) {
  PlannedPass pass{.name = scene.name + " " + name,
                   .stage = framegraph::PassStage::receiverPrepass,
                   .rebindReason = again};
  if (depth_) {
    drawOnScreen(scene, plan, pass, index, target);
  } else {
    drawByReceivers(scene, plan, pass, index, target);
  }
  plan.passes.push_back(std::move(pass));
}

void WedgeRoute::drawOnScreen(const LightScene& scene, PassPlan& plan, PlannedPass& pass, std::size_t index,
                              const GroupTarget& target) const {
  pass.writes = wedgeTargets(target.color, *depth_, InitialContent::clear, target.clear);
  if (volumes_->lightEnclosed) return;
  if (draws_) {
    addReceiverWedges(scene, plan, pass, *volumes_, draws_->groups[index],
                      {.defines = definesOf(target.mix),
                       .clipFromWorld = depth_->clipFromWorld,
                       .blend = blendOf(target.mix),
                       .steps = target.steps});
  }
  addVolumes(scene, plan, pass, {volumes_, *depth_}, definesOf(target.mix), groups_[index],
             blendOf(target.mix), target.steps);
}

void WedgeRoute::drawByReceivers(const LightScene& scene, PassPlan& plan, PlannedPass& pass,
                                 std::size_t index, const GroupTarget& target) {
  const bool first = !depthBuffer_.valid();
  if (first) {
    depthBuffer_ = plan.addImage({.name = scene.name + " wedge depth",
                                  .width = scene.screen.width,
                                  .height = scene.screen.height,
                                  .format = framegraph::Format::depth24,
                                  .storage = framegraph::Storage::renderbuffer});
  }
  const float clear = target.clear;
  pass.writes = {{.resource = target.color,
                  .point = AttachmentPoint::color,
                  .initial = InitialContent::clear,
                  .clear = {.color = {clear, clear, clear, clear}}},
                 {.resource = depthBuffer_,
                  .point = AttachmentPoint::depth,
                  .initial = first ? InitialContent::clear : InitialContent::keep}};
  if (volumes_->lightEnclosed) return;
  if (first) pass.draws.push_back(receiverSurfaces(scene, plan));
  addReceiverWedges(scene, plan, pass, *volumes_, draws_->groups[index],
                    {.defines = definesOf(target.mix),
                     .clipFromWorld = scene.screen.clipFromWorld,
                     .blend = blendOf(target.mix),
                     .steps = target.steps});
}

WedgeRoute WedgeRoutes::choose(const LightScene& scene, PassPlan& plan, std::string_view setting,
                               Grouping grouping, CastingReceivers casting) {
  WedgeRoute route;
  route.volumes_ = &volumes_.updatePieces(scene);
  route.groups_ = grouping(route.volumes_->pieces);
  VolumeEnds ends;
  if (setting != "screen" && coincident_.among(scene.receivers)) {
    plan.note(scene.name + " wedges drawn by receivers",
              "surfaces of receivers coincide: both would be drawn on one pixel");
  } else if (setting != "screen" && std::ranges::any_of(scene.receivers, hasHoles)) {
    plan.note(scene.name + " wedges drawn by receivers",
              "alpha cuts holes into receivers: what is seen through them would be drawn over");
  } else if (setting != "screen") {
    const std::size_t mostDraws = snapsCoarsely(scene.capabilities) ? 0 : kMostDraws;
    ReceiverDraws draws = receivers_.update(scene, *route.volumes_, route.groups_, casting);
    const std::string count = std::to_string(draws.wholeDraws) + " draws of receivers with many triangles";
    if (setting == "receivers" || (draws.wholeDraws <= mostDraws && draws.wholeVertices <= kMostVertices)) {
      plan.note(scene.name + " wedge volumes", "receivers carry the projected silhouettes, with " + count);
      route.draws_ = std::move(draws);
      return route;
    }
    if (draws.allCut) {
      plan.note(scene.name + " wedge volumes for receivers of few triangles",
                "they carry the projected silhouettes; others would take " + count);
      keepFootprints(draws);
      route.draws_ = std::move(draws);
      ends = volumeEnds(scene, *route.volumes_);
    } else {
      plan.note(scene.name + " wedges drawn by receivers", "too many pieces of silhouette reach them");
    }
  }
  route.depth_ = planReceiverDepth(scene, plan);
  volumes_.addBuffers(scene, plan, *route.depth_, ends.heights, ends.key);
  return route;
}

void WedgeRoutes::planSums(const LightScene& scene, PassPlan& plan, std::string_view setting,
                           CastingReceivers casting) {
  WedgeRoute route = choose(scene, plan, setting, allTogether, casting);
  const framegraph::ResourceId sums = screenImage(scene, plan, "wedge sums");
  route.addGroup(scene, plan, 0, "wedges", {.color = sums, .steps = kStepsOfAll}, {});
  // Nothing drawn reads as visibility 0.
  plan.shading = screenShading(scene, sums, route.volumes().lightEnclosed ? 0.0f : kStepsOfAll);
}

}  // namespace halfshadow::techniques
