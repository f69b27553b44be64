// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cstdio>

#include "gl_fixture.hpp"
#include "test_programs.hpp"

namespace halfshadow::test {
namespace {

using device::Capability;
using device::ProbeOutcome;

class Capabilities : public GlTest {};

TEST_F(Capabilities, AreReportedWithAReasonEach) {
  const device::Capabilities& found = capabilities();
  std::printf("%s | %s\n", found.driver.renderer.c_str(), found.driver.version.c_str());
  for (std::size_t i = 0; i < device::kCapabilityCount; ++i) {
    const auto capability = static_cast<Capability>(i);
    const device::CapabilityState& state = found.state(capability);
    EXPECT_FALSE(state.reason.empty()) << device::capabilityName(capability);
    EXPECT_NE(state.outcome, ProbeOutcome::forcedOff) << device::capabilityName(capability);
    std::printf("  %-22s %d  %s\n", std::string(device::capabilityName(capability)).c_str(),
                static_cast<int>(state.outcome), state.reason.c_str());
  }
  std::printf("  mantissa bits: highp %d, mediump %d, varying %d; byte rounding %d\n",
              found.probes.highpMantissaBits, found.probes.mediumpMantissaBits,
              found.probes.varyingMantissaBits, static_cast<int>(found.probes.byteRounding));
  for (const device::Quirk& quirk : found.quirks) {
    std::printf("  quirk %s: %s\n", quirk.name.c_str(), quirk.sentence.c_str());
  }
}

TEST_F(Capabilities, NoProbeFailsOnDriversKnownToBeSound) {
  const std::string& renderer = capabilities().driver.renderer;
  const bool known = renderer.find("llvmpipe") != std::string::npos ||
                     renderer.find("softpipe") != std::string::npos ||
                     renderer.find("SwiftShader") != std::string::npos;
  if (!known) GTEST_SKIP() << renderer << " is not one of the software rasterizers whose answers are known";
  for (std::size_t i = 0; i < device::kCapabilityCount; ++i) {
    const device::CapabilityState& state = capabilities().states[i];
    EXPECT_NE(state.outcome, ProbeOutcome::probeFailed) << state.reason;
  }
  EXPECT_TRUE(capabilities().has(Capability::depthTexture));
  EXPECT_EQ(capabilities().probes.highpMantissaBits, 23);  // all three compute highp in IEEE single precision
  EXPECT_EQ(capabilities().probes.byteRounding, device::ByteRounding::nearest);
  // A varying used as a coordinate: 23 bits less one for the rasterizer's interpolation.
  EXPECT_GE(capabilities().probes.varyingMantissaBits, 22);
}

TEST_F(Capabilities, LlvmpipeRunsMediumpAsHalfFloats) {
  if (capabilities().driver.renderer.find("llvmpipe") == std::string::npos) {
    GTEST_SKIP() << "only llvmpipe is known to compute mediump in half floats";
  }
  const int bits = capabilities().probes.mediumpMantissaBits;
  if (bits == 23)
    GTEST_SKIP() << "this CPU has no half-float conversions (F16C): mediump is single precision here";
  EXPECT_EQ(bits, 10);
}

TEST_F(Capabilities, MeetTheMinimaOfTheSpecification) {
  const device::Limits& limits = capabilities().limits;
  EXPECT_GE(limits.textureSize, 64);
  EXPECT_GE(limits.renderbufferSize, 1);
  EXPECT_GE(limits.varyingVectors, 8);
  EXPECT_GE(limits.vertexUniformVectors, 128);
  EXPECT_GE(limits.fragmentUniformVectors, 16);
  EXPECT_GE(limits.fragmentTextureUnits, 8);
  EXPECT_GE(limits.vertexAttributes, 8);
}

TEST_F(Capabilities, NamesFindTheirCapability) {
  for (std::size_t i = 0; i < device::kCapabilityCount; ++i) {
    const auto capability = static_cast<Capability>(i);
    const Result<Capability> found = device::capabilityFromName(device::capabilityName(capability));
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, capability);
    EXPECT_FALSE(device::capabilityText(capability).empty());
  }
  const Result<Capability> unknown = device::capabilityFromName("ray-tracing");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::invalidArgument);
  EXPECT_NE(unknown.error().message.find("depth-texture"), std::string::npos)
      << "the message lists the known names";
}

TEST_F(Capabilities, EachCanBeForcedOff) {
  for (std::size_t i = 0; i < device::kCapabilityCount; ++i) {
    const auto forced = static_cast<Capability>(i);
    const Result<std::unique_ptr<gl::Context>> made = makeContext({.forcedOff = {forced}});
    ASSERT_TRUE(made);
    for (std::size_t k = 0; k < device::kCapabilityCount; ++k) {
      const auto capability = static_cast<Capability>(k);
      const device::Capabilities& found = (*made)->capabilities();
      if (capability == forced) {
        EXPECT_EQ(found.state(capability).outcome, ProbeOutcome::forcedOff)
            << device::capabilityName(capability);
        EXPECT_FALSE(found.has(capability));
      } else {
        EXPECT_EQ(found.state(capability).outcome, capabilities().state(capability).outcome)
            << device::capabilityName(capability) << " changed with " << device::capabilityName(forced)
            << " off";
      }
    }
  }
}

TEST_F(Capabilities, HighpForcedOffMakesFragmentShadersMediump) {
  const Result<std::unique_ptr<gl::Context>> made = makeContext({.forcedOff = {Capability::highp}});
  ASSERT_TRUE(made);
  const device::Capabilities& found = (*made)->capabilities();
  const Result<std::string> source = gl::assembleShader(provide(paintFiles()), "paint.frag", {}, found);
  ASSERT_TRUE(source);
  EXPECT_NE(source->find("#define HS_NO_HIGHP"), std::string::npos);
  // The varying probe then runs at mediump too. A varying used straight as a coordinate may keep more bits
  // than mediump arithmetic has (llvmpipe: 23), but not fewer.
  EXPECT_GE(found.probes.varyingMantissaBits, std::min(capabilities().probes.mediumpMantissaBits, 22));
}

TEST_F(Capabilities, ProbesLeaveNothingBehind) {
  const Result<std::unique_ptr<gl::Context>> made = makeContext();
  ASSERT_TRUE(made);
  EXPECT_EQ((*made)->liveObjects().total(), 0);
  EXPECT_TRUE((*made)->checkErrors("after create"));
  EXPECT_EQ((*made)->uploads().textureBytes, 0u);
}

TEST(CapabilitiesWithoutDriver, MissingEntryPointsAreNamed) {
  const auto made = gl::Context::create([](const char*) -> void* { return nullptr; }, {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::driverMissing);
  EXPECT_NE(made.error().message.find("glDrawElements"), std::string::npos);
}

TEST(Headless, RefusesWhatItDoesNotKnow) {
  HeadlessOptions options;
  options.driver = "voodoo";
  const auto unknown = createHeadless(options);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::invalidArgument);

  options.driver = "default";
  options.eglLibrary = "libEGL-that-does-not-exist.so";
  const auto absent = createHeadless(options);
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::driverMissing);
  EXPECT_NE(absent.error().message.find("libEGL-that-does-not-exist.so"), std::string::npos);
  EXPECT_NE(absent.error().message.find("libegl-mesa0"), std::string::npos)
      << "the message names the packages";
}

}  // namespace
}  // namespace halfshadow::test
