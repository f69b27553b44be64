// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a light's draws use programs for, so that each can be proven to draw.
#pragma once

#include <functional>
#include <vector>

#include "framegraph/graph.hpp"
#include "gl/program_proofs.hpp"
#include "techniques/core/receiver_shading.hpp"
#include "techniques/execution/receiver_pass.hpp"

namespace halfshadow::techniques {

/// Asks for proof of uses and keeps their keys, each once.
class ProgramUses {
 public:
  ProgramUses(gl::ProgramProofs& proofs, const device::Capabilities& capabilities)
      : proofs_(proofs), capabilities_(capabilities) {}

  using DescOf = std::function<const framegraph::ResourceDesc&(framegraph::ResourceId)>;
  /// `descOf`: of the images that `textures` name.
  void add(gl::Program& program, const gl::DrawState& state, const std::vector<TextureRead>& textures,
           const DescOf& descOf);
  /// All that drawReceivers() would draw with.
  void addReceivers(const ReceiverProgramSet& programs, const ReceiverShading& shading,
                    const ReceiverTarget& target, const DescOf& descOf);

  struct Use {
    gl::ProofKey key = 0;
    const gl::Program* program = nullptr;
  };
  const std::vector<Use>& uses() const { return uses_; }

 private:
  gl::ProgramProofs& proofs_;
  const device::Capabilities& capabilities_;
  std::vector<Use> uses_;
};

}  // namespace halfshadow::techniques
