// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where a host draws.
#pragma once

#include <gtest/gtest.h>

#include "engine_fixture.hpp"

namespace halfshadow::test {

/// A host's framebuffer of some size: its own images, which are not the engine's.
class HostFramebuffer {
 public:
  HostFramebuffer(int width, int height) {
    const gl::Functions& gl = hostGl();
    gl.genTextures(1, &color_);
    gl.bindTexture(GL_TEXTURE_2D, color_);
    gl.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl.genRenderbuffers(1, &depth_);
    gl.bindRenderbuffer(GL_RENDERBUFFER, depth_);
    gl.renderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, width, height);
    gl.genFramebuffers(1, &name_);
    gl.bindFramebuffer(GL_FRAMEBUFFER, name_);
    gl.framebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
    gl.framebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    EXPECT_EQ(gl.checkFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.bindTexture(GL_TEXTURE_2D, 0);
  }
  HostFramebuffer(const HostFramebuffer&) = delete;
  HostFramebuffer& operator=(const HostFramebuffer&) = delete;
  ~HostFramebuffer() {
    hostGl().deleteFramebuffers(1, &name_);
    hostGl().deleteRenderbuffers(1, &depth_);
    hostGl().deleteTextures(1, &color_);
  }
  GLuint name() const { return name_; }

 private:
  GLuint color_ = 0, depth_ = 0, name_ = 0;
};

}  // namespace halfshadow::test
