// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// State of versions and extensions after OpenGL ES 2.0 that a host may have set and that would change what
/// the engine draws, though it uses none of it: vertex array objects, sampler objects, pixel buffers, row
/// lengths and skips, a read framebuffer, divisors, rasterizer discard, primitive restart, transform
/// feedback.
#pragma once

#include <array>

#include "gl/context.hpp"
#include "gl/state_bindings.hpp"

namespace halfshadow::gl {

class LaterState {
 public:
  /// Reads what the context's version and extensions have of it.
  void capture(Context& context);
  /// Sets all of it to where it changes nothing: the initial values. Before ES 2.0's state is captured, since
  /// attributes belong to the vertex array object.
  static void neutralize(Context& context);
  /// What capture() found; after ES 2.0's state was restored.
  void restore(Context& context) const;

 private:
  static constexpr int kPixelStores = 6, kFlags = 2;
  GLint vertexArray_ = 0, unpackBuffer_ = 0, packBuffer_ = 0, readFramebuffer_ = 0;
  std::array<GLint, state::kTextureUnits> samplers_{};
  std::array<GLint, state::kVertexAttributes> divisors_{};
  std::array<GLint, kPixelStores> pixelStores_{};
  std::array<bool, kFlags> flags_{};
  bool feedbackRuns_ = false;
};

}  // namespace halfshadow::gl
