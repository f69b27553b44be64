// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a caster covers for receivers among its own surfaces. There its silhouette does not tell: the part of
/// it that is nearer to the light than a receiver ends in a contour across its faces, which no chord between
/// silhouette vertices replaces unless it is convex. Near such receivers the faces themselves are listed, and
/// only those in front of all of them are summed up in their boundary.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "outlines/facet_tree.hpp"
#include "outlines/receiver_tiles.hpp"
#include "outlines/tangent_space.hpp"
#include "scene/light_silhouettes.hpp"

namespace halfshadow::outlines {

inline constexpr std::uint32_t kNoFacet = ~0u;
/// In place of a side: all receivers lie in the facet's plane and may be seen from both sides.
inline constexpr int kOwnFacet = 2;

/// The faces of one part of a caster in (t, i). Where the light is on a facet's outer side its vertices run
/// counter-clockwise around what it covers for receivers on the inner side.
struct NearSurface {
  struct Facet {
    std::array<std::uint32_t, 3> vertex{};  ///< in `points`
    std::array<std::uint32_t, 3> beyond{};  ///< the facet across the edge from vertex k, or kNoFacet
    /// Signed distance from its plane, outward positive, times the reciprocal height of a point (t, i):
    /// dot(plane, (t.x, t.y, 1, i)), world units.
    glm::dvec4 plane{0.0};
    glm::vec3 low{0.0f}, high{0.0f};  ///< bounds in (t, i)
    std::uint32_t patch = 0;          ///< facets of one patch follow each other and are about even
  };
  /// Neighbouring facets that are about even.
  struct Patch {
    std::uint32_t firstFacet = 0, facetCount = 0;
    glm::vec3 low{1e30f}, high{-1e30f};  ///< bounds in (t, i)
    glm::dvec3 centerWorld{0.0};         ///< relative to the light's centre
    double radius = 0.0;                 ///< world units
  };
  std::vector<glm::vec3> points;
  std::vector<Patch> patches;
  std::vector<glm::dvec3> pointsWorld;  ///< the same, relative to the light's centre
  std::vector<Facet> facets;
  glm::vec3 low{1e30f}, high{-1e30f};  ///< bounds of all, in (t, i)
  std::size_t number = 0;              ///< among those that one NearSurfaces made or will make
  bool closed = true;                  ///< else a sheet, whose facets cover from both sides
  bool convex = false;  ///< and closed, or even: cut at any height the boundary of its facets tells all
  bool whole = false;   ///< the caster has no other part
  bool cut = false;     ///< it reaches through the light's plane
  /// So near to the light, compared with its farthest point, that one unit of (t, i) for all of its points
  /// would be coarse for most: fragments walk no trees of it.
  bool spread = false;
};

/// What a closed part stands for.
enum class Solid {
  within,  ///< the solid that it bounds
  faces,   ///< the same, never told by its outline, also where it is convex
  around   ///< with the light inside: the solid around a room, whose faces look into it
};

/// What reaches through the plane h = minHeight is cut there.
NearSurface nearSurface(const scene::PlacedCaster& caster, std::uint32_t part, const ListSpace& space,
                        double minHeight, Solid solid = Solid::within);

/// Surfaces of one light's casters, each made when first asked for, by whatever thread.
class NearSurfaces {
 public:
  NearSurfaces() = default;
  NearSurfaces(std::span<const scene::PlacedCaster> casters, const ListSpace& space, double minHeight);
  /// `object`: index of the caster. The reference lasts as long as this object.
  const NearSurface& of(std::uint32_t object, std::uint32_t part, Solid solid = Solid::within);
  /// Of a surface that of() gave; made when first asked for. The reference lasts as long as this object.
  const FacetTrees& treesOf(const NearSurface& surface);
  const ListSpace& space() const { return space_; }
  std::size_t count() const { return count_; }  ///< NearSurface::number is less

 private:
  /// One thread makes it, others wait; it is tried again where making it failed.
  template <typename T>
  class Lazy {
   public:
    template <typename Make>
    const T& get(Make&& make) {
      if (T* const made = ready_.load(std::memory_order_acquire)) return *made;
      const std::lock_guard lock(mutex_);
      if (!made_) {
        made_ = std::make_unique<T>(make());
        ready_.store(made_.get(), std::memory_order_release);
      }
      return *made_;
    }

   private:
    std::atomic<T*> ready_{nullptr};
    std::mutex mutex_;
    std::unique_ptr<T> made_;
  };
  struct Slot {
    Lazy<NearSurface> surface;
    Lazy<FacetTrees> trees;
  };

  std::vector<scene::PlacedCaster> casters_;
  ListSpace space_;
  double minHeight_ = 0.0;
  static constexpr std::size_t kSolids = 3;
  std::vector<std::size_t> firstPart_;  ///< of each caster, among the parts of all
  std::size_t count_ = 0;
  std::unique_ptr<Slot[]> slots_;  ///< by part and Solid; asked for in each tile
};

}  // namespace halfshadow::outlines
