// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A host that draws a scene's receivers by itself, with OpenGL ES alone: its own program around the engine's
/// texts, buffers, framebuffer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gl/functions.hpp"
#include "halfshadow/halfshadow.hpp"
#include "host_framebuffer.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::test {

class ForwardHost {
 public:
  ForwardHost(const scene::SceneDescription& scene, int width, int height);
  ~ForwardHost();
  ForwardHost(const ForwardHost&) = delete;
  ForwardHost& operator=(const ForwardHost&) = delete;

  /// A program that shows visibility; 0, and a test failure, when it does not link. Deleted with the host.
  GLuint link(const ForwardRecord& texts);
  /// The named objects by this program, bound for each by the engine; visibility a pixel, 255 beside them.
  std::vector<std::uint8_t> draw(Engine& engine, GLuint program, std::size_t light,
                                 const std::vector<std::size_t>& objects);
  /// How many are darker than half.
  static std::size_t dark(const std::vector<std::uint8_t>& picture);
  void look(const scene::Camera& camera) { camera_ = camera; }

 private:
  const scene::SceneDescription& scene_;
  scene::Camera camera_;
  int width_ = 0, height_ = 0;
  HostFramebuffer framebuffer_;
  std::vector<GLuint> buffers_, programs_;
};

}  // namespace halfshadow::test
