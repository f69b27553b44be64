// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Short ways to declare graphs in tests.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "framegraph/plan.hpp"

namespace halfshadow::framegraph::testing {

inline ResourceId colorTexture(Graph& graph, const std::string& name,
                               Lifetime lifetime = Lifetime::transient) {
  return graph.addResource({.name = name, .width = 64, .height = 32, .lifetime = lifetime});
}

inline ResourceId depthBuffer(Graph& graph, const std::string& name,
                              Lifetime lifetime = Lifetime::transient) {
  return graph.addResource({.name = name,
                            .width = 64,
                            .height = 32,
                            .format = Format::depth16,
                            .storage = Storage::renderbuffer,
                            .lifetime = lifetime});
}

inline Attachment colorOf(ResourceId resource, InitialContent initial = InitialContent::clear) {
  return {.resource = resource, .point = AttachmentPoint::color, .initial = initial};
}

inline Attachment depthOf(ResourceId resource, InitialContent initial = InitialContent::clear) {
  return {.resource = resource, .point = AttachmentPoint::depth, .initial = initial};
}

inline void addPass(Graph& graph, const std::string& name, PassStage stage, std::vector<ResourceId> reads,
                    std::vector<Attachment> writes, std::uint64_t contentKey = 0,
                    const std::string& rebindReason = "") {
  graph.addPass({.name = name,
                 .stage = stage,
                 .reads = std::move(reads),
                 .writes = std::move(writes),
                 .contentKey = contentKey,
                 .rebindReason = rebindReason});
}

/// Content keys by resource name; absent names hold nothing.
using HeldKeys = std::map<std::string, std::uint64_t>;

inline ContentKeyLookup lookup(HeldKeys held) {
  return [held](const ResourceDesc& desc) {
    const auto found = held.find(desc.name);
    return found == held.end() ? std::uint64_t{0} : found->second;
  };
}

inline Plan compiled(const Graph& graph, const HeldKeys& held = {}) {
  Result<Plan> plan = compile(graph, lookup(held));
  EXPECT_TRUE(plan.ok()) << (plan.ok() ? "" : plan.error().message);
  return plan.ok() ? *plan : Plan{};
}

inline std::string failure(const Graph& graph, const HeldKeys& held = {}) {
  const Result<Plan> plan = compile(graph, lookup(held));
  if (plan.ok()) return "";
  EXPECT_EQ(plan.error().code, ErrorCode::internal);
  return plan.error().message;
}

/// Names of the passes that run, in order, joined by spaces.
inline std::string running(const Graph& graph, const Plan& plan) {
  std::string names;
  for (const PlannedPass& pass : plan.passes)
    names += (names.empty() ? "" : " ") + graph.passes()[pass.pass].name;
  return names;
}

/// Why a pass does not run; empty when it does.
inline std::string skipReason(const Plan& plan, const std::string& name) {
  for (const Graph::Skipped& skip : plan.skipped) {
    if (skip.what == name) return skip.why;
  }
  return "";
}

}  // namespace halfshadow::framegraph::testing
