// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Volumes as geometry: closed, as thick as they say, and where they may be looked for. No GL.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "planner/light_fit.hpp"
#include "scene/camera.hpp"
#include "scenes/shapes.hpp"
#include "techniques/shadow_volume/volume_mesh.hpp"
#include "techniques/shadow_volume/volume_view.hpp"

namespace halfshadow::test {
namespace {
using techniques::VolumeChunk;
using techniques::VolumeMesh;
using techniques::VolumeSurface;

VolumeMesh volumeOf(const scenes::Shape& shape, const glm::dvec3& light, VolumeSurface surface,
                    std::uint32_t maxVertices, int maxLayers, std::vector<VolumeChunk>* chunks = nullptr) {
  const auto mesh = scenes::meshOf(shape);
  const scene::HalfEdgeMesh halfEdges = scene::HalfEdgeMesh::build(*mesh);
  scene::Silhouette silhouette;
  scene::extractSilhouette(halfEdges, light, silhouette);
  const auto found = techniques::volumeChunks(halfEdges, silhouette, light, maxLayers);
  if (chunks) *chunks = found;
  return techniques::buildVolumeMesh(halfEdges, silhouette, found, glm::dmat4(1.0), light, surface,
                                     maxVertices);
}

/// Directed edges that no triangle runs back along, counted with their sign. Vertices are told apart by
/// value: ranges repeat them.
int unmatchedEdges(const VolumeMesh& mesh) {
  const auto key = [](const glm::vec4& v) { return std::array<float, 4>{v.x, v.y, v.z, v.w}; };
  std::map<std::pair<std::array<float, 4>, std::array<float, 4>>, int> count;
  for (const VolumeMesh::Range& range : mesh.ranges) {
    for (std::uint32_t i = range.firstIndex; i < range.firstIndex + range.indexCount; ++i) {
      const std::uint32_t corner = (i - range.firstIndex) % 3;
      const std::uint32_t next = corner == 2 ? i - 2 : i + 1;
      const auto a = key(mesh.vertices[range.firstVertex + mesh.indices[i]]);
      const auto b = key(mesh.vertices[range.firstVertex + mesh.indices[next]]);
      (a < b ? count[{a, b}] : count[{b, a}]) += a < b ? 1 : -1;
    }
  }
  int open = 0;
  for (const auto& [edge, uses] : count) open += std::abs(uses);
  return open;
}

scenes::Shape randomSoup(std::mt19937& random, int vertices, int triangles) {
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::uniform_int_distribution<std::uint32_t> pick(0, static_cast<std::uint32_t>(vertices) - 1);
  scenes::Shape soup;
  for (int i = 0; i < vertices; ++i) soup.addVertex({place(random), place(random), place(random)});
  while (soup.indices.size() < 3 * static_cast<std::size_t>(triangles)) {
    const std::uint32_t a = pick(random), b = pick(random), c = pick(random);
    if (a != b && b != c && c != a) soup.addTriangle(a, b, c);
  }
  return soup;
}

TEST(VolumeGeometry, CappedVolumesAreClosedWhateverTheMesh) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const scenes::Shape soup = randomSoup(random, 12, 40);
    // From outside, from inside its bounds, in ranges of few vertices, in chunks of few layers.
    EXPECT_EQ(unmatchedEdges(volumeOf(soup, {3, 5, 1}, VolumeSurface::capped, 65536, 255)), 0);
    EXPECT_EQ(unmatchedEdges(volumeOf(soup, {0.1, 0.2, 0}, VolumeSurface::capped, 65536, 255)), 0);
    EXPECT_EQ(unmatchedEdges(volumeOf(soup, {3, 5, 1}, VolumeSurface::capped, 16, 255)), 0);
    EXPECT_EQ(unmatchedEdges(volumeOf(soup, {3, 5, 1}, VolumeSurface::capped, 65536, 3)), 0);
  }
}

TEST(VolumeGeometry, SidesAreTheSilhouetteAlone) {
  const scenes::Shape box = scenes::boxShape({0, 0, 0}, {1, 1, 1});
  // From a corner's direction a box has six silhouette edges and three visible sides.
  const VolumeMesh sides = volumeOf(box, {5, 6, 7}, VolumeSurface::sides, 65536, 255);
  EXPECT_EQ(sides.indices.size(), 6u * 2 * 3);
  EXPECT_EQ(sides.vertices.size(), 12u);
  const VolumeMesh capped = volumeOf(box, {5, 6, 7}, VolumeSurface::capped, 65536, 255);
  EXPECT_EQ(capped.indices.size(), (6u * 2 + 6 + 4) * 3) << "six faces to the light, a fan of four far away";
}

TEST(VolumeGeometry, RangesHoldWhatShortIndicesReach) {
  const VolumeMesh mesh =
      volumeOf(scenes::icosphereShape({0, 0, 0}, 1.0, 3), {4, 5, 6}, VolumeSurface::capped, 100, 255);
  ASSERT_GT(mesh.ranges.size(), 3u);
  for (const VolumeMesh::Range& range : mesh.ranges) {
    for (std::uint32_t i = range.firstIndex; i < range.firstIndex + range.indexCount; ++i) {
      ASSERT_LT(mesh.indices[i], 100u);
      ASSERT_LT(range.firstVertex + mesh.indices[i], mesh.vertices.size());
    }
  }
}

/// Layers that a ray from the light meets.
int layersAlong(const scenes::Shape& shape, const glm::dvec3& light, const glm::dvec3& direction) {
  int layers = 0;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const glm::dvec3 a = glm::dvec3(shape.positions[shape.indices[i]]) - light;
    const glm::dvec3 b = glm::dvec3(shape.positions[shape.indices[i + 1]]) - light;
    const glm::dvec3 c = glm::dvec3(shape.positions[shape.indices[i + 2]]) - light;
    const double u = glm::dot(direction, glm::cross(a, b)), v = glm::dot(direction, glm::cross(b, c)),
                 w = glm::dot(direction, glm::cross(c, a));
    const bool hit = (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
    layers += hit && glm::dot(direction, a + b + c) > 0;
  }
  return layers;
}

TEST(VolumeGeometry, NoRayMeetsMoreLayersThanTheChunksSay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  int most = 0;
  for (int i = 0; i < 40; ++i) {
    const scenes::Shape soup = randomSoup(random, 14, 60);
    const glm::dvec3 light = i % 2 == 0 ? glm::dvec3(3, 5, 1) : glm::dvec3(0.1, 0.2, 1.5);
    std::vector<VolumeChunk> chunks;
    volumeOf(soup, light, VolumeSurface::sides, 65536, 10, &chunks);
    int bound = 0;
    for (const VolumeChunk& chunk : chunks) {
      EXPECT_LE(chunk.layers, 10);
      bound += chunk.layers;
    }
    for (int ray = 0; ray < 300; ++ray) {
      const glm::dvec3 target(place(random), place(random), place(random));
      const int layers = layersAlong(soup, light, target - light);
      most = std::max(most, layers);
      EXPECT_LE(layers, bound);
    }
  }
  EXPECT_GT(most, 12) << "the soups must be thick";
  // A ball is one layer thick, seen from wherever.
  std::vector<VolumeChunk> chunks;
  volumeOf(scenes::icosphereShape({0, 0, 0}, 1.0, 3), {4, 5, 6}, VolumeSurface::sides, 65536, 255, &chunks);
  ASSERT_EQ(chunks.size(), 1u);
  EXPECT_EQ(chunks[0].layers, 1);
}

techniques::VolumeView viewOf(const scene::Camera& camera) {
  return techniques::volumeView(
      {.clipFromWorld = scene::clipFromView(camera, 4.0 / 3.0) * scene::viewFromWorld(camera),
       .eyeWorld = camera.eyeWorld,
       .width = 192,
       .height = 144});
}

scene::Camera randomCamera(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  return {.eyeWorld = {place(random), place(random), place(random)},
          .targetWorld = {place(random), place(random), place(random) + 0.01},
          .nearDistance = 0.3};
}

TEST(VolumeView, InfiniteDepthKeepsPlacesAndOrder) {
  const scene::Camera camera{.eyeWorld = {1e4, 2, 3}, .targetWorld = {1e4, 0, -1}, .nearDistance = 0.3};
  const glm::dmat4 finite = scene::clipFromView(camera, 4.0 / 3.0) * scene::viewFromWorld(camera);
  const techniques::VolumeView view = viewOf(camera);
  const glm::dvec3 forward = glm::normalize(camera.targetWorld - camera.eyeWorld);
  double last = -1.1;
  for (const double distance : {0.3, 0.5, 2.0, 100.0, 1e6, 1e9}) {
    const glm::dvec4 point(camera.eyeWorld + distance * forward, 1.0);
    const glm::dvec4 clip = view.clipFromWorld * point, before = finite * point;
    EXPECT_NEAR(clip.w, before.w, 1e-12 * std::abs(before.w) + 1e-9);
    const double depth = clip.z / clip.w;
    EXPECT_GT(depth, last) << distance;
    EXPECT_LT(depth, 1.0);
    if (distance == 0.3) EXPECT_NEAR(depth, -1.0, 1e-5);
    last = depth;
  }
}

TEST(VolumeView, NearPyramidIsNeverMissedByMistake) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-4.0, 4.0), share(0.0, 1.0), size(0.05, 1.5);
  int misses = 0, hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const techniques::VolumeView view = viewOf(randomCamera(random));
    const glm::dvec3 light(place(random), place(random), place(random));
    const glm::dvec3 center(place(random), place(random), place(random));
    const glm::dvec3 half(size(random), size(random), size(random));
    const auto box = techniques::boxCornersWorld(glm::dmat4(1.0), {center - half, center + half});
    bool meets = false;
    for (int sample = 0; sample < 200 && !meets; ++sample) {
      const auto& corner = view.nearCornersWorld;
      const glm::dvec3 onNear = glm::mix(glm::mix(corner[0], corner[1], share(random)),
                                         glm::mix(corner[3], corner[2], share(random)), share(random));
      const glm::dvec3 point = glm::mix(light, onNear, share(random));
      meets = glm::all(glm::lessThanEqual(glm::abs(point - center), half));
    }
    const bool misses_ = techniques::missesNearPyramid(view, light, box);
    EXPECT_FALSE(meets && misses_) << i;
    misses += misses_;
    hits += meets;
  }
  EXPECT_GT(misses, 500) << "most casters are out of the way";
  EXPECT_GT(hits, 50);
}

TEST(VolumeView, ScissorHoldsEveryShadowedPixel) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-4.0, 4.0), share(-1.0, 1.0), size(0.05, 1.0);
  int bounded = 0, seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const techniques::VolumeView view = viewOf(randomCamera(random));
    const glm::dvec3 light(place(random), place(random), place(random));
    const glm::dvec3 center(place(random), place(random), place(random));
    const glm::dvec3 half(size(random), size(random), size(random));
    const auto box = techniques::boxCornersWorld(glm::dmat4(1.0), {center - half, center + half});
    const auto scissor = techniques::shadowScissor(view, light, box);
    if (!scissor) continue;
    ++bounded;
    for (int sample = 0; sample < 200; ++sample) {
      const glm::dvec3 inBox = center + half * glm::dvec3(share(random), share(random), share(random));
      const double along = std::exp(4.0 * std::abs(share(random))) - 1.0;
      const glm::dvec4 clip = view.clipFromWorld * glm::dvec4(inBox + along * (inBox - light), 1.0);
      if (clip.z < -clip.w || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
      ++seen;
      const double x = (clip.x / clip.w * 0.5 + 0.5) * 192, y = (clip.y / clip.w * 0.5 + 0.5) * 144;
      EXPECT_TRUE(x >= scissor->x && x <= scissor->x + scissor->width && y >= scissor->y &&
                  y <= scissor->y + scissor->height)
          << i;
    }
  }
  EXPECT_GT(bounded, 300);
  EXPECT_GT(seen, 5000);
}

}  // namespace
}  // namespace halfshadow::test
