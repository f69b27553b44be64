// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A layer between an engine and its driver, put there through getProcAddress: it knows what every program is
/// made of, and can leave out draws without an error, as drivers do whose compilers find no way to fit a
/// program in.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "halfshadow/halfshadow.hpp"

namespace halfshadow::test {

/// A program as drivers compile it: its texts, and the blending that some compile in.
struct DrawnProgram {
  std::string vertex, fragment;
  std::string blend;  ///< "" or "source destination equation"
  auto operator<=>(const DrawnProgram&) const = default;
  /// Of the fragment shader, "map/pcf.frag".
  std::string file() const;
  /// Its defines, one line.
  std::string defines() const;
};

/// Whose draws are left out.
using DropRule = std::function<bool(const DrawnProgram&)>;

/// One at a time in a process: the entry points of OpenGL ES carry no state.
class ProgramLayer {
 public:
  ProgramLayer();
  ~ProgramLayer();
  ProgramLayer(const ProgramLayer&) = delete;
  ProgramLayer& operator=(const ProgramLayer&) = delete;

  /// An engine on the process's context, above this layer. A failure is a test failure.
  std::unique_ptr<Engine> makeEngine(EngineDesc desc = {});
  void drop(DropRule rule);
  /// What was drawn with, or would have been, since the last call; each once.
  std::vector<DrawnProgram> takeDrawn();
  std::uint64_t droppedDraws() const;
  std::uint64_t readBacks() const;  ///< calls of glReadPixels
};

}  // namespace halfshadow::test
