// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/program_uses.hpp"

#include <algorithm>

#include "framegraph/resource_pool.hpp"

namespace halfshadow::techniques {

void ProgramUses::add(gl::Program& program, const gl::DrawState& state,
                      const std::vector<TextureRead>& textures, const DescOf& descOf) {
  gl::ProgramUse use{.program = &program, .state = state};
  for (const TextureRead& read : textures) {
    const int unit = program.samplerUnit(read.sampler);
    if (unit < 0) continue;
    use.textures.push_back({unit, read.texture
                                      ? read.texture->desc()
                                      : framegraph::textureDescOf(descOf(read.resource), capabilities_)});
  }
  const gl::ProofKey key = gl::proofKeyOf(use);
  if (std::ranges::find(uses_, key, &Use::key) != uses_.end()) return;
  uses_.push_back({key, &program});
  proofs_.ask(key, use);
}

void ProgramUses::addReceivers(const ReceiverProgramSet& programs, const ReceiverShading& shading,
                               const ReceiverTarget& target, const DescOf& descOf) {
  const gl::DrawState state = receiverState(target);
  for (const ReceiverPrograms& linked : programs.byKind) {
    for (gl::Program* program : {linked.whole, linked.classify, linked.filter}) {
      if (program) add(*program, state, shading.textures, descOf);
    }
  }
}

}  // namespace halfshadow::techniques
