// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Casters whose open borders coincide, as one: the primitives of a mesh of two materials, the walls of a
/// room. Taken alone, each would have a silhouette along the cut, where nothing casts an edge.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scene/caster_geometry.hpp"
#include "scene/light_silhouettes.hpp"

namespace halfshadow::scene {

/// A caster as the scene holds it.
struct SceneCaster {
  const TriangleMesh* mesh = nullptr;
  const CasterGeometry* geometry = nullptr;  ///< its half edges; instances share them
  glm::dmat4 worldFromObject{1.0};
  std::uint64_t revision = 0;  ///< of mesh and place; no other caster has it
  /// Without what alpha cuts out.
  const TriangleMesh& triangles() const { return geometry->triangles(*mesh); }
};

/// Welds casters and keeps what was welded while its members stay. Where all casters are closed it costs a
/// comparison of revisions.
class CasterGroups {
 public:
  CasterGroups();
  ~CasterGroups();
  CasterGroups(CasterGroups&&) noexcept;
  CasterGroups& operator=(CasterGroups&&) noexcept;

  /// Two casters are one where at least two vertices of their open borders coincide in the world, as far as
  /// single precision tells: of each vertex's own coordinates and of the places of the two. Meshes of groups
  /// last until an update that changes their members.
  /// `key` changes with them, 0 = not known.
  void update(std::span<const SceneCaster> casters, std::uint64_t key = 0);
  /// Whether the last update() had this key.
  bool holds(std::uint64_t key) const { return key != 0 && key == key_; }
  /// Each caster that stands alone, and each group once, by first members; `object` is the index in this
  /// list.
  std::span<const PlacedCaster> placed() const { return placed_; }
  /// In placed(), of the i-th caster of the last update().
  std::uint32_t placedOf(std::size_t i) const { return placedOf_[i]; }
  /// Groups that the last update() welded anew.
  std::uint32_t weldedCount() const { return weldedCount_; }

 private:
  struct Border;
  struct Group;
  std::vector<std::vector<std::uint32_t>> findGroups(std::span<const SceneCaster> casters);
  std::vector<SceneCaster> casters_;  ///< of the last update
  std::vector<Border> borders_;       ///< of its open casters
  std::vector<std::unique_ptr<Group>> groups_;
  std::vector<PlacedCaster> placed_;
  std::vector<std::uint32_t> placedOf_;
  std::uint32_t weldedCount_ = 0;
  std::uint64_t key_ = 0;
};

}  // namespace halfshadow::scene
