// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "api/engine_state.hpp"

namespace halfshadow {
namespace {
/// What was done of an unchanged frame, as a plan: the passes that were drawn again, and the others as
/// unchanged.
framegraph::Plan planOfUnchanged(const Frame& frame) {
  framegraph::Plan plan;
  for (const framegraph::PassReport& report : frame.passReports) {
    plan.passes.push_back(frame.plan.passes[report.planned]);
    for (const framegraph::PlannedAttachment& attachment : plan.passes.back().attachments) {
      plan.bytesLoaded += attachment.bytesLoaded;
      plan.bytesStored += attachment.bytesStored;
    }
  }
  plan.skipped = frame.plan.skipped;
  for (const framegraph::PlannedPass& planned : frame.plan.passes) {
    if (std::ranges::find(plan.passes, planned.pass, &framegraph::PlannedPass::pass) == plan.passes.end())
      plan.skipped.push_back({frame.graph.passes()[planned.pass].name, "unchanged"});
  }
  return plan;
}

std::vector<framegraph::Graph::Skipped> skippedOf(const Frame& frame, const framegraph::Plan& plan,
                                                  const std::vector<std::uint32_t>& lightNumbers) {
  std::vector<planner::Skip> skips = frame.skips;
  const auto said = [&](std::uint32_t number) {
    return std::ranges::any_of(skips, [&](const planner::Skip& skip) {
      return skip.subject == planner::Skip::Subject::light && skip.light == number;
    });
  };
  if (frame.unchanged) {
    for (const std::uint32_t number : lightNumbers) {
      if (!said(number)) skips.push_back({.subject = planner::Skip::Subject::light, .light = number});
    }
  }
  std::vector<framegraph::Graph::Skipped> skipped = plan.skipped;
  for (const planner::Skip& skip : skips) {
    skipped.push_back({planner::skipName(skip), std::string(planner::skipCode(skip.reason)) + ": " +
                                                    std::string(planner::skipText(skip.reason))});
  }
  return skipped;
}

PassRecord recordOf(const framegraph::PassDesc& pass, const framegraph::PlannedPass& planned,
                    const framegraph::PassReport& report, bool canDiscard) {
  using framegraph::LoadAction;
  using framegraph::PassStage;
  using framegraph::StoreAction;
  PassRecord record{.name = pass.name.c_str(),
                    .draws = report.counters.draws,
                    .triangles = report.counters.triangles,
                    .milliseconds = report.milliseconds,
                    .lightSpace = pass.stage == PassStage::light || pass.stage == PassStage::mask};
  for (const framegraph::PlannedAttachment& attachment : planned.attachments) {
    record.bytesLoaded += attachment.bytesLoaded;
    record.bytesStored += attachment.bytesStored;
    record.clear = record.clear || attachment.load == LoadAction::clear;
    record.load = record.load || attachment.load == LoadAction::load;
    record.store = record.store || attachment.store == StoreAction::store;
    record.discard = record.discard || (canDiscard && attachment.store == StoreAction::discard);
  }
  return record;
}
}  // namespace

FrameReport Engine::report() {
  try {
    return state_->frameReport();
  } catch (...) {
    return {};
  }
}

FrameReport Engine::State::frameReport() {
  State& state = *this;
  if (!state.lastFrame || !state.lastFrame->valid) return {};
  const Frame& frame = *state.lastFrame;
  ReportStorage& storage = state.report;
  const framegraph::Plan plan = frame.unchanged ? planOfUnchanged(frame) : frame.plan;
  storage.skipped = skippedOf(frame, plan, state.lightNumbers);
  storage.planText = plan.text(frame.graph);
  storage.planGraphviz = plan.graphviz(frame.graph);
  const bool canDiscard = state.context->capabilities().has(device::Capability::discard);
  storage.passes.clear();
  storage.targets.clear();
  for (const framegraph::PassReport& drawn : frame.passReports) {
    const framegraph::PlannedPass& planned = frame.plan.passes[drawn.planned];
    storage.targets.push_back(framegraph::targetText(frame.graph, planned));
    storage.passes.push_back(recordOf(frame.graph.passes()[planned.pass], planned, drawn, canDiscard));
  }
  for (std::size_t i = 0; i < storage.passes.size(); ++i)
    storage.passes[i].target = storage.targets[i].c_str();
  storage.skips.clear();
  for (const auto& skip : storage.skipped) storage.skips.push_back({skip.what.c_str(), skip.why.c_str()});
  return {.passes = storage.passes.data(),
          .passCount = storage.passes.size(),
          .skips = storage.skips.data(),
          .skipCount = storage.skips.size(),
          .framebufferSwitches = frame.counters.framebufferSwitches,
          .draws = frame.counters.draws,
          .triangles = frame.counters.triangles,
          .bytesLoaded = plan.bytesLoaded,
          .bytesStored = plan.bytesStored,
          .textureBytesUploaded = frame.counters.textureUploadBytes,
          .bufferBytesUploaded = frame.counters.bufferUploadBytes,
          .memoryBytes = state.memoryBytes(),
          .silhouettesExtracted = frame.silhouettesExtracted,
          .castersDrawn = frame.castersDrawn.drawn,
          .castersKept = frame.castersDrawn.kept,
          .planText = storage.planText.c_str(),
          .planGraphviz = storage.planGraphviz.c_str()};
}

}  // namespace halfshadow
