// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>
#include <cstdint>
#include <string>

#include "scenes/scene_makers.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::scenes {
namespace {
using scene::SceneDescription;

const glm::vec3 kWood(0.55f, 0.36f, 0.2f), kLeafGreen(0.2f, 0.45f, 0.12f), kStone(0.5f, 0.5f, 0.52f),
    kPlaster(0.75f, 0.72f, 0.66f), kRed(0.7f, 0.16f, 0.1f);

/// Reproducible numbers in [0, 1). Based on: Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", 2014, section 4 (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * next(); }

 private:
  std::uint64_t state_;
};

void add(SceneDescription& description, const std::string& name, const Shape& shape, const glm::vec3& color) {
  description.objects.push_back(casterOf(name, shape, color));
}

void addReceiver(SceneDescription& description, const std::string& name, const Shape& shape,
                 const glm::vec3& color) {
  add(description, name, shape, color);
  description.objects.back().casts = false;
}

constexpr double kTerrainHalf = 8.0;

double terrainHeight(double x, double z) {
  const auto hill = [&](double cx, double cz, double height, double width) {
    const double dx = x - cx, dz = z - cz;
    return height * std::exp(-(dx * dx + dz * dz) / (width * width));
  };
  return 1.0 + hill(2.5, -2, 2.6, 2.4) + hill(-4, -4, 1.9, 2.8) + hill(-3, 4, 1.2, 2.2) +
         hill(6, 5, 1.6, 2.0) - hill(0.5, 2.5, 0.6, 2.5) +
         0.10 * std::sin(2.1 * x + 0.7) * std::sin(1.9 * z) +
         0.04 * std::sin(5.3 * x) * std::sin(4.7 * z + 1.1);
}

/// The height field as a solid: top, four sides, bottom.
Shape terrainShape(int cells) {
  Shape shape;
  const auto count = static_cast<std::uint32_t>(cells);
  const auto coordinate = [&](std::uint32_t i) { return kTerrainHalf * (2.0 * i / count - 1.0); };
  const auto addLayer = [&](auto heightAt) {
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    for (std::uint32_t k = 0; k <= count; ++k) {
      for (std::uint32_t i = 0; i <= count; ++i) {
        const double x = coordinate(i), z = coordinate(k);
        shape.addVertex({x, heightAt(x, z), z});
      }
    }
    return first;
  };
  const std::uint32_t top = addLayer(terrainHeight);
  const std::uint32_t bottom = addLayer([](double, double) { return 0.0; });
  const auto at = [&](std::uint32_t layer, std::uint32_t i, std::uint32_t k) {
    return layer + k * (count + 1) + i;
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    shape.addTriangle(a, b, c);
    shape.addTriangle(a, c, d);
  };
  for (std::uint32_t k = 0; k < count; ++k) {
    for (std::uint32_t i = 0; i < count; ++i) {
      quad(at(top, i, k), at(top, i, k + 1), at(top, i + 1, k + 1), at(top, i + 1, k));
      quad(at(bottom, i, k), at(bottom, i + 1, k), at(bottom, i + 1, k + 1), at(bottom, i, k + 1));
    }
    quad(at(top, 0, k), at(bottom, 0, k), at(bottom, 0, k + 1), at(top, 0, k + 1));
    quad(at(top, count, k + 1), at(bottom, count, k + 1), at(bottom, count, k), at(top, count, k));
    quad(at(top, k + 1, 0), at(bottom, k + 1, 0), at(bottom, k, 0), at(top, k, 0));
    quad(at(top, k, count), at(bottom, k, count), at(bottom, k + 1, count), at(top, k + 1, count));
  }
  return shape;
}

/// One open leaf: a strip that narrows at both ends and bends over its length.
Shape sheetShape(Random& random) {
  const glm::dvec3 center(random.between(-1.6, 1.6), random.between(1.2, 3.0), random.between(-1.6, 1.6));
  const auto axis = [&] {
    return glm::normalize(glm::dvec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) +
                          glm::dvec3(1e-3, 2e-3, 0));
  };
  const glm::dvec3 along = axis();
  const glm::dvec3 across = glm::normalize(glm::cross(along, axis()));
  const glm::dvec3 normal = glm::cross(across, along);
  constexpr std::uint32_t kSegments = 6;
  Shape shape;
  for (std::uint32_t i = 0; i <= kSegments; ++i) {
    const double t = 2.0 * i / kSegments - 1.0;
    const double halfWidth = 0.02 + 0.16 * (1 - t * t);
    const glm::dvec3 middle = center + along * (0.45 * t) + normal * (0.18 * t * t);
    shape.addVertex(middle - across * halfWidth);
    shape.addVertex(middle + across * halfWidth);
  }
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    shape.addTriangle(2 * i, 2 * i + 1, 2 * i + 2);
    shape.addTriangle(2 * i + 1, 2 * i + 3, 2 * i + 2);
  }
  return shape;
}

void addChair(SceneDescription& description, const std::string& name, const glm::dvec3& at, double turn) {
  const glm::dvec3 x(std::cos(turn), 0, -std::sin(turn)), y(0, 1, 0), z = glm::cross(x, y);
  const auto part = [&](const glm::dvec3& center, const glm::dvec3& half) {
    return boxShape(at + x * center.x + y * center.y + z * center.z, half, x, y);
  };
  add(description, name + " seat", part({0, 0.46, 0}, {0.22, 0.02, 0.22}), kRed);
  add(description, name + " back", part({0, 0.82, -0.21}, {0.2, 0.16, 0.015}), kRed);
  for (int leg = 0; leg < 4; ++leg) {
    const double side = leg & 1 ? 0.19 : -0.19;
    // Back legs carry the back rest; gaps of 5 mm keep the parts from sharing faces.
    const bool isBack = (leg & 2) != 0;
    const double top = isBack ? 0.655 : 0.435;
    const glm::dvec3 center(isBack ? side * 1.32 : side, top / 2, isBack ? -0.21 : 0.19);
    add(description, name + " leg " + std::to_string(leg), part(center, {0.02, top / 2, 0.02}), kWood);
  }
}
}  // namespace

SceneDescription makeContact(double lightHalfSize) {
  SceneDescription description;
  add(description, "plate", boxShape({-1.5, 0.06, 0.6}, {0.9, 0.06, 0.6}), kRed);
  add(description, "ball", icosphereShape({0.6, 0.8, -0.5}, 0.8, 4), kStone);
  add(description, "pole", frustumShape({-0.4, 0, -1.6}, 0.08, 0.08, 2.6, 24), kWood);
  description.objects.push_back(groundObject());
  setBenchmarkView(description, lightHalfSize);
  return description;
}

SceneDescription makeRoom(double lightHalfSize) {
  SceneDescription description;
  addReceiver(description, "wall left", boxShape({-3.1, 1.5, 0}, {0.1, 1.5, 2.6}), kPlaster);
  addReceiver(description, "wall right", boxShape({3.1, 1.5, 0}, {0.1, 1.5, 2.6}), kPlaster);
  addReceiver(description, "wall back", boxShape({0, 1.5, -2.7}, {3.2, 1.5, 0.1}), kPlaster);
  addReceiver(description, "wall front", boxShape({0, 1.5, 2.7}, {3.2, 1.5, 0.1}), kPlaster);
  // The ceiling casts: it lies behind the light, where no technique may take it for an occluder.
  add(description, "ceiling", boxShape({0, 3.1, 0}, {3.2, 0.1, 2.8}), kPlaster);
  add(description, "table top", boxShape({0.1, 0.76, -0.3}, {0.8, 0.02, 0.45}), kWood);
  for (int leg = 0; leg < 4; ++leg) {
    const glm::dvec3 center(0.1 + (leg & 1 ? 0.72 : -0.72), 0.365, -0.3 + (leg & 2 ? 0.38 : -0.38));
    add(description, "table leg " + std::to_string(leg), boxShape(center, {0.03, 0.365, 0.03}), kWood);
  }
  add(description, "vase", frustumShape({0.3, 0.785, -0.35}, 0.06, 0.1, 0.24, 24), kStone);
  add(description, "ball", icosphereShape({-0.25, 0.9, -0.2}, 0.115, 3), kRed);
  addChair(description, "chair a", {-1.15, 0, -0.2}, 1.45);
  addChair(description, "chair b", {1.35, 0, -0.4}, -1.7);
  addChair(description, "chair c", {0.25, 0, 0.75}, 3.3);
  add(description, "column", frustumShape({-2.2, 0, -1.8}, 0.18, 0.14, 2.2, 32), kPlaster);
  description.objects.push_back(groundObject());
  setView(description, {-2.6, 2.1, 2.3}, {0.25, 0.55, -0.6}, {0.4, 2.85, -0.1}, {0.2, 0, -0.25},
          lightHalfSize);
  description.camera->verticalFovRadians = 1.0;
  return description;
}

SceneDescription makeTerrain(double lightHalfSize) {
  SceneDescription description;
  add(description, "terrain", terrainShape(96), glm::vec3(0.45f, 0.5f, 0.3f));
  const glm::dvec2 trees[] = {{-1.5, 0.5}, {-0.6, -1.4}, {1.2, 1.6}, {-3.2, 2.2},
                              {3.6, 2.6},  {-5.2, -0.8}, {4.6, -4.8}};
  for (const glm::dvec2& at : trees) {
    const std::string name = "tree at " + std::to_string(static_cast<int>(at.x * 10)) + "," +
                             std::to_string(static_cast<int>(at.y * 10));
    const glm::dvec3 foot(at.x, terrainHeight(at.x, at.y) - 0.1, at.y);
    add(description, name + " trunk", frustumShape(foot, 0.09, 0.07, 0.6, 12), kWood);
    add(description, name + " crown", frustumShape(foot + glm::dvec3(0, 0.58, 0), 0.42, 0, 1.2, 20),
        kLeafGreen);
  }
  const glm::dvec2 boxes[] = {{0.4, 0.2}, {1.9, 3.2}, {-2.2, 3.9}};
  for (const glm::dvec2& at : boxes) {
    const glm::dvec3 center(at.x, terrainHeight(at.x, at.y) + 0.22, at.y);
    add(description, "box", boxShape(center, {0.35, 0.35, 0.25}), kStone);
  }
  setView(description, {-7.5, 9.5, 11.5}, {-0.2, 1.0, 0.3}, {10, 10, 3}, {0, 1, 0}, lightHalfSize);
  return description;
}

SceneDescription makeSheets(double lightHalfSize) {
  SceneDescription description;
  Random random(2026);
  for (int i = 0; i < 40; ++i) {
    add(description, "sheet" + std::to_string(i), sheetShape(random), kLeafGreen);
  }
  description.objects.push_back(groundObject());
  setBenchmarkView(description, lightHalfSize);
  return description;
}

SceneDescription makeConvex(double lightHalfSize) {
  SceneDescription description;
  add(description, "icosphere", icosphereShape({0, 1.8, 0}, 1.0, 4), kStone);
  description.objects.push_back(groundObject());
  setBenchmarkView(description, lightHalfSize);
  return description;
}

}  // namespace halfshadow::scenes
