// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// For tests that render: one headless context and one gl::Context per process, on the driver named by
/// HALFSHADOW_TEST_DRIVER (else "default"). After each test: no GL error, no leaked object.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "egl/headless.hpp"
#include "gl/context.hpp"
#include "gl/encoder.hpp"

namespace halfshadow::test {

/// Another gl::Context on the same headless context, with capabilities forced off.
Result<std::unique_ptr<gl::Context>> makeContext(const gl::ContextOptions& options = {});

class GlTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  static gl::Context& context();
  static const device::Capabilities& capabilities() { return context().capabilities(); }
  static HeadlessContext& headless();

 private:
  int liveBefore_ = 0;
};

using Rgba = std::array<std::uint8_t, 4>;
Rgba readPixel(gl::Encoder& encoder, const gl::Framebuffer& framebuffer, int x, int y);

}  // namespace halfshadow::test
