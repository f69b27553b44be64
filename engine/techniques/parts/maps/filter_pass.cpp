// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/filter_pass.hpp"

namespace halfshadow::techniques {

void addFilterPass(PassPlan& plan, FilterPass filter) {
  PlannedDraw draw{.program = plan.addProgram(
                       {"screen/fullscreen.vert", std::move(filter.fragmentFile), std::move(filter.defines)}),
                   .textures = {{.sampler = filter.sampler, .resource = filter.source}},
                   .uniforms = std::move(filter.uniforms)};
  const float size = static_cast<float>(filter.sourceSize);
  draw.uniforms.set("u_sourceSize", glm::vec4(size, 1.0f / size, filter.targetSize, 0));
  PlannedPass pass{.name = std::move(filter.name), .contentKey = filter.contentKey};
  pass.writes = {{.resource = filter.target, .initial = framegraph::InitialContent::dontCare}};
  pass.draws.push_back(std::move(draw));
  plan.passes.push_back(std::move(pass));
}

}  // namespace halfshadow::techniques
