// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/level_atlas.hpp"

namespace halfshadow::techniques {

void addLevelPass(PassPlan& plan, std::string name, framegraph::ResourceId target,
                  const std::vector<LevelDraw>& draws, std::uint64_t contentKey) {
  PlannedPass pass{.name = std::move(name), .writes = {{.resource = target}}, .contentKey = contentKey};
  for (const LevelDraw& level : draws) {
    const LevelImage& source = level.source;
    PlannedDraw draw{
        .program = plan.addProgram({"screen/fullscreen.vert", level.fragmentFile, level.defines}),
        .textures = {{.sampler = "u_source", .resource = source.image}},
        .viewport = level.target};
    draw.uniforms.set("u_sourceRect",
                      glm::vec4(source.rect.x, source.rect.y, source.rect.width, level.target.width));
    draw.uniforms.set("u_sourceScale", glm::vec4(1.0 / source.imageWidth, 1.0 / source.imageHeight, 0, 0));
    pass.draws.push_back(std::move(draw));
  }
  plan.passes.push_back(std::move(pass));
}

}  // namespace halfshadow::techniques
