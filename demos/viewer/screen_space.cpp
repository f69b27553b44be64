// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/screen_space.hpp"

#include <cmath>

namespace halfshadow::viewer {

ScreenSpace::ScreenSpace(const scene::Camera& camera, double width, double height)
    : eye_(camera.eyeWorld),
      tanHalf_(std::tan(camera.verticalFovRadians / 2)),
      width_(width),
      height_(height) {
  const glm::dmat4 view = scene::viewFromWorld(camera);
  right_ = {view[0][0], view[1][0], view[2][0]};
  up_ = {view[0][1], view[1][1], view[2][1]};
  forward_ = -glm::dvec3(view[0][2], view[1][2], view[2][2]);
}

std::optional<glm::dvec2> ScreenSpace::fromWorld(const glm::dvec3& pointWorld) const {
  const glm::dvec3 offset = pointWorld - eye_;
  const double depth = glm::dot(offset, forward_);
  if (!(depth > 1e-12 * glm::length(offset))) return std::nullopt;
  const double scale = 0.5 * height_ / (tanHalf_ * depth);
  return glm::dvec2(0.5 * width_ + glm::dot(offset, right_) * scale,
                    0.5 * height_ - glm::dot(offset, up_) * scale);
}

glm::dvec3 ScreenSpace::rayWorld(const glm::dvec2& pixel) const {
  const double perPixel = 2.0 * tanHalf_ / height_;
  return glm::normalize(forward_ + right_ * ((pixel.x - 0.5 * width_) * perPixel) -
                        up_ * ((pixel.y - 0.5 * height_) * perPixel));
}

std::optional<glm::dvec3> ScreenSpace::atDepthOf(const glm::dvec2& pixel, const glm::dvec3& depthOf) const {
  const double depth = glm::dot(depthOf - eye_, forward_);
  if (!(depth > 0.0)) return std::nullopt;
  const glm::dvec3 ray = rayWorld(pixel);
  return eye_ + ray * (depth / glm::dot(ray, forward_));
}

std::optional<ScreenSpace::Line> ScreenSpace::lineFromWorld(const glm::dvec3& aWorld,
                                                            const glm::dvec3& bWorld) const {
  constexpr double kNearest = 1e-6;  // of the segment's own distance: beyond it nothing overflows
  glm::dvec3 a = aWorld, b = bWorld;
  const double depthA = glm::dot(a - eye_, forward_), depthB = glm::dot(b - eye_, forward_);
  const double nearest = kNearest * (std::abs(depthA) + std::abs(depthB));
  if (depthA <= nearest && depthB <= nearest) return std::nullopt;
  if (depthA < nearest) a = b + (a - b) * ((depthB - nearest) / (depthB - depthA));
  if (depthB < nearest) b = a + (b - a) * ((depthA - nearest) / (depthA - depthB));
  const auto onScreenA = fromWorld(a), onScreenB = fromWorld(b);
  if (!onScreenA || !onScreenB) return std::nullopt;
  return Line{*onScreenA, *onScreenB};
}

}  // namespace halfshadow::viewer
