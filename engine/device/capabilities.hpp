// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What this context can do: limits, capabilities (each advertised, probed by rendering, and forcible off),
/// quirks. Filled once per context.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace halfshadow::device {

struct Limits {
  int textureSize = 64;
  int renderbufferSize = 1;
  int varyingVectors = 8;
  int vertexUniformVectors = 128;
  int fragmentUniformVectors = 16;
  int fragmentTextureUnits = 8;
  int vertexTextureUnits = 0;
  int vertexAttributes = 8;
  int subpixelBits = 4;  ///< rasterisers snap vertices to 2^-this of a pixel
};

// X(enumerator, "option-name", "what it gives")
#define HALFSHADOW_CAPABILITY_LIST(X)                                                                  \
  X(depthTexture, "depth-texture", "shadow depth is sampled from a depth texture (OES_depth_texture)") \
  X(depth24, "depth-24", "depth textures and renderbuffers of 24 bits")                                \
  X(packedDepthStencil, "packed-depth-stencil", "depth and stencil together in a framebuffer object")  \
  X(blendMinmax, "blend-minmax", "MIN and MAX blending (EXT_blend_minmax)")                            \
  X(framebufferFetch, "framebuffer-fetch", "a fragment reads the pixel it writes")                     \
  X(highp, "highp", "fragment shaders compute in at least 16-bit mantissa, measured by rendering")     \
  X(derivatives, "derivatives", "dFdx and dFdy in fragment shaders (OES_standard_derivatives)")        \
  X(discard, "discard", "attachments can be discarded unstored (EXT_discard_framebuffer)")             \
  X(uintIndex, "uint-index", "32-bit element indices (OES_element_index_uint)")                        \
  X(textureLod, "texture-lod", "explicit mip level in fragment shaders (EXT_shader_texture_lod)")      \
  X(timerQuery, "timer-query", "GPU times by EXT_disjoint_timer_query")

enum class Capability : int {
#define HALFSHADOW_CAPABILITY_ENUM(name, option, text) name,
  HALFSHADOW_CAPABILITY_LIST(HALFSHADOW_CAPABILITY_ENUM)
#undef HALFSHADOW_CAPABILITY_ENUM
};
#define HALFSHADOW_CAPABILITY_COUNT(name, option, text) +1
inline constexpr std::size_t kCapabilityCount = 0 HALFSHADOW_CAPABILITY_LIST(HALFSHADOW_CAPABILITY_COUNT);
#undef HALFSHADOW_CAPABILITY_COUNT

/// The option's name, e.g. "depth-texture".
std::string_view capabilityName(Capability capability);
std::string_view capabilityText(Capability capability);
/// Errors: invalidArgument, listing the known names.
Result<Capability> capabilityFromName(std::string_view name);

enum class ProbeOutcome { available, notAdvertised, probeFailed, forcedOff };

struct CapabilityState {
  ProbeOutcome outcome = ProbeOutcome::notAdvertised;
  std::string reason;  ///< one clause: which extension is missing, what the probe read back, who forced it
};

/// How an 8-bit target stores a value between two steps, measured by rendering ramps.
enum class ByteRounding { nearest, truncate, other };

struct Probes {
  int highpMantissaBits = 0;    ///< explicit mantissa bits a highp fragment computes with; 0 = no highp
  int mediumpMantissaBits = 0;  ///< the same for mediump; 10 = fp16
  ByteRounding byteRounding = ByteRounding::other;
  int varyingMantissaBits =
      0;  ///< of a highp (else mediump) varying passed straight to a NEAREST fetch; 0 = not measured
};

/// A named work-around.
struct Quirk {
  std::string name;
  std::string sentence;
};

struct DriverIdentity {
  std::string vendor, renderer, version, shadingLanguageVersion;
};

struct Capabilities {
  DriverIdentity driver;
  Limits limits;
  std::array<CapabilityState, kCapabilityCount> states;
  Probes probes;
  std::vector<Quirk> quirks;
  std::vector<std::string> extensions;

  bool has(Capability capability) const {
    return states[static_cast<std::size_t>(capability)].outcome == ProbeOutcome::available;
  }
  const CapabilityState& state(Capability capability) const {
    return states[static_cast<std::size_t>(capability)];
  }
};

}  // namespace halfshadow::device
