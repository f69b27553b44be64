// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Between the world and the pixels of the picture; x right and y down from its top left corner.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/camera.hpp"

namespace halfshadow::viewer {

class ScreenSpace {
 public:
  ScreenSpace(const scene::Camera& camera, double width, double height);
  /// Nothing for what lies behind the eye.
  std::optional<glm::dvec2> fromWorld(const glm::dvec3& pointWorld) const;
  /// Where the ray through the pixel reaches the depth of `depthOf` along the view; nothing when that lies
  /// behind the eye.
  std::optional<glm::dvec3> atDepthOf(const glm::dvec2& pixel, const glm::dvec3& depthOf) const;
  /// Unit direction through a pixel.
  glm::dvec3 rayWorld(const glm::dvec2& pixel) const;
  const glm::dvec3& eyeWorld() const { return eye_; }
  /// The part of a segment in front of the eye, on the screen.
  struct Line {
    glm::dvec2 a, b;
  };
  std::optional<Line> lineFromWorld(const glm::dvec3& aWorld, const glm::dvec3& bWorld) const;

 private:
  glm::dvec3 eye_, right_, up_, forward_;
  double tanHalf_, width_, height_;
};

}  // namespace halfshadow::viewer
