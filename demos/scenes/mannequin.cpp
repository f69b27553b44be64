// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "scenes/scene_makers.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::scenes {
namespace {

/// A cone with a ball at each end, blended into what comes before it over `blend`. In metres. Cones that
/// share a ball blend little: the rounding would swell the joint by a quarter of the blend.
struct RoundCone {
  glm::dvec3 a, b;
  double radiusA, radiusB;
  double blend;
};

/// Signed distance to the hull of two balls: in the plane through the axis the cone is a line whose normal
/// leans by asin((rA - rB) / length).
double distance(const RoundCone& cone, const glm::dvec3& p) {
  const glm::dvec3 axis = cone.b - cone.a, fromA = p - cone.a;
  const double length = glm::length(axis);
  const double along = glm::dot(fromA, axis) / length;
  const double across = std::sqrt(std::max(0.0, glm::dot(fromA, fromA) - along * along));
  const double sine = (cone.radiusA - cone.radiusB) / length, cosine = std::sqrt(1.0 - sine * sine);
  const double foot = along - across * sine / cosine;  // where the normal through p meets the axis
  if (foot <= 0.0) return std::hypot(along, across) - cone.radiusA;
  if (foot >= length) return std::hypot(along - length, across) - cone.radiusB;
  return across * cosine + along * sine - cone.radiusA;
}

/// Minimum that is rounded over `blend`; its gradient is a mix of both gradients, so it stays 1-Lipschitz.
double smoothMinimum(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend * 0.25;
}

class Body {
 public:
  Body() {
    addTrunk();
    addHead();
    addArm(+1, {0.325, 1.19, -0.05}, {0.375, 0.965, 0.075}, {0.25, -0.9, 0.4}, {0.35, 0.25, 0.9});
    addArm(-1, {-0.385, 1.25, 0.0}, {-0.45, 1.47, 0.12}, {-0.12, 0.97, 0.15}, {0.8, 0.0, 0.35});
    addLeg(+1, {0.115, 0.52, 0.10}, {0.125, 0.09, 0.10}, {0.22, 0, 1});
    addLeg(-1, {-0.115, 0.52, 0.02}, {-0.125, 0.09, -0.12}, {-0.3, 0, 1});
  }

  double distanceTo(const glm::dvec3& p, std::span<const std::uint16_t> parts) const {
    double result = std::numeric_limits<double>::max();
    for (const std::uint16_t part : parts)
      result = smoothMinimum(result, distance(parts_[part], p), parts_[part].blend);
    return std::max(result, kSole - p.y);  // soles are flat
  }

  /// Parts that can matter within `radius` of p: within that distance none of the others is blended in.
  void partsNear(const glm::dvec3& p, double radius, std::vector<std::uint16_t>& near) const {
    near.clear();
    double nearest = std::numeric_limits<double>::max();
    for (const RoundCone& part : parts_) nearest = std::min(nearest, distance(part, p));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (distance(parts_[i], p) <= nearest + 2 * radius + 2 * kWidestBlend)
        near.push_back(static_cast<std::uint16_t>(i));
    }
  }

 private:
  static constexpr double kSole = 0.0015, kWidestBlend = 0.06;

  void add(const glm::dvec3& a, double radiusA, const glm::dvec3& b, double radiusB, double blend) {
    parts_.push_back({a, b, radiusA, radiusB, blend});
  }

  void addTrunk() {
    for (const double s : {-1.0, 1.0}) {
      add({s * 0.068, 0.96, -0.005}, 0.105, {s * 0.045, 1.13, 0.005}, 0.088, 0.05);
      add({s * 0.045, 1.13, 0.005}, 0.088, {s * 0.07, 1.32, 0.0}, 0.104, 0.05);
      add({s * 0.07, 1.32, 0.0}, 0.104, {s * 0.085, 1.41, -0.01}, 0.075, 0.05);
      add({0, 1.47, -0.015}, 0.055, {s * 0.185, 1.445, -0.015}, 0.062, 0.05);
      add({s * 0.065, 0.93, -0.055}, 0.075, {s * 0.075, 0.90, -0.045}, 0.07, 0.04);  // seat
      add({s * 0.075, 1.33, 0.045}, 0.06, {s * 0.06, 1.35, 0.045}, 0.058, 0.04);     // chest
    }
    add({0, 0.98, 0.0}, 0.1, {0, 1.36, 0.0}, 0.1, 0.05);
  }

  void addHead() {
    add({0, 1.46, -0.015}, 0.062, {0, 1.60, 0.005}, 0.052, 0.04);
    add({0, 1.705, -0.015}, 0.092, {0, 1.70, 0.012}, 0.086, 0.03);
    add({0, 1.66, 0.03}, 0.068, {0, 1.608, 0.052}, 0.042, 0.04);           // face and chin
    add({0, 1.69, 0.092}, 0.011, {0, 1.652, 0.113}, 0.014, 0.02);          // nose
    add({-0.03, 1.704, 0.086}, 0.012, {0.03, 1.704, 0.086}, 0.012, 0.02);  // brow
    for (const double s : {-1.0, 1.0})
      add({s * 0.092, 1.685, -0.005}, 0.016, {s * 0.094, 1.655, 0.0}, 0.012, 0.012);
  }

  /// `along` points from the wrist to the finger tips, `across` from the little finger side to the thumb.
  void addArm(double side, const glm::dvec3& elbow, const glm::dvec3& wrist, glm::dvec3 along,
              glm::dvec3 across) {
    const glm::dvec3 shoulder(side * 0.19, 1.44, -0.015);
    add(shoulder, 0.060, elbow, 0.040, 0.04);
    add(elbow, 0.040, glm::mix(elbow, wrist, 0.35), 0.042, 0.01);
    add(glm::mix(elbow, wrist, 0.35), 0.041, wrist, 0.026, 0.01);
    along = glm::normalize(along);
    across = glm::normalize(across - along * glm::dot(across, along));
    for (const double s : {-0.022, 0.0, 0.022}) {
      add(wrist, 0.022, wrist + along * 0.085 + across * s, 0.017, 0.02);
    }
    for (int finger = 0; finger < 4; ++finger) {
      const double s = finger - 1.5;
      const double length = 0.078 - 0.008 * std::abs(s - 0.5);
      const glm::dvec3 knuckle = wrist + along * 0.085 + across * (0.0205 * s);
      add(knuckle, 0.0125, knuckle + along * length + across * (0.0115 * s), 0.0095, 0.02);
    }
    const glm::dvec3 thumbRoot = wrist + along * 0.03 + across * 0.018;
    const glm::dvec3 thumbJoint = thumbRoot + along * 0.028 + across * 0.034;
    add(thumbRoot, 0.018, thumbJoint, 0.0135, 0.02);
    add(thumbJoint, 0.0135, thumbJoint + along * 0.04 + across * 0.012, 0.0105, 0.012);
  }

  void addLeg(double side, const glm::dvec3& knee, const glm::dvec3& ankle, glm::dvec3 toeward) {
    const glm::dvec3 hip(side * 0.088, 0.92, 0.0);
    add(hip, 0.094, knee, 0.056, 0.04);
    const glm::dvec3 calf = glm::mix(knee, ankle, 0.32) - glm::dvec3(0, 0, 0.014);
    add(knee, 0.054, calf, 0.055, 0.01);
    add(calf, 0.054, ankle, 0.036, 0.01);
    toeward = glm::normalize(toeward);
    const glm::dvec3 sideward(toeward.z, 0, -toeward.x);
    const glm::dvec3 heel = glm::dvec3(ankle.x, 0.033, ankle.z) - toeward * 0.035;
    const glm::dvec3 ball = glm::dvec3(ankle.x, 0.026, ankle.z) + toeward * 0.125;
    add(heel, 0.036, ankle, 0.037, 0.03);
    for (const double s : {-1.0, 1.0}) add(heel, 0.034, ball + sideward * (0.020 * s), 0.027, 0.02);
    for (const double s : {-1.0, 0.0, 1.0}) {
      add(ball + sideward * (0.022 * s), 0.025, ball + toeward * 0.055 + sideward * (0.020 * s), 0.019, 0.02);
    }
    add(ankle, 0.036, ball + glm::dvec3(0, 0.012, 0), 0.026, 0.03);
  }

  std::vector<RoundCone> parts_;
};

/// Turns the body into triangles: one vertex per patch of surface in a grid cell, one quad per grid edge
/// that it crosses. Only blocks of cells near the surface are sampled.
/// Based on: Gibson, "Constrained elastic surface nets", 1998, sections 2 and 3; the vertices are then moved
/// onto the surface along its gradient instead of being relaxed.
class SurfaceNets {
 public:
  explicit SurfaceNets(const Body& body) : body_(body) {
    blocks_.resize(kBlocks.x * kBlocks.y * kBlocks.z);
    sampleBlocks();
    addVertices();
    addQuads();
  }
  Shape takeShape() && { return std::move(shape_); }

 private:
  static constexpr double kCell = 0.0068;  // metres; gives about 60,000 vertices
  static constexpr int kBlock = 8;         // cells per block side; samples include the far border
  static constexpr int kSamples = kBlock + 1;
  static constexpr glm::ivec3 kBlocks{21, 35, 12};
  static constexpr glm::dvec3 kOrigin{-0.57, -0.03, -0.3};

  struct Block {
    std::vector<float> values;  ///< kSamples³, empty when the surface is elsewhere
    std::vector<std::uint16_t> parts;
    std::vector<std::int32_t> vertexOf;  ///< kBlock³, -1 = none
  };

  static glm::dvec3 positionOf(const glm::ivec3& sample) { return kOrigin + glm::dvec3(sample) * kCell; }
  Block& blockAt(const glm::ivec3& b) { return blocks_[(b.z * kBlocks.y + b.y) * kBlocks.x + b.x]; }
  static int sampleIndex(int x, int y, int z) { return (z * kSamples + y) * kSamples + x; }
  static int cellIndex(const glm::ivec3& c) { return (c.z * kBlock + c.y) * kBlock + c.x; }

  template <typename Visit>
  static void forEach(const glm::ivec3& size, Visit visit) {
    for (int z = 0; z < size.z; ++z) {
      for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) visit(glm::ivec3(x, y, z));
      }
    }
  }

  void sampleBlocks() {
    const double halfDiagonal = kCell * kBlock * 0.5 * std::sqrt(3.0);
    forEach(kBlocks, [&](const glm::ivec3& b) {
      Block& block = blockAt(b);
      const glm::dvec3 center = positionOf(b * kBlock) + glm::dvec3(kCell * kBlock * 0.5);
      body_.partsNear(center, halfDiagonal, block.parts);
      // The field is 1-Lipschitz: a block whose centre is farther away than its corners is not crossed.
      if (std::abs(body_.distanceTo(center, block.parts)) > halfDiagonal) return;
      block.values.resize(kSamples * kSamples * kSamples);
      block.vertexOf.assign(kBlock * kBlock * kBlock, -1);
      forEach(glm::ivec3(kSamples), [&](const glm::ivec3& s) {
        block.values[sampleIndex(s.x, s.y, s.z)] =
            static_cast<float>(body_.distanceTo(positionOf(b * kBlock + s), block.parts));
      });
    });
  }

  glm::dvec3 gradient(const Block& block, const glm::dvec3& p) const {
    constexpr double kStep = 1e-4;
    glm::dvec3 result;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 offset(0.0);
      offset[axis] = kStep;
      result[axis] = body_.distanceTo(p + offset, block.parts) - body_.distanceTo(p - offset, block.parts);
    }
    return glm::normalize(result);
  }

  void addVertices() {
    forEach(kBlocks, [&](const glm::ivec3& b) {
      Block& block = blockAt(b);
      if (block.values.empty()) return;
      forEach(glm::ivec3(kBlock), [&](const glm::ivec3& c) { addCellVertices(block, b, c); });
    });
  }

  /// The patches in which the surface crosses a cell, as the patch number of each of its 12 edges (-1 = not
  /// crossed). On a face with four crossings those around the same inside corner belong together, a rule on
  /// which both cells of a face agree: where two sheets pass through one cell they get a vertex each, and no
  /// edge of the mesh is shared by four triangles.
  struct Patches {
    std::array<int, 12> ofEdge;
    int count = 0;
  };

  /// Edge along `axis`; s and t are its places, 0 or 1, along the next two axes.
  static int edgeIndex(int axis, int s, int t) { return axis * 4 + s + 2 * t; }

  static Patches patchesOf(const std::array<float, 8>& corner) {
    std::array<int, 12> group;
    const auto cornerOf = [](int axis, int along, int s, int t) {
      return along << axis | s << (axis + 1) % 3 | t << (axis + 2) % 3;
    };
    const auto isInside = [&](int index) { return corner[index] < 0.0f; };
    for (int axis = 0; axis < 3; ++axis) {
      for (int st = 0; st < 4; ++st) {
        const int s = st & 1, t = st >> 1, edge = edgeIndex(axis, s, t);
        group[edge] = isInside(cornerOf(axis, 0, s, t)) != isInside(cornerOf(axis, 1, s, t)) ? edge : -1;
      }
    }
    const auto join = [&](int a, int b) {
      const int from = group[a], to = group[b];
      for (int& g : group) g = g == from ? to : g;
    };
    for (int face = 0; face < 6; ++face) {
      const int n = face >> 1, side = face & 1;  // normal axis and side; the face spans axes p and q
      const int p = (n + 1) % 3, q = (n + 2) % 3;
      std::array<int, 4> crossed;
      int count = 0;
      // Around the face: each edge ends at the corner where the next begins. Along p, the next two axes are
      // (q, n); along q they are (n, p).
      const std::array<int, 4> around = {edgeIndex(p, 0, side), edgeIndex(q, side, 1), edgeIndex(p, 1, side),
                                         edgeIndex(q, side, 0)};
      for (const int edge : around) {
        if (group[edge] >= 0) crossed[count++] = edge;
      }
      if (count == 2) join(crossed[0], crossed[1]);
      if (count < 4) continue;
      const bool isFirstInside = isInside(side << n);  // the corner between around[3] and around[0]
      join(around[0], isFirstInside ? around[3] : around[1]);
      join(around[2], isFirstInside ? around[1] : around[3]);
    }
    Patches patches;
    patches.ofEdge.fill(-1);
    for (int edge = 0; edge < 12; ++edge) {
      if (group[edge] < 0 || patches.ofEdge[edge] >= 0) continue;
      for (int other = edge; other < 12; ++other) {
        if (group[other] == group[edge]) patches.ofEdge[other] = patches.count;
      }
      ++patches.count;
    }
    return patches;
  }

  static std::array<float, 8> cornersOf(const Block& block, const glm::ivec3& c) {
    std::array<float, 8> corner;
    for (int i = 0; i < 8; ++i) {
      corner[i] = block.values[sampleIndex(c.x + (i & 1), c.y + (i >> 1 & 1), c.z + (i >> 2 & 1))];
    }
    return corner;
  }

  void addCellVertices(Block& block, const glm::ivec3& b, const glm::ivec3& c) {
    const std::array<float, 8> corner = cornersOf(block, c);
    const auto insideCount =
        std::count_if(corner.begin(), corner.end(), [](float value) { return value < 0.0f; });
    if (insideCount == 0 || insideCount == 8) return;
    const Patches patches = patchesOf(corner);
    block.vertexOf[cellIndex(c)] = static_cast<std::int32_t>(shape_.positions.size());
    for (int patch = 0; patch < patches.count; ++patch) {
      glm::dvec3 sum(0.0);
      int crossings = 0;
      for (int axis = 0; axis < 3; ++axis) {
        for (int st = 0; st < 4; ++st) {
          const int s = st & 1, t = st >> 1;
          if (patches.ofEdge[edgeIndex(axis, s, t)] != patch) continue;
          const int i = s << (axis + 1) % 3 | t << (axis + 2) % 3, j = i | 1 << axis;
          glm::dvec3 at(i & 1, i >> 1 & 1, i >> 2 & 1);
          at[axis] = corner[i] / (corner[i] - corner[j]);
          sum += at;
          ++crossings;
        }
      }
      glm::dvec3 p = positionOf(b * kBlock + c) + sum * (kCell / crossings);
      const glm::dvec3 normal = gradient(block, p);
      p -= normal * std::clamp(body_.distanceTo(p, block.parts), -0.3 * kCell, 0.3 * kCell);
      shape_.addVertex(p * kUnitsPerMetre);
      shape_.normals.push_back(glm::vec3(normal));
    }
  }

  /// The vertex of a cell that belongs to its edge along `axis` at (s, t).
  std::uint32_t vertexAt(const glm::ivec3& cell, int axis, int s, int t) {
    const Block& block = blockAt(cell / kBlock);
    const glm::ivec3 local = cell % kBlock;
    const int patch = patchesOf(cornersOf(block, local)).ofEdge[edgeIndex(axis, s, t)];
    return static_cast<std::uint32_t>(block.vertexOf[cellIndex(local)] + patch);
  }

  /// The four cells around each crossed grid edge; the body keeps a cell's distance from the grid's border.
  void addQuads() {
    forEach(kBlocks, [&](const glm::ivec3& b) {
      const Block& block = blockAt(b);
      if (block.values.empty()) return;
      forEach(glm::ivec3(kBlock), [&](const glm::ivec3& c) {
        const float here = block.values[sampleIndex(c.x, c.y, c.z)];
        for (int axis = 0; axis < 3; ++axis) {
          glm::ivec3 next = c, second(0), third(0);
          ++next[axis];
          second[(axis + 1) % 3] = 1;
          third[(axis + 2) % 3] = 1;
          const float there = block.values[sampleIndex(next.x, next.y, next.z)];
          if ((here < 0.0f) == (there < 0.0f)) continue;
          const glm::ivec3 cell = b * kBlock + c;
          const std::array<std::uint32_t, 4> quad = {
              vertexAt(cell - second - third, axis, 1, 1), vertexAt(cell - third, axis, 0, 1),
              vertexAt(cell, axis, 0, 0), vertexAt(cell - second, axis, 1, 0)};
          addQuad(quad, here < 0.0f);
        }
      });
    });
  }

  /// Splits along the shorter diagonal.
  void addQuad(const std::array<std::uint32_t, 4>& q, bool facesForward) {
    const auto squaredLength = [&](int i, int j) {
      const glm::vec3 d = shape_.positions[q[i]] - shape_.positions[q[j]];
      return glm::dot(d, d);
    };
    const int first = squaredLength(0, 2) <= squaredLength(1, 3) ? 0 : 1;
    const std::uint32_t a = q[first], b = q[first + 1], c = q[first + 2], d = q[(first + 3) % 4];
    if (facesForward) {
      shape_.addTriangle(a, b, c);
      shape_.addTriangle(a, c, d);
    } else {
      shape_.addTriangle(a, c, b);
      shape_.addTriangle(a, d, c);
    }
  }

  static constexpr double kUnitsPerMetre =
      2.0;  // as tall as `figure`, so that the same light sizes suit both
  const Body& body_;
  std::vector<Block> blocks_;
  Shape shape_;
};
}  // namespace

scene::SceneDescription makeMannequin(double lightHalfSize) {
  const Body body;
  scene::SceneDescription description;
  description.objects.push_back(
      casterOf("mannequin", SurfaceNets(body).takeShape(), glm::vec3(0.72f, 0.55f, 0.42f)));
  description.objects.push_back(groundObject());
  setView(description, {-3.2, 4.4, 8.8}, {-0.75, 1.45, -0.5}, {5, 9, 4.5}, {0, 1.5, 0}, lightHalfSize);
  return description;
}

}  // namespace halfshadow::scenes
