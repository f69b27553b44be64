// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Triangles far wider than the view: what is cut stays in their plane, covers the view, and keeps its
// attributes.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/bounds.hpp"
#include "scene/camera.hpp"
#include "scene/view_cut.hpp"

namespace halfshadow::scene {
namespace {

/// Wound upward in y = 0, its normals up; texture coordinates are the position over its half side.
TriangleMesh ground(float half) {
  TriangleMesh mesh;
  mesh.positions = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.normals.assign(4, {0, 1, 0});
  mesh.texcoords = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};
  return mesh;
}

ObjectView viewFrom(const Camera& camera, const glm::dmat4& worldFromObject) {
  return {.clipFromObject = clipFromView(camera, 4.0 / 3.0) * viewFromWorld(camera) * worldFromObject,
          .worldFromObject = worldFromObject,
          .eyeWorld = camera.eyeWorld,
          .nearDistance = camera.nearDistance,
          .pixelAngle = 2.0 * std::tan(0.5 * camera.verticalFovRadians) / 480.0};
}

/// Where the ray through (x, y) in [-1, 1] meets the mesh; false when it does not.
bool meets(const TriangleMesh& mesh, const ObjectView& view, double x, double y) {
  const glm::dmat4 inverse = glm::inverse(view.clipFromObject);
  const glm::dvec4 from = inverse * glm::dvec4(x, y, -1, 1), to = inverse * glm::dvec4(x, y, 1, 1);
  const glm::dvec3 a = glm::dvec3(from) / from.w, b = glm::dvec3(to) / to.w;
  const glm::dvec3 at = glm::mix(a, b, a.y / (a.y - b.y));
  if ((a.y > 0.0) == (b.y > 0.0)) return false;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p(mesh.positions[mesh.indices[t + k]]),
          q(mesh.positions[mesh.indices[t + (k + 1) % 3]]);
      inside = inside && glm::cross(q - p, at - p).y >= -1e-6 * glm::length(q - p) * glm::length(at - p);
    }
    if (inside) return true;
  }
  return false;
}

const Camera kCamera{.eyeWorld = {4, 6, 7}, .targetWorld = {0, 0, 0}};

TEST(ViewCut, TrianglesThatAPixelTellsNothingOfStay) {
  for (const float half : {10.0f, 1000.0f})
    EXPECT_FALSE(cutToView(ground(half), viewFrom(kCamera, glm::dmat4(1.0)))) << half;
  // Small triangles, however many and far spread.
  TriangleMesh spread;
  for (int k = 0; k < 100; ++k) {
    const auto x = static_cast<float>(k * 1e5);
    for (const glm::vec3& corner : {glm::vec3(x, 0, 0), glm::vec3(x, 0, 1), glm::vec3(x + 1, 0, 0)}) {
      spread.indices.push_back(static_cast<std::uint32_t>(spread.positions.size()));
      spread.positions.push_back(corner);
    }
  }
  EXPECT_FALSE(cutToView(spread, viewFrom(kCamera, glm::dmat4(1.0))));
}

TEST(ViewCut, WideTrianglesAreCutToWhatIsSeen) {
  for (const double half : {1e5, 1e6, 1e7}) {
    for (const double scale : {1.0, 1e-3, 1e4}) {
      const glm::dmat4 worldFromObject = glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
      const ObjectView view = viewFrom(kCamera, worldFromObject);
      const auto cut = cutToView(ground(static_cast<float>(half / scale)), view);
      ASSERT_TRUE(cut) << half << " " << scale;
      ASSERT_FALSE(cut->indices.empty());
      // Everything below the horizon is seen, in a view all of which looks down.
      for (double y = -0.99; y <= 0.99; y += 0.11) {
        for (double x = -0.99; x <= 0.99; x += 0.11)
          EXPECT_TRUE(meets(*cut, view, x, y)) << half << " " << scale << ": " << x << ", " << y;
      }
      ASSERT_EQ(cut->normals.size(), cut->positions.size());
      ASSERT_EQ(cut->texcoords.size(), cut->positions.size());
      for (std::size_t v = 0; v < cut->positions.size(); ++v) {
        const glm::vec3& p = cut->positions[v];
        EXPECT_EQ(p.y, 0.0f);
        EXPECT_LE(glm::length(glm::dvec2(p.x, p.z)) * scale, 100.0);
        EXPECT_EQ(cut->normals[v], glm::vec3(0, 1, 0));
        EXPECT_NEAR(cut->texcoords[v].x, p.x * scale / half, 1e-6);
        EXPECT_NEAR(cut->texcoords[v].y, p.z * scale / half, 1e-6);
      }
      for (std::size_t t = 0; t < cut->indices.size(); t += 3) {
        const auto at = [&](std::size_t k) { return cut->positions[cut->indices[t + k]]; };
        EXPECT_GE(glm::cross(at(1) - at(0), at(2) - at(0)).y, 0.0f) << "turned round";
      }
    }
  }
}

TEST(ViewCut, WhatLiesBehindTheCameraIsCutAway) {
  const Camera up{.eyeWorld = {0, 1, 0}, .targetWorld = {0.1, 9, 0}};
  const auto cut = cutToView(ground(1e6f), viewFrom(up, glm::dmat4(1.0)));
  ASSERT_TRUE(cut);
  EXPECT_TRUE(cut->indices.empty());
}

}  // namespace
}  // namespace halfshadow::scene
