// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What every probe needs: a small RGBA8 target, an encoder, programs from source. Internal to probes*.cpp.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "gl/encoder.hpp"

namespace halfshadow::gl {

/// Empty when the feature works, else one clause that says what went wrong.
using ProbeFailure = std::string;

class ProbeBench {
 public:
  static constexpr int kWidth = 256, kHeight = 4;
  using Pixel = std::array<std::uint8_t, 4>;

  explicit ProbeBench(Context& context);
  /// Whether the target itself could be made; nothing else works without.
  bool ready() const { return target_.valid(); }

  Context& context() { return encoder_.context(); }
  const Functions& gl() { return context().functions(); }
  Encoder& encoder() { return encoder_; }
  const Framebuffer& target() const { return target_; }
  const Texture& targetTexture() const { return color_; }

  /// Program over a_position at depth u_z with `fragment` (no version line).
  Result<Program> program(std::string_view fragment, std::string_view extensionLine = {});
  Result<Program> programOf(std::string_view vertex, std::string_view fragment);

  /// Clears all attachments of `framebuffer`: color 0, depth 1, stencil 0.
  void clear(const Framebuffer& framebuffer, const glm::vec4& color = glm::vec4(0.0f));
  /// One fullscreen triangle over the viewport `rect`.
  void draw(const Framebuffer& framebuffer, Program& program, const Rect& rect, const DrawState& state = {});
  Pixel read(const Framebuffer& framebuffer, int x, int y);

 private:
  Encoder encoder_;
  Texture color_;
  Framebuffer target_;
};

/// Whether two bytes differ by at most `tolerance`.
inline bool near(int a, int b, int tolerance) {
  return a - b <= tolerance && b - a <= tolerance;
}
std::string pixelText(const ProbeBench::Pixel& pixel);

// probe_arithmetic.cpp
int measureMantissaBits(ProbeBench& bench, std::string_view precision);
int measureVaryingMantissaBits(ProbeBench& bench, std::string_view precision);
device::ByteRounding measureByteRounding(ProbeBench& bench, std::string_view precision);

// probe_features.cpp
ProbeFailure probeDepthTexture(ProbeBench& bench);
ProbeFailure probeDepth24(ProbeBench& bench, bool depthTextures, bool highp);
ProbeFailure probePackedDepthStencil(ProbeBench& bench, bool depthTextures);
ProbeFailure probeBlendMinmax(ProbeBench& bench);
ProbeFailure probeFramebufferFetch(ProbeBench& bench, std::string_view extension);
ProbeFailure probeDerivatives(ProbeBench& bench);
ProbeFailure probeDiscard(ProbeBench& bench);
ProbeFailure probeUintIndex(ProbeBench& bench);
ProbeFailure probeTextureLod(ProbeBench& bench);
ProbeFailure probeTimerQuery(ProbeBench& bench);
/// Not a capability: whether a separate 8-bit stencil renderbuffer goes with a 16-bit depth one.
ProbeFailure probeSeparateDepthStencil(ProbeBench& bench);

}  // namespace halfshadow::gl
