// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Draws programs where the traces of their draws can be read back.
#pragma once

#include <span>

#include "gl/program_proofs.hpp"

namespace halfshadow::gl {

/// A target in which each program has a column of two pixels. Made for one batch.
class ProofBench {
 public:
  static constexpr int kColumns = 256;
  explicit ProofBench(Encoder& encoder) : encoder_(encoder) {}

  /// At most kColumns − 1 uses. By use, whether it left a trace. Errors: see ProgramProofs::run().
  Result<std::vector<bool>> traces(std::span<const ProgramUse* const> uses);

 private:
  Status makeTarget();
  void clear();
  Status draw(const ProgramUse& use, int column);
  void markUntouchedDepth(const Rect& columns, Program& paint);
  Status bind(const ProgramUse& use);
  Encoder& encoder_;
  Texture color_;
  Renderbuffer depth_;
  Framebuffer target_;
  std::vector<std::pair<device::TextureDesc, Texture>> textures_;
};

}  // namespace halfshadow::gl
