// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The compiled frame: order, clear, load, store, discard and their bytes. Pure data, no GL.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/graph.hpp"

namespace halfshadow::framegraph {

enum class LoadAction { clear, load, dontCare };
enum class StoreAction { store, discard };

struct PlannedAttachment {
  ResourceId resource;
  AttachmentPoint point = AttachmentPoint::color;
  LoadAction load = LoadAction::clear;
  StoreAction store = StoreAction::store;
  ClearValue clear;
  std::uint64_t bytesLoaded = 0, bytesStored = 0;
};

struct PlannedPass {
  std::uint32_t pass = 0;  ///< index into Graph::passes()
  std::vector<PlannedAttachment> attachments;
  bool generatesMipmaps = false;
  bool updates = false;  ///< PassDesc::update's parts alone are cleared and drawn
  std::string rebindReason;
};

struct Plan {
  std::vector<PlannedPass> passes;
  std::vector<Graph::Skipped> skipped;  ///< passes not run, with the reason, after the graph's own notes
  std::uint64_t bytesLoaded = 0, bytesStored = 0;

  std::string text(const Graph& graph) const;
  std::string graphviz(const Graph& graph) const;
};

/// What a pass draws into, "a+depth 64x32".
std::string targetText(const Graph& graph, const PlannedPass& planned);

/// Content key that a persistent resource holds now; 0 = nothing valid.
using ContentKeyLookup = std::function<std::uint64_t(const ResourceDesc&)>;

/// Orders passes by stage, then by data dependency, then by declaration; drops passes whose results nobody
/// reads; skips those whose persistent targets already hold their content; derives load and store actions.
/// Errors: internal — a pass reads what no pass writes and no frame left valid, a cycle, a read and a write
/// of one resource in one pass, a pass of an earlier stage that reads what a later stage writes, a
/// framebuffer bound twice without a reason, and everything that checkGraph() finds. Imported targets count
/// as outputs: passes that write one always run and store.
Result<Plan> compile(const Graph& graph, const ContentKeyLookup& contentKeyOf);

}  // namespace halfshadow::framegraph
