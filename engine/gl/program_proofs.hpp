// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Whether programs draw at all. Drivers whose compilers find no way to fit a program in (too many
/// instructions, too few registers) are known to report a successful link and no error, and to leave its
/// draws out: only drawing tells.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "device/texture_desc.hpp"
#include "gl/encoder.hpp"

namespace halfshadow::gl {

/// A program and what it is drawn with, as far as drivers compile that in.
struct ProgramUse {
  Program* program = nullptr;
  DrawState state;
  struct Sampled {
    int unit = -1;  ///< negative: the program has no such sampler
    device::TextureDesc desc;
  };
  std::vector<Sampled> textures;
};
/// Of a use: of the program's texts, its blending, its depth test, and which samplers read depth.
using ProofKey = std::uint64_t;
ProofKey proofKeyOf(const ProgramUse& use);

enum class Proof {
  unknown,
  draws,
  dropped,
  unproven  ///< proving it failed: it is taken to draw, and not asked for again
};

/// What is known, by use, and what is to be found out. Answers hold for one driver and never change.
class ProgramProofs {
 public:
  /// Keeps the use for the next run() unless the answer is known; the program must live until then.
  void ask(ProofKey key, const ProgramUse& use);
  Proof of(ProofKey key) const;
  bool pending() const { return !asked_.empty(); }
  /// Draws all that were asked for, a pixel or two each, and reads back once for each 255. Uniforms that
  /// place vertices are set, the others are as linking left them. Errors: those of making a framebuffer;
  /// driverFault (an OpenGL ES error, or what was never drawn does not read back so): then they stay
  /// unproven.
  Status run(Encoder& encoder);

  /// All answers as text, for the next start on the same driver: `driver` is kept in it.
  std::string text(const device::DriverIdentity& driver) const;
  /// Takes the answers of a text that text() made on such a driver; false, and nothing is taken, of any
  /// other.
  bool restore(std::string_view text, const device::DriverIdentity& driver);
  std::size_t size() const { return known_.size(); }

 private:
  struct Asked {
    ProofKey key = 0;
    ProgramUse use;
  };
  std::map<ProofKey, Proof> known_;
  std::vector<Asked> asked_;
};

}  // namespace halfshadow::gl
