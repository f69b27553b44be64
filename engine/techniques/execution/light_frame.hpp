// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What techniques without planner read and write while they declare a frame for one light.
#pragma once

#include "framegraph/executor.hpp"
#include "framegraph/graph.hpp"
#include "gl/program.hpp"
#include "techniques/core/technique.hpp"
#include "techniques/execution/gpu_mesh.hpp"

namespace halfshadow::techniques {

struct LightFrame : LightScene {
  LightFrame(const LightScene& scene, gl::Context& contextToUse, gl::ProgramCache& programsToUse,
             framegraph::Graph& graphToFill, int index)
      : LightScene(scene),
        context(contextToUse),
        programs(programsToUse),
        graph(graphToFill),
        lightIndex(index) {}
  gl::Context& context;
  gl::ProgramCache& programs;
  framegraph::Graph& graph;
  int lightIndex;
};

}  // namespace halfshadow::techniques
