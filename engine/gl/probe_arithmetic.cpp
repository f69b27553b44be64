// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>
#include <vector>

#include "gl/probe_bench.hpp"

namespace halfshadow::gl {
namespace {

constexpr int kMaxMantissaBits = 23;

std::string precisionLine(std::string_view precision) {
  return "precision " + std::string(precision) + " float;\n";
}

}  // namespace

/// Draws one pixel for each n: is (1 + 2^-n) - 1 still 2^-n? All operands are uniforms, and the max() between
/// the two operations keeps compilers from cancelling the ones.
int measureMantissaBits(ProbeBench& bench, std::string_view precision) {
  Result<Program> program =
      bench.program(precisionLine(precision) +
                    "uniform float u_one; uniform float u_step; uniform float u_floor;\n"
                    "void main() {\n"
                    "  float sum = max(u_one + u_step, u_floor);\n"
                    "  float rest = sum - u_one;\n"
                    "  gl_FragColor = vec4(abs(rest - u_step) < 0.5 * u_step ? 1.0 : 0.0);\n"
                    "}\n");
  if (!program) return 0;
  Context& context = bench.context();
  bench.clear(bench.target());
  for (int bits = 1; bits <= kMaxMantissaBits; ++bits) {
    bench.encoder().useProgram(*program);
    program->set(context, "u_one", 1.0f);
    program->set(context, "u_floor", 0.5f);
    program->set(context, "u_step", std::ldexp(1.0f, -bits));
    bench.draw(bench.target(), *program, {bits, 0, 1, 1});
  }
  std::array<std::uint8_t, (kMaxMantissaBits + 1) * 4> row{};
  bench.encoder().readPixels(bench.target(), {0, 0, kMaxMantissaBits + 1, 1}, row.data());
  int measured = 0;
  while (measured < kMaxMantissaBits && row[static_cast<std::size_t>(measured + 1) * 4] > 127) ++measured;
  return measured;
}

/// A coordinate of 2^j + (i + 0.5)/256 on a REPEAT texture of 256 texels finds texel i as long as the varying
/// keeps j + 9 bits below its leading one.
int measureVaryingMantissaBits(ProbeBench& bench, std::string_view precision) {
  constexpr int kTexels = 256, kTexelBits = 8;
  constexpr std::array<int, 4> kSamples{0, 85, 170, 255};
  Context& context = bench.context();
  std::vector<std::uint8_t> texels(kTexels * 4);
  for (int i = 0; i < kTexels * 4; ++i)
    texels[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i / 4);
  Result<Texture> ramp =
      Texture::create(context, {.width = kTexels, .height = 1, .wrap = TextureWrap::repeat}, texels.data());
  Result<Program> program = bench.programOf(
      "attribute vec2 a_position;\nuniform highp float u_coordinate;\nvarying " + std::string(precision) +
          " vec2 v_coordinate;\n"
          "void main() { v_coordinate = vec2(u_coordinate, 0.5); gl_Position = vec4(a_position, 0.0, 1.0); "
          "}\n",
      precisionLine(precision) + "uniform sampler2D u_ramp;\nvarying " + std::string(precision) +
          " vec2 v_coordinate;\nvoid main() { gl_FragColor = texture2D(u_ramp, v_coordinate); }\n");
  if (!ramp || !program) return 0;
  const TextureBinding binding{program->samplerUnit("u_ramp"), &*ramp};
  int measured = 0;
  for (int j = 0; j + kTexelBits + 1 <= kMaxMantissaBits; ++j) {
    for (std::size_t s = 0; s < kSamples.size(); ++s) {
      bench.encoder().useProgram(*program);
      bench.encoder().bindTextures(std::span(&binding, 1));
      program->set(context, "u_coordinate",
                   std::ldexp(1.0f, j) + (static_cast<float>(kSamples[s]) + 0.5f) / kTexels);
      bench.draw(bench.target(), *program, {static_cast<int>(s), 0, 1, 1});
    }
    std::array<std::uint8_t, kSamples.size() * 4> row{};
    bench.encoder().readPixels(bench.target(), {0, 0, static_cast<int>(kSamples.size()), 1}, row.data());
    for (std::size_t s = 0; s < kSamples.size(); ++s) {
      if (row[s * 4] != kSamples[s]) return measured;
    }
    measured = j + kTexelBits + 1;
  }
  return measured;
}

/// Two ramps a quarter step above and below each byte value tell nearest from truncation.
device::ByteRounding measureByteRounding(ProbeBench& bench, std::string_view precision) {
  Result<Program> program =
      bench.program(precisionLine(precision) +
                    "uniform float u_shift;\n"
                    "void main() { gl_FragColor = vec4((floor(gl_FragCoord.x) + u_shift) / 255.0); }\n");
  if (!program) return device::ByteRounding::other;
  const auto ramp = [&](float shift) {
    bench.encoder().useProgram(*program);
    program->set(bench.context(), "u_shift", shift);
    bench.draw(bench.target(), *program, {0, 0, ProbeBench::kWidth, 1});
    std::vector<std::uint8_t> row(ProbeBench::kWidth * 4);
    bench.encoder().readPixels(bench.target(), {0, 0, ProbeBench::kWidth, 1}, row.data());
    return row;
  };
  const std::vector<std::uint8_t> low = ramp(0.25f), high = ramp(0.75f);
  bool lowFloors = true, highFloors = true, highRises = true;
  for (int k = 0; k < 255; ++k) {  // 255 saturates
    const std::size_t at = static_cast<std::size_t>(k) * 4;
    lowFloors = lowFloors && low[at] == k;
    highFloors = highFloors && high[at] == k;
    highRises = highRises && high[at] == k + 1;
  }
  if (lowFloors && highRises) return device::ByteRounding::nearest;
  if (lowFloors && highFloors) return device::ByteRounding::truncate;
  return device::ByteRounding::other;
}

}  // namespace halfshadow::gl
