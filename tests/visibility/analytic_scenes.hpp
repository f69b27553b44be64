// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Scenes whose visibility is known on paper. Casters are not drawn (receives = false), so that the camera
/// sees the ground below them; every pixel's ground point follows from the camera alone.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine_fixture.hpp"

namespace halfshadow::test {

scene::SceneObject boxObject(const glm::dvec3& center, const glm::dvec3& half);
/// y = 0, 2 · half wide; receives only.
scene::SceneObject groundPlane(double half);
/// Light above `center`'s ground, emitting downwards, sides along x and z turned by `turnRadians`.
scene::AreaLight lightAbove(const glm::dvec3& center, double halfU, double halfV, double turnRadians = 0.0);
/// Looks straight down at (x, 0, z); image x is world x, image y (downwards) is world z; `halfHeight` world
/// units from the middle of the image to its top.
scene::Camera cameraAbove(double x, double z, double halfHeight);
/// The ground point in the middle of a pixel.
glm::dvec3 groundPoint(const scene::Camera& camera, int width, int height, int x, int y);

/// A thin square plate, parallel to a square light above it, over the ground.
struct PlateOverGround {
  double lightHeight = 12.0, lightHalf = 1.0, plateHeight = 3.0, plateHalf = 1.5;

  scene::AreaLight light() const;
  scene::Camera camera() const { return cameraAbove(0.0, 0.0, 2.7); }
  scene::SceneDescription scene() const;
  /// By the closed form.
  double visibility(const glm::dvec3& groundWorld) const;
  std::vector<float> visibilityImage() const;
  /// Half sides of the umbra's and of the lit region's squares on the ground.
  double umbraHalf() const;
  double litHalf() const;
  /// Of the light's centre: where hard shadows end.
  double hardHalf() const { return plateHalf * lightHeight / (lightHeight - plateHeight); }
  double pixelWorld() const;
};

/// A thin wall on the ground, lit at 45 degrees from -x by a point: its shadow begins at its foot.
struct StandingWall {
  static constexpr int kMapSize = 256;
  double halfThickness = 0.01;

  scene::SceneDescription scene() const;
  /// Length on the ground, along the light's direction, of a texel of the map.
  double texelWorld() const;
  double pixelWorld() const;
  /// Distance from the wall's far side to the first shadowed pixel, along the middle row.
  double gapWorld(const Image& image) const;
};

}  // namespace halfshadow::test
