// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/level_atlas.hpp"

#include <algorithm>

namespace halfshadow::techniques {

void addLevelPass(framegraph::Graph& graph, std::string name, framegraph::ResourceId target,
                  std::vector<LevelDraw> draws, std::uint64_t contentKey) {
  framegraph::PassDesc pass{.name = std::move(name), .stage = framegraph::PassStage::mask};
  for (const LevelDraw& draw : draws) {
    if (std::ranges::find(pass.reads, draw.source.image) == pass.reads.end())
      pass.reads.push_back(draw.source.image);
  }
  pass.writes = {{.resource = target}};
  pass.contentKey = contentKey;
  pass.execute = [draws = std::move(draws)](framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    for (const LevelDraw& draw : draws) {
      const LevelImage& source = draw.source;
      encoder.useProgram(*draw.program);
      draw.program->set(encoder.context(), "u_sourceRect",
                        glm::vec4(source.rect.x, source.rect.y, source.rect.width, draw.target.width));
      draw.program->set(encoder.context(), "u_sourceScale",
                        glm::vec4(1.0 / source.imageWidth, 1.0 / source.imageHeight, 0, 0));
      const gl::TextureBinding binding{draw.program->samplerUnit("u_source"), &context.texture(source.image)};
      encoder.bindTextures({&binding, 1});
      encoder.setViewport(draw.target);
      encoder.drawFullscreen({});
    }
  };
  graph.addPass(std::move(pass));
}

}  // namespace halfshadow::techniques
