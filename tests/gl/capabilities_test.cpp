// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cstdio>

#include "gl_fixture.hpp"

namespace halfshadow::test {
namespace {

using gl::Capability;
using gl::ProbeOutcome;

class Capabilities : public GlTest {};

TEST_F(Capabilities, AreReportedWithAReasonEach) {
  const gl::Capabilities& found = capabilities();
  std::printf("%s | %s\n", found.driver.renderer.c_str(), found.driver.version.c_str());
  for (std::size_t i = 0; i < gl::kCapabilityCount; ++i) {
    const auto capability = static_cast<Capability>(i);
    const gl::CapabilityState& state = found.state(capability);
    EXPECT_FALSE(state.reason.empty()) << gl::capabilityName(capability);
    EXPECT_NE(state.outcome, ProbeOutcome::forcedOff) << gl::capabilityName(capability);
    std::printf("  %-22s %d  %s\n", std::string(gl::capabilityName(capability)).c_str(),
                static_cast<int>(state.outcome), state.reason.c_str());
  }
  std::printf("  mantissa bits: highp %d, mediump %d, varying %d; byte rounding %d\n",
              found.probes.highpMantissaBits, found.probes.mediumpMantissaBits,
              found.probes.varyingMantissaBits, static_cast<int>(found.probes.byteRounding));
  for (const gl::Quirk& quirk : found.quirks)
    std::printf("  quirk %s: %s\n", quirk.name.c_str(), quirk.sentence.c_str());
}

}  // namespace
}  // namespace halfshadow::test
