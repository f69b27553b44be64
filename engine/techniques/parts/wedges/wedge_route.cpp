// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/wedge_route.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::PassDesc;

/// Draws of whole receivers, and vertices that they process, up to which `auto` lets receivers carry the
/// silhouettes.
constexpr std::size_t kMostDraws = 64, kMostVertices = 65536;

std::vector<WedgeGroup> allTogether(const outlines::WedgePieces& pieces) {
  return {{{0, static_cast<std::uint32_t>(pieces.casters.size())}}};
}
gl::BlendState blendOf(WedgeMix mix) {
  return mix == WedgeMix::add ? kAdd : kMultiply;
}
std::vector<DrawItem> itemsOf(const LightFrame& frame) {
  return {frame.receivers.begin(), frame.receivers.end()};
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

Status WedgeRoute::declareGroup(const LightFrame& frame, std::size_t index, const std::string& name,
                                const GroupTarget& target, const std::string& again) {
  PassDesc pass{.name = wedgePassName(frame, name),
                .stage = framegraph::PassStage::receiverPrepass,
                .rebindReason = again};
  if (!depth_) return addReceiverPass(frame, std::move(pass), index, target);
  return addScreenPass(frame, std::move(pass), index, target);
}

Status WedgeRoute::addScreenPass(const LightFrame& frame, PassDesc pass, std::size_t index,
                                 const GroupTarget& target) {
  auto programs = piecePrograms(frame, definesOf(target.mix));
  if (!programs) return programs.error();
  std::vector<ReceiverDraw> footprints;
  ReceiverWedgePrograms footprintPrograms;
  if (draws_ && !draws_->groups[index].empty()) {
    auto linked = receiverWedgePrograms(frame, definesOf(target.mix));
    if (!linked) return linked.error();
    footprintPrograms = *linked;
    footprints = draws_->groups[index];
  }
  const Wedges wedges{volumes_, *depth_};
  pass.reads = {depth_->packed};
  pass.writes = wedgeTargets(target.color, *depth_, InitialContent::clear, target.clear);
  pass.execute = [programs = *programs, wedges, &view = frame.screen, group = groups_[index], target,
                  footprintPrograms, footprints, items = itemsOf(frame)](framegraph::PassContext& context) {
    if (wedges.volumes->lightEnclosed) return;
    drawReceiverWedges(context, footprintPrograms, *wedges.volumes, view, wedges.depth.clipFromWorld, items,
                       footprints, blendOf(target.mix), target.steps);
    addVolumes(context, programs, wedges, view, group, blendOf(target.mix), target.steps);
  };
  frame.graph.addPass(std::move(pass));
  return {};
}

Status WedgeRoute::addReceiverPass(const LightFrame& frame, PassDesc pass, std::size_t index,
                                   const GroupTarget& target) {
  auto programs = receiverWedgePrograms(frame, definesOf(target.mix));
  if (!programs) return programs.error();
  const bool first = !depthBuffer_.valid();
  gl::Program* depthProgram = nullptr;
  if (first) {
    auto linked = frame.programs.get({"screen/receiver_depth.vert", "screen/receiver_depth.frag", {}});
    if (!linked) return linked.error();
    depthProgram = *linked;
    depthBuffer_ = frame.graph.addResource({.name = wedgePassName(frame, "wedge depth"),
                                            .width = frame.screen.width,
                                            .height = frame.screen.height,
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
  pass.execute = [programs = *programs, depthProgram, volumes = volumes_, &view = frame.screen,
                  items = itemsOf(frame), draws = draws_->groups[index],
                  target](framegraph::PassContext& context) {
    if (volumes->lightEnclosed) return;
    if (depthProgram) drawReceiverDepth(context, *depthProgram, view, items);
    drawReceiverWedges(context, programs, *volumes, view, view.clipFromWorld, items, draws,
                       blendOf(target.mix), target.steps);
  };
  frame.graph.addPass(std::move(pass));
  return {};
}

Result<WedgeRoute> WedgeRoutes::choose(const LightFrame& frame, std::string_view setting, Grouping grouping) {
  WedgeRoute route;
  route.volumes_ = volumes_.updatePieces(frame);
  route.groups_ = grouping(route.volumes_->pieces);
  VolumeEnds ends;
  if (setting != "screen" && coincident_.among(frame.receivers)) {
    frame.graph.noteSkipped(wedgePassName(frame, "wedges drawn by receivers"),
                            "surfaces of receivers coincide: both would be drawn on one pixel");
  } else if (setting != "screen") {
    const std::size_t mostDraws = snapsCoarsely(frame.capabilities) ? 0 : kMostDraws;
    auto draws = receivers_[frame.lightIndex].update(frame, *route.volumes_, route.groups_);
    if (!draws) return draws.error();
    const std::string count = std::to_string(draws->wholeDraws) + " draws of receivers with many triangles";
    if (setting == "receivers" || (draws->wholeDraws <= mostDraws && draws->wholeVertices <= kMostVertices)) {
      frame.graph.noteSkipped(wedgePassName(frame, "wedge volumes"),
                              "receivers carry the projected silhouettes, with " + count);
      route.draws_ = std::move(*draws);
      return route;
    }
    if (draws->allCut) {
      frame.graph.noteSkipped(wedgePassName(frame, "wedge volumes for receivers of few triangles"),
                              "they carry the projected silhouettes; others would take " + count);
      keepFootprints(*draws);
      route.draws_ = std::move(*draws);
      ends = volumeEnds(frame, *route.volumes_);
    } else {
      frame.graph.noteSkipped(wedgePassName(frame, "wedges drawn by receivers"),
                              "too many pieces of silhouette reach them");
    }
  }
  auto depth = declareReceiverDepth(frame);
  if (!depth) return depth.error();
  if (Status s = volumes_.upload(frame, *depth, ends.heights, ends.key); !s) return s.error();
  route.depth_ = *depth;
  return route;
}

Result<ReceiverShading> WedgeRoutes::declareSums(const LightFrame& frame, std::string_view setting) {
  auto route = choose(frame, setting, allTogether);
  if (!route) return route.error();
  const framegraph::ResourceId sums = screenImage(frame, "wedge sums");
  if (Status s = route->declareGroup(frame, 0, "wedges", {.color = sums, .steps = kStepsOfAll}, {}); !s)
    return s.error();
  // Nothing drawn reads as visibility 0.
  return screenShading(frame, sums, route->volumes().lightEnclosed ? 0.0f : kStepsOfAll);
}

void WedgeRoutes::contextLost() {
  volumes_.contextLost();
  receivers_.clear();
  coincident_ = {};
}

}  // namespace halfshadow::techniques
