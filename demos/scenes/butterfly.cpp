// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A butterfly: thin wings that rise through many heights, where slices and maps tend to leak light.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scenes/scene_makers.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::scenes {
namespace {
constexpr std::uint32_t kRings = 8, kSpokes = 48;
constexpr double kThickness = 0.004, kHeight = 1.2;

/// Outline around the wing's root: a large lobe forward, a small one backward, a notch between them.
double wingRadius(double angle) {
  const double fore = std::max(0.0, std::cos(1.6 * (angle - 0.75)));
  const double hind = std::max(0.0, std::cos(1.9 * (angle + 0.8)));
  return 0.3 + 1.25 * fore + 0.75 * hind;
}

/// A bent sheet, closed by its rim. `side` 1 is the wing at +x, -1 its mirror image.
Shape wingShape(double side) {
  Shape shape;
  const auto place = [&](std::uint32_t ring, std::uint32_t spoke, double lift) {
    const double angle = glm::pi<double>() * (0.46 - 0.92 * spoke / kSpokes);
    const double radius = wingRadius(angle) * ring / kRings;
    const double x = radius * std::cos(angle), z = -radius * std::sin(angle);
    return glm::dvec3(side * (0.03 + x), kHeight + 0.8 * x - 0.12 * x * x + lift, z);
  };
  // One root and kRings x (kSpokes + 1) places, above and below.
  const auto addFace = [&](double lift) {
    const std::uint32_t root = shape.addVertex(place(0, 0, lift));
    for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
      for (std::uint32_t spoke = 0; spoke <= kSpokes; ++spoke) shape.addVertex(place(ring, spoke, lift));
    }
    return root;
  };
  const std::uint32_t top = addFace(0.5 * kThickness), bottom = addFace(-0.5 * kThickness);
  const auto at = [](std::uint32_t root, std::uint32_t ring, std::uint32_t spoke) {
    return ring == 0 ? root : root + 1 + (ring - 1) * (kSpokes + 1) + spoke;
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    side > 0 ? shape.addTriangle(a, b, c) : shape.addTriangle(a, c, b);
  };
  for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
    triangle(top, at(top, 1, spoke + 1), at(top, 1, spoke));
    triangle(bottom, at(bottom, 1, spoke), at(bottom, 1, spoke + 1));
    for (std::uint32_t ring = 1; ring < kRings; ++ring) {
      const auto quad = [&](std::uint32_t face, std::uint32_t first, std::uint32_t second) {
        triangle(at(face, ring, first), at(face, ring, second), at(face, ring + 1, second));
        triangle(at(face, ring, first), at(face, ring + 1, second), at(face, ring + 1, first));
      };
      quad(top, spoke, spoke + 1);
      quad(bottom, spoke + 1, spoke);
    }
  }
  // The rim: out along the first spoke, around the outline, back along the last.
  const auto rim = [&](std::uint32_t ringA, std::uint32_t spokeA, std::uint32_t ringB, std::uint32_t spokeB) {
    triangle(at(top, ringA, spokeA), at(top, ringB, spokeB), at(bottom, ringB, spokeB));
    triangle(at(top, ringA, spokeA), at(bottom, ringB, spokeB), at(bottom, ringA, spokeA));
  };
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    rim(ring, 0, ring + 1, 0);
    rim(ring + 1, kSpokes, ring, kSpokes);
  }
  for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) rim(kRings, spoke, kRings, spoke + 1);
  return shape;
}
}  // namespace

scene::SceneDescription makeButterfly(double lightHalfSize) {
  scene::SceneDescription description;
  const glm::vec3 orange(0.85f, 0.42f, 0.08f), dark(0.15f, 0.12f, 0.1f);
  description.objects.push_back(casterOf("right wing", wingShape(1.0), orange));
  description.objects.push_back(casterOf("left wing", wingShape(-1.0), orange));
  description.objects.push_back(
      casterOf("body", capsuleShape({0, kHeight, -0.6}, {0, kHeight, 0.5}, 0.05), dark));
  description.objects.push_back(groundObject());
  setBenchmarkView(description, lightHalfSize);
  return description;
}

}  // namespace halfshadow::scenes
