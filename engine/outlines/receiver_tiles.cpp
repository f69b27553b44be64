// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/receiver_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace halfshadow::outlines {
namespace {
/// A triangle cut at the light's plane, in (t, i).
struct Polygon {
  glm::dvec3 points[4];
  int count = 0;
  glm::dvec3 low{1e300}, high{-1e300};
  glm::dvec4 plane{0.0};
  bool eitherSide = false, turned = false;
  /// Reciprocal height over it: i = base + dot(gradient, t).
  glm::dvec2 gradient{0.0};
  double base = 0.0;
  void add(const glm::dvec3& p) {
    points[count++] = p;
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

Polygon cutTriangle(const glm::dvec3 (&abh)[3], const ListSpace& space, double minHeight) {
  Polygon polygon;
  const auto add = [&](const glm::dvec3& p) { polygon.add(space.tangentPoint(p)); };
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 &a = abh[k], &b = abh[(k + 1) % 3];
    const bool aIn = a.z >= minHeight, bIn = b.z >= minHeight;
    if (aIn) add(a);
    if (aIn != bIn) add(glm::mix(a, b, (minHeight - a.z) / (b.z - a.z)));
  }
  return polygon;
}

/// Whether some point of the light (a corner) lies on the outer side of the triangle.
bool facesLight(const glm::dvec3 (&abh)[3], double orientation) {
  const glm::dvec3 normal = orientation * glm::cross(abh[1] - abh[0], abh[2] - abh[0]);
  const double middle = -glm::dot(normal, abh[0]);
  return middle + std::abs(normal.x) + std::abs(normal.y) > 0.0;
}

/// Finds the polygon's gradient. Infinite ones (it is seen edge-on) give false.
bool findGradient(Polygon& polygon) {
  glm::dvec3 normal(0.0);
  for (int k = 2; k < polygon.count; ++k) {
    normal += glm::cross(polygon.points[k - 1] - polygon.points[0], polygon.points[k] - polygon.points[0]);
  }
  const double steepest = std::max(std::abs(normal.x), std::abs(normal.y));
  if (std::abs(normal.z) <= 1e-6 * steepest || normal.z == 0.0) return false;
  polygon.gradient = -glm::dvec2(normal) / normal.z;
  polygon.base = polygon.points[0].z - glm::dot(polygon.gradient, glm::dvec2(polygon.points[0]));
  return true;
}

double turnOf(const Polygon& polygon) {
  double area = 0.0;
  for (int k = 0; k < polygon.count; ++k) {
    const glm::dvec3 &a = polygon.points[k], &b = polygon.points[(k + 1) % polygon.count];
    area += a.x * b.y - b.x * a.y;
  }
  return area >= 0.0 ? 1.0 : -1.0;
}

/// Separating-axis test of rectangles against a convex polygon by the polygon's own edges.
class PolygonEdges {
 public:
  explicit PolygonEdges(const Polygon& polygon) : count_(polygon.count) {
    const double turn = turnOf(polygon);
    for (int k = 0; k < count_; ++k) {
      from_[k] = glm::dvec2(polygon.points[k]);
      const glm::dvec2 edge = glm::dvec2(polygon.points[(k + 1) % count_]) - from_[k];
      outward_[k] = turn * glm::dvec2(edge.y, -edge.x);
    }
  }
  bool meet(const TangentRect& rect) const {
    for (int k = 0; k < count_; ++k) {
      const glm::dvec2 nearest(outward_[k].x > 0 ? rect.low.x : rect.high.x,
                               outward_[k].y > 0 ? rect.low.y : rect.high.y);
      if (glm::dot(outward_[k], nearest - from_[k]) > 0.0) return false;
    }
    return true;
  }

 private:
  glm::dvec2 from_[4], outward_[4];
  int count_;
};

/// Patches as they are found.
struct FoundPatches {
  struct Patch {
    std::uint32_t tile = 0, polygon = 0;
    glm::dvec2 low{0.0}, high{0.0};
    double iLow = 0.0, iHigh = 0.0;
  };
  bool wanted = false;
  std::vector<Patch> patches;
};

/// What the fragments of a patch are moved by, in the direction of each coordinate in which its plane rises.
glm::dvec3 liftOf(const glm::dvec4& plane, const glm::dvec2& low, const glm::dvec2& high, double iLow,
                  double iHigh) {
  const glm::dvec3 largest(glm::max(glm::abs(low), glm::abs(high)),
                           std::max(std::abs(iLow), std::abs(iHigh)));
  return kPlaceRounding * largest * glm::sign(glm::dvec3(plane.x, plane.y, plane.w));
}

/// Turns the plane towards the light's side, where fragments that receive are seen from.
void faceLight(Polygon& polygon, bool closed) {
  const double middle = polygon.plane.w, reach = std::abs(polygon.plane.x) + std::abs(polygon.plane.y);
  if (closed) return;
  polygon.eitherSide = std::abs(middle) <= reach;
  polygon.turned = middle < -reach;
  if (polygon.turned) polygon.plane = -polygon.plane;
}

/// Rectangles one part in a thousand wider than tiles, since fragments find theirs in single precision.
class TileRects {
 public:
  explicit TileRects(const ReceiverTiles& tiles) {
    for (int k = 0; k < std::max(tiles.columns, tiles.rows); ++k) {
      const glm::dvec2 low = tiles.low + tiles.tileSize * double(k), border = 1e-3 * tiles.tileSize;
      diagonal_.push_back({.low = tiles.scale.tangent(low - border),
                           .high = tiles.scale.tangent(low + tiles.tileSize + border)});
    }
  }
  TangentRect at(int x, int y) const {
    const TangentRect &column = diagonal_[static_cast<std::size_t>(x)],
                      &row = diagonal_[static_cast<std::size_t>(y)];
    return {.low = {column.low.x, row.low.y}, .high = {column.high.x, row.high.y}};
  }

 private:
  std::vector<TangentRect> diagonal_;  ///< of tiles (k, k)
};

void addPolygon(std::uint32_t number, Polygon& polygon, const TileRects& rects, ReceiverTiles& tiles,
                FoundPatches& found) {
  const auto clampedIndex = [](double value, int count) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
  };
  const glm::dvec2 from = (tiles.scale.squeezed(glm::dvec2(polygon.low)) - tiles.low) / tiles.tileSize;
  const glm::dvec2 to = (tiles.scale.squeezed(glm::dvec2(polygon.high)) - tiles.low) / tiles.tileSize;
  if (to.x < 0 || to.y < 0 || from.x > tiles.columns || from.y > tiles.rows) return;
  // One part in a thousand of a tile, since fragments find their tile in single precision.
  const int x0 = clampedIndex(from.x - 1e-3, tiles.columns), x1 = clampedIndex(to.x + 1e-3, tiles.columns);
  const int y0 = clampedIndex(from.y - 1e-3, tiles.rows), y1 = clampedIndex(to.y + 1e-3, tiles.rows);
  const bool isPlane = findGradient(polygon);
  const bool many = x1 - x0 > 1 || y1 - y0 > 1;
  const PolygonEdges edges(polygon);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const TangentRect tile = rects.at(x, y);
      const glm::dvec2 low = glm::max(tile.low, glm::dvec2(polygon.low));
      const glm::dvec2 high = glm::min(tile.high, glm::dvec2(polygon.high));
      if (many && !edges.meet(tile)) continue;
      double iLow = polygon.low.z, iHigh = polygon.high.z;
      if (isPlane) {
        const glm::dvec2 middle = 0.5 * (low + high), reach = 0.5 * glm::max(high - low, glm::dvec2(0.0));
        const double center = polygon.base + glm::dot(polygon.gradient, middle);
        const double spread = std::abs(polygon.gradient.x) * reach.x + std::abs(polygon.gradient.y) * reach.y;
        iLow = std::max(iLow, center - spread);
        iHigh = std::min(iHigh, center + spread);
        if (iLow > iHigh) iLow = iHigh = std::clamp(center, polygon.low.z, polygon.high.z);
      }
      const std::size_t index =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles.columns) + static_cast<std::size_t>(x);
      if (found.wanted) {
        found.patches.push_back({.tile = static_cast<std::uint32_t>(index),
                                 .polygon = number,
                                 .low = low,
                                 .high = high,
                                 .iLow = iLow,
                                 .iHigh = iHigh});
      }
      TangentBox& box = tiles.boxes[index];
      const double rounding = 2.0 * kPlaceRounding * std::max(std::abs(iLow), std::abs(iHigh));
      const auto l = static_cast<float>(iLow - rounding), h = static_cast<float>(iHigh + rounding);
      const bool first = box.empty();
      box.iLow = first ? l : std::min(box.iLow, l);
      box.iHigh = first ? h : std::max(box.iHigh, h);
    }
  }
}

/// Sorts patches by tile.
void keepPatches(const FoundPatches& found, std::span<const Polygon> polygons, ReceiverTiles& tiles) {
  tiles.firstPatch.assign(tiles.boxes.size() + 1, 0);
  for (const FoundPatches::Patch& patch : found.patches) ++tiles.firstPatch[patch.tile + 1];
  std::partial_sum(tiles.firstPatch.begin(), tiles.firstPatch.end(), tiles.firstPatch.begin());
  std::vector<std::uint32_t> next(tiles.firstPatch.begin(), tiles.firstPatch.end() - 1);
  std::vector<std::uint32_t> sorted(found.patches.size());
  for (std::size_t k = 0; k < sorted.size(); ++k)
    sorted[next[found.patches[k].tile]++] = static_cast<std::uint32_t>(k);
  tiles.patches.reserve(sorted.size());
  for (const std::uint32_t k : sorted) {
    const FoundPatches::Patch& patch = found.patches[k];
    const Polygon& polygon = polygons[patch.polygon];
    tiles.patches.push_back({patch.low, glm::max(patch.low, patch.high), polygon.gradient, polygon.base,
                             patch.iLow, patch.iHigh, polygon.plane,
                             liftOf(polygon.plane, patch.low, patch.high, patch.iLow, patch.iHigh),
                             polygon.eitherSide, polygon.turned});
  }
}
}  // namespace

ReceiverTiles receiverTiles(const ReceiverSurface& surface, const ListSpace& space,
                            const TangentRect& shadows, double tileSize, int maxTiles, double minHeight,
                            const TileScale& scale) {
  ReceiverTiles tiles{.scale = scale};
  if (shadows.empty()) return tiles;
  const scene::LightPlane& plane = space.plane;
  const glm::dmat3 linear(surface.worldFromObject);
  const glm::dmat3 lightFromObject = plane.axes * linear;
  const glm::dmat3 normalMatrix = glm::transpose(glm::inverse(linear));
  const glm::dvec3 offset = plane.fromWorld(glm::dvec3(surface.worldFromObject[3]));
  const double orientation = glm::determinant(linear) >= 0.0 ? 1.0 : -1.0;
  const scene::TriangleMesh& mesh = *surface.mesh;
  std::vector<glm::dvec3> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = lightFromObject * glm::dvec3(mesh.positions[i]) + offset;
  }
  std::vector<Polygon> polygons;
  TangentRect reached;
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const glm::dvec3 abh[3] = {vertices[mesh.indices[f]], vertices[mesh.indices[f + 1]],
                               vertices[mesh.indices[f + 2]]};
    if (surface.closed && !facesLight(abh, orientation)) continue;
    Polygon polygon = cutTriangle(abh, space, minHeight);
    if (polygon.count < 3) continue;
    if (surface.withPatches) {
      const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[f + k]]); };
      const glm::dvec3 normal = normalMatrix * glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      polygon.plane = space.planeThrough(normal / std::max(glm::length(normal), 1e-300),
                                         plane.toWorld(abh[0]) - plane.centerWorld);
      faceLight(polygon, surface.closed);
    }
    if (polygon.low.x > shadows.high.x || polygon.high.x < shadows.low.x || polygon.low.y > shadows.high.y ||
        polygon.high.y < shadows.low.y)
      continue;
    polygons.push_back(polygon);
    reached.low = glm::min(reached.low, glm::dvec2(polygon.low));
    reached.high = glm::max(reached.high, glm::dvec2(polygon.high));
  }
  if (polygons.empty()) return tiles;
  tiles.low = scale.squeezed(glm::max(reached.low, shadows.low));
  const glm::dvec2 size =
      glm::max(scale.squeezed(glm::min(reached.high, shadows.high)) - tiles.low, glm::dvec2(1e-6 * tileSize));
  const auto count = [&](double length) {
    // As numbers of tiles may be beyond int.
    return static_cast<int>(std::clamp(std::ceil(length / tileSize), 1.0, static_cast<double>(maxTiles)));
  };
  tiles.columns = count(size.x);
  tiles.rows = count(size.y);
  tiles.tileSize = size / glm::dvec2(tiles.columns, tiles.rows);
  tiles.boxes.resize(static_cast<std::size_t>(tiles.columns) * static_cast<std::size_t>(tiles.rows));
  FoundPatches found{.wanted = surface.withPatches};
  const TileRects rects(tiles);
  for (std::size_t k = 0; k < polygons.size(); ++k)
    addPolygon(static_cast<std::uint32_t>(k), polygons[k], rects, tiles, found);
  if (found.wanted) keepPatches(found, polygons, tiles);
  for (int y = 0; y < tiles.rows; ++y) {
    for (int x = 0; x < tiles.columns; ++x) {
      TangentBox& box = tiles.boxes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles.columns) +
                                    static_cast<std::size_t>(x)];
      const TangentRect tile = rects.at(x, y);
      box.tLow = glm::vec2(tile.low);
      box.tHigh = glm::vec2(tile.high);
      for (int k = 0; k < 2; ++k) {
        if (scale.squeeze[k] == 0.0) continue;
        // The last tiles end where the receiver does.
        const double rounding = 1e-5 * std::max(std::abs(reached.low[k]), std::abs(reached.high[k]));
        box.tLow[k] = std::max(box.tLow[k], static_cast<float>(reached.low[k] - rounding));
        box.tHigh[k] = std::min(box.tHigh[k], static_cast<float>(reached.high[k] + rounding));
      }
      if (box.empty()) continue;
      // Fragments are lifted after their tile was found.
      const glm::vec2 lift =
          static_cast<float>(kPlaceRounding) * glm::max(glm::abs(box.tLow), glm::abs(box.tHigh));
      box.tLow -= lift;
      box.tHigh += lift;
    }
  }
  return tiles;
}

}  // namespace halfshadow::outlines
