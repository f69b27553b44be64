// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/probes.hpp"

#include <algorithm>
#include <functional>
#include <initializer_list>

#include "gl/probe_bench.hpp"

namespace halfshadow::gl {
namespace {

constexpr int kMinHighpMantissaBits = 16;

class Prober {
 public:
  Prober(ProbeBench& bench, device::Capabilities& capabilities)
      : bench_(bench), capabilities_(capabilities) {}

  /// The first of `extensions` that the driver lists, or empty.
  std::string advertised(std::initializer_list<const char*> extensions) const {
    const auto& list = capabilities_.extensions;
    for (const char* extension : extensions) {
      if (std::binary_search(list.begin(), list.end(), extension)) return extension;
    }
    return {};
  }

  device::CapabilityState& state(device::Capability capability) {
    return capabilities_.states[static_cast<std::size_t>(capability)];
  }

  /// Runs `probe` when one of the extensions is listed and notes the outcome.
  void decide(device::Capability capability, std::initializer_list<const char*> extensions,
              const std::function<ProbeFailure()>& probe) {
    const std::string found = advertised(extensions);
    if (found.empty()) {
      state(capability) = {device::ProbeOutcome::notAdvertised,
                           std::string(*extensions.begin()) + " is not listed"};
      return;
    }
    note(capability, found, probe());
  }

  void note(device::Capability capability, const std::string& what, const ProbeFailure& failure) {
    // A probe that raised an error failed, whatever it read back.
    const Status errors = bench_.context().checkErrors("probe");
    if (!failure.empty()) {
      state(capability) = {device::ProbeOutcome::probeFailed, failure};
    } else if (!errors) {
      state(capability) = {device::ProbeOutcome::probeFailed, errors.error().message};
    } else {
      state(capability) = {device::ProbeOutcome::available, what + ", verified by rendering"};
    }
  }

 private:
  ProbeBench& bench_;
  device::Capabilities& capabilities_;
};

}  // namespace

void probeCapabilities(Context& context, device::Capabilities& capabilities,
                       const std::vector<device::Capability>& forcedOff) {
  // Errors that the host left are not the probes'.
  static_cast<void>(context.checkErrors("before the probes").ok());
  ProbeBench bench(context);
  if (!bench.ready()) {
    for (device::CapabilityState& state : capabilities.states) {
      state = {device::ProbeOutcome::probeFailed, "no RGBA8 framebuffer object can be made"};
    }
    static_cast<void>(context.checkErrors("probe target").ok());
    return;
  }
  Prober prober(bench, capabilities);
  device::Probes& probes = capabilities.probes;

  probes.mediumpMantissaBits = measureMantissaBits(bench, "mediump");
  probes.highpMantissaBits = measureMantissaBits(bench, "highp");
  const bool highp = probes.highpMantissaBits >= kMinHighpMantissaBits;
  const std::string bitsText = std::to_string(probes.highpMantissaBits) + " mantissa bits measured";
  if (probes.highpMantissaBits == 0) {
    prober.state(device::Capability::highp) = {device::ProbeOutcome::notAdvertised,
                                               "no highp fragment shader compiles"};
    static_cast<void>(context.checkErrors("highp").ok());
  } else {
    prober.note(device::Capability::highp, bitsText, highp ? ProbeFailure() : "only " + bitsText);
  }
  const char* best = highp ? "highp" : "mediump";
  const bool highpForcedOff =
      std::find(forcedOff.begin(), forcedOff.end(), device::Capability::highp) != forcedOff.end();
  probes.varyingMantissaBits = measureVaryingMantissaBits(bench, highpForcedOff ? "mediump" : best);
  probes.byteRounding = measureByteRounding(bench, best);

  prober.decide(
      device::Capability::depthTexture,
      {"GL_OES_depth_texture", "GL_ANGLE_depth_texture", "GL_WEBGL_depth_texture", "WEBGL_depth_texture"},
      [&] { return probeDepthTexture(bench); });
  const bool depthTextures = capabilities.has(device::Capability::depthTexture);
  prober.decide(device::Capability::depth24, {"GL_OES_depth24"},
                [&] { return probeDepth24(bench, depthTextures, highp); });
  prober.decide(device::Capability::packedDepthStencil, {"GL_OES_packed_depth_stencil"},
                [&] { return probePackedDepthStencil(bench, depthTextures); });
  prober.decide(device::Capability::blendMinmax, {"GL_EXT_blend_minmax", "EXT_blend_minmax"},
                [&] { return probeBlendMinmax(bench); });
  const std::string fetch =
      prober.advertised({"GL_EXT_shader_framebuffer_fetch", "GL_ARM_shader_framebuffer_fetch",
                         "GL_NV_shader_framebuffer_fetch"});
  prober.decide(device::Capability::framebufferFetch,
                {"GL_EXT_shader_framebuffer_fetch", "GL_ARM_shader_framebuffer_fetch",
                 "GL_NV_shader_framebuffer_fetch"},
                [&] { return probeFramebufferFetch(bench, fetch); });
  prober.decide(device::Capability::derivatives, {"GL_OES_standard_derivatives", "OES_standard_derivatives"},
                [&] { return probeDerivatives(bench); });
  prober.decide(device::Capability::discard, {"GL_EXT_discard_framebuffer"},
                [&] { return probeDiscard(bench); });
  prober.decide(device::Capability::uintIndex, {"GL_OES_element_index_uint", "OES_element_index_uint"},
                [&] { return probeUintIndex(bench); });
  prober.decide(device::Capability::textureLod, {"GL_EXT_shader_texture_lod", "EXT_shader_texture_lod"},
                [&] { return probeTextureLod(bench); });
  prober.decide(device::Capability::timerQuery, {"GL_EXT_disjoint_timer_query"},
                [&] { return probeTimerQuery(bench); });

  if (ProbeFailure failure = probeSeparateDepthStencil(bench); !failure.empty()) {
    capabilities.quirks.push_back(
        {"no-separate-stencil",
         "A 16-bit depth and an 8-bit stencil renderbuffer do not work together in one framebuffer object: " +
             failure});
  }
  static_cast<void>(context.checkErrors("probes").ok());
  for (const device::Capability forced : forcedOff) {
    prober.state(forced) = {device::ProbeOutcome::forcedOff, "forced off by the caller"};
  }
}

}  // namespace halfshadow::gl
