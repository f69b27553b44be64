// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/convex_hull.hpp"

#include <algorithm>
#include <cmath>

#include "scene/bounds.hpp"

namespace halfshadow::scene {
namespace {
/// Of the points' extent: what lies so near to a face lies in it. Coordinates given in single precision are a
/// thousand times as coarse.
constexpr double kInFace = 1e-11;
constexpr std::uint32_t kNone = ~0u;

struct Face {
  HullFace hull;
  std::array<std::uint32_t, 3> across{kNone, kNone, kNone};  ///< by edge, from corner i to the next
  std::vector<std::uint32_t> outside;                        ///< points before it that no other face has
  bool alive = true;
  double height(const glm::dvec3& p) const { return glm::dot(hull.normal, p) - hull.offset; }
};

/// Based on: Barber, Dobkin, Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996.
class Quickhull {
 public:
  explicit Quickhull(std::span<const glm::dvec3> points) : points_(points) {
    Bounds bounds;
    for (const glm::dvec3& point : points) bounds.include(point);
    if (!points.empty()) tolerance_ = kInFace * glm::length(bounds.high - bounds.low);
  }

  std::optional<std::vector<HullFace>> find() {
    if (!begin()) return std::nullopt;
    while (!open_.empty()) {
      const std::uint32_t face = open_.back();
      open_.pop_back();
      if (faces_[face].alive && !faces_[face].outside.empty() && !extend(face)) return std::nullopt;
    }
    std::vector<HullFace> hull;
    for (const Face& face : faces_) {
      if (face.alive) hull.push_back(face.hull);
    }
    return hull;
  }

 private:
  std::uint32_t farthest(auto distance) const {
    std::uint32_t found = kNone;
    double most = tolerance_;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (const double far = distance(points_[i]); far > most) found = i, most = far;
    }
    return found;
  }

  std::uint32_t addFace(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Face face;
    face.hull.corners = {a, b, c};
    const glm::dvec3 cross = glm::cross(points_[b] - points_[a], points_[c] - points_[a]);
    const double length = glm::length(cross);
    if (length > 0.0) face.hull.normal = cross / length;
    face.hull.offset = glm::dot(face.hull.normal, points_[a]);
    faces_.push_back(std::move(face));
    return static_cast<std::uint32_t>(faces_.size() - 1);
  }

  /// A tetrahedron, with every other point given to a face that it lies before.
  bool begin() {
    if (points_.size() < 4) return false;
    const auto least = std::ranges::min_element(points_, {}, [](const glm::dvec3& p) { return p.x; });
    const auto a = static_cast<std::uint32_t>(least - points_.begin());
    const glm::dvec3 from = points_[a];
    const std::uint32_t b = farthest([&](const glm::dvec3& p) { return glm::length(p - from); });
    if (b == kNone) return false;
    const glm::dvec3 along = glm::normalize(points_[b] - from);
    const std::uint32_t c =
        farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(p - from, along)); });
    if (c == kNone) return false;
    const glm::dvec3 normal = glm::normalize(glm::cross(along, points_[c] - from));
    const std::uint32_t d =
        farthest([&](const glm::dvec3& p) { return std::abs(glm::dot(p - from, normal)); });
    if (d == kNone) return false;
    const bool above = glm::dot(points_[d] - from, normal) > 0.0;
    const std::uint32_t x = above ? c : b, y = above ? b : c;  // a, x, y seen from outside
    addFace(a, x, y), addFace(a, y, d), addFace(y, x, d), addFace(x, a, d);
    faces_[0].across = {3, 2, 1};
    faces_[1].across = {0, 2, 3};
    faces_[2].across = {0, 3, 1};
    faces_[3].across = {0, 1, 2};
    std::vector<std::uint32_t> all(points_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    give(all, 0);
    return true;
  }

  /// Points to those of the faces from `first` on that they lie before; the others are inside.
  void give(const std::vector<std::uint32_t>& points, std::size_t first) {
    for (const std::uint32_t point : points) {
      for (std::size_t f = first; f < faces_.size(); ++f) {
        if (faces_[f].height(points_[point]) <= tolerance_) continue;
        faces_[f].outside.push_back(point);
        break;
      }
    }
    for (std::size_t f = first; f < faces_.size(); ++f) {
      if (!faces_[f].outside.empty()) open_.push_back(static_cast<std::uint32_t>(f));
    }
  }

  struct HorizonEdge {
    std::uint32_t from = 0, to = 0, beyond = 0;
  };

  /// Takes the farthest point before the face into the hull. False when rounding tears the surface.
  bool extend(std::uint32_t seed) {
    const std::uint32_t apex = *std::ranges::max_element(
        faces_[seed].outside, {}, [&](std::uint32_t p) { return faces_[seed].height(points_[p]); });
    std::vector<std::uint32_t> visible{seed}, orphans;
    std::vector<HorizonEdge> horizon;
    faces_[seed].alive = false;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      Face& face = faces_[visible[i]];
      orphans.insert(orphans.end(), face.outside.begin(), face.outside.end());
      face.outside = {};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = face.across[k];
        if (!faces_[other].alive) continue;
        if (faces_[other].height(points_[apex]) > tolerance_) {
          faces_[other].alive = false;
          visible.push_back(other);
        }
      }
    }
    for (const std::uint32_t v : visible) {
      const Face& face = faces_[v];
      for (std::size_t k = 0; k < 3; ++k) {
        if (faces_[face.across[k]].alive)
          horizon.push_back({face.hull.corners[k], face.hull.corners[(k + 1) % 3], face.across[k]});
      }
    }
    std::erase(orphans, apex);
    return close(horizon, apex, orphans);
  }

  /// New faces from the horizon to the apex.
  bool close(const std::vector<HorizonEdge>& horizon, std::uint32_t apex,
             const std::vector<std::uint32_t>& orphans) {
    const std::size_t first = faces_.size();
    for (const HorizonEdge& edge : horizon) addFace(edge.from, edge.to, apex);
    for (std::size_t i = 0; i < horizon.size(); ++i) {
      const auto next = std::ranges::find(horizon, horizon[i].to, &HorizonEdge::from);
      const auto before = std::ranges::find(horizon, horizon[i].from, &HorizonEdge::to);
      if (next == horizon.end() || before == horizon.end()) return false;
      if (std::ranges::count(horizon, horizon[i].from, &HorizonEdge::from) != 1) return false;
      faces_[first + i].across = {
          horizon[i].beyond,
          static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(next - horizon.begin()),
          static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(before - horizon.begin())};
      Face& beyond = faces_[horizon[i].beyond];
      for (std::size_t k = 0; k < 3; ++k) {
        if (beyond.hull.corners[k] == horizon[i].to) beyond.across[k] = static_cast<std::uint32_t>(first + i);
      }
    }
    give(orphans, first);
    return true;
  }

  std::span<const glm::dvec3> points_;
  double tolerance_ = 0.0;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> open_;
};
}  // namespace

std::optional<std::vector<HullFace>> convexHull(std::span<const glm::dvec3> points) {
  return Quickhull(points).find();
}

// Based on: Andrew, Another Efficient Algorithm for Convex Hulls in Two Dimensions, 1979.
std::vector<glm::dvec3> convexPolygon(std::vector<glm::dvec3> points, const glm::dvec3& normal) {
  const glm::dvec3 helper = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, normal)), y = glm::cross(normal, x);
  const auto at = [&](const glm::dvec3& p) { return glm::dvec2(glm::dot(x, p), glm::dot(y, p)); };
  std::ranges::sort(points, [&](const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec2 pa = at(a), pb = at(b);
    return pa.x != pb.x ? pa.x < pb.x : pa.y < pb.y;
  });
  std::vector<glm::dvec3> hull;
  const auto extend = [&](const glm::dvec3& p, std::size_t least) {
    while (hull.size() >= least + 2) {
      const glm::dvec2 a = at(hull[hull.size() - 2]), b = at(hull.back()), c = at(p);
      if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0) break;
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const glm::dvec3& p : points) extend(p, 0);
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin(); p != points.rend(); ++p) extend(*p, lower - 1);
  if (!hull.empty()) hull.pop_back();
  return hull;
}

}  // namespace halfshadow::scene
