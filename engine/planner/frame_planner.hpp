// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What this frame needs: which casters can matter, which light views are still valid, and the reason of
/// every skip. Pure data, no GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/list_changes.hpp"
#include "planner/light_space.hpp"
#include "planner/skips.hpp"
#include "scene/bounds.hpp"
#include "scene/camera.hpp"
#include "scene/convex_hull.hpp"
#include "scene/light.hpp"
#include "scene/supporting_planes.hpp"

namespace halfshadow::planner {

/// One object as the planner sees it. `revision` changes whenever its mesh or transform does.
struct PlannedObject {
  std::uint32_t id = 0;
  scene::Bounds boundsWorld;
  std::uint64_t revision = 0;
  bool casts = true, receives = true;
  /// Its shape, all three or none: with them more casters are known to shadow nothing (see separation.hpp).
  const scene::TriangleMesh* mesh = nullptr;
  const scene::SupportingPlanes* support = nullptr;
  const scene::EnclosingPoints* enclosing = nullptr;  ///< of the mesh, or null: then all of it is looked at
  glm::dmat4 worldFromObject{1.0};
};

/// What tells an object from others and from itself at another time; apart from the object, so that looking
/// through all touches little memory.
struct ObjectKey {
  std::uint32_t id = 0;
  std::uint64_t revision = 0;
};

struct FrameInput {
  std::span<const PlannedObject> objects;
  /// Where the caller knows: those of the objects, by index, that may have another revision than when the
  /// planner was last asked, of the same list otherwise. Then it looks at no other.
  std::optional<std::span<const std::uint32_t>> changed{};
  const scene::Camera* camera = nullptr;
  double aspectWidthOverHeight = 1.0;
  std::span<const scene::AreaLight> lights;
  std::span<const std::uint64_t> lightRevisions;
  /// By which lights are known from frame to frame, and named; none: their places.
  std::span<const std::uint32_t> lightNumbers;
  /// Surfaces that are no object receive too: every caster may shadow one.
  bool receiversUnknown = false;
};

struct LightPlan {
  std::vector<std::uint32_t> casters;  ///< indices into FrameInput::objects, in order
  std::uint64_t contentKey = 0;        ///< of the light, the casters drawn and their revisions; never 0
  bool active = true;                  ///< false: no caster matters, visibility is 1 everywhere
};

struct FramePlan {
  std::vector<std::uint32_t> receivers;  ///< indices into FrameInput::objects
  std::vector<LightPlan> lights;
  std::vector<Skip> skips;
  std::uint64_t sceneRevision = 0;  ///< of all objects: changes with any of them
};

/// Keeps, per light, which casters the cached light view holds.
///
/// Static casters and light: the view is made from every caster that can shadow any receiver, whatever the
/// camera sees, so that a camera-only move changes no key, unless the camera comes to see the inside of a
/// closed caster or what is sunk below a ground. While
/// a caster or the light changes in two frames running (the view is remade anyway), casters whose shadow
/// region misses all visible receivers are dropped too; when the movement ends and the camera needs a dropped
/// caster, the view is remade once.
///
/// What does not change is not looked at again: where one object moves, the work left for all others is a
/// comparison of revisions.
class FramePlanner {
 public:
  FramePlanner();
  ~FramePlanner();
  FramePlanner(FramePlanner&&) noexcept;
  FramePlanner& operator=(FramePlanner&&) noexcept;
  FramePlan plan(const FrameInput& input);
  /// Pairs of caster and receiver that were looked at, since it was made.
  std::uint64_t pairsAsked() const;

 private:
  struct LightHistory;
  /// An object as it was when the frame before was planned.
  struct Known {
    std::uint64_t key = 0;  ///< of it and its roles; 0: not looked at yet
    bool casts = false;
  };
  /// A visible receiver and where it may begin, seen from the eye.
  struct Placed {
    double nearest = 0.0;
    std::uint32_t object = 0;
    auto operator<=>(const Placed&) const = default;
  };
  void observe(const FrameInput& input);
  void findMoved(const FrameInput& input);
  ListChanges moves() const { return {movesRevision_, moved_}; }
  void listObjects(const FrameInput& input);
  void place(const FrameInput& input, const glm::dmat4& clipFromWorld, std::uint32_t object);
  void listReceivers(const FrameInput& input, FramePlan& plan) const;
  LightHistory& historyOf(std::uint32_t number);
  std::uint64_t castersKeyOf(LightHistory& history) const;
  LightPlan planLight(const FrameInput& input, std::size_t light, LightHistory& history,
                      std::vector<Skip>& skips);

  std::uint64_t cameraKey_ = 0;
  std::vector<ObjectKey> keys_;
  std::vector<Known> known_;
  std::vector<char> casters_, receivers_, visible_;  ///< by object: whether it is one
  std::vector<std::uint32_t> largestFirst_;          ///< receivers, the likeliest to be shadowed first
  std::vector<Placed> frontToBack_;                  ///< visible receivers
  /// The same without the places, so that lists of receivers are copied from it.
  std::vector<std::uint32_t> receiversInOrder_;
  std::vector<std::uint32_t> foundMoved_, moved_;  ///< in this frame; in the last in which any did; ascending
  std::vector<std::uint64_t> foundChanges_, keyChanges_;  ///< of their keys
  std::uint64_t movesRevision_ = 0;                       ///< see moves()
  std::uint64_t castersRevision_ = 0, sceneRevision_ = 0;
  bool objectsListed_ = false;  ///< in this frame the list of objects was another
  std::vector<std::unique_ptr<LightHistory>> histories_;
};

// Of the input, for what is kept between frames.
std::uint64_t lightRevisionOf(const FrameInput& input, std::size_t light);
std::uint32_t lightNumberOf(const FrameInput& input, std::size_t light);
std::uint64_t cameraKeyOf(const FrameInput& input);

/// True when the caster's penumbra region (all rays from points of the light through the box) can meet the
/// other box. Conservative: never false when a shadow is possible.
bool shadowRegionMeets(const scene::AreaLight& light, const scene::Bounds& casterWorld,
                       const scene::Bounds& receiverWorld);
/// The same where the light's space is known.
bool shadowRegionMeets(const scene::AreaLight& light, const LightSpace& space,
                       const scene::Bounds& casterWorld, const scene::Bounds& receiverWorld);

/// True when the box can be inside the camera's view. Conservative.
bool visibleFrom(const scene::Camera& camera, double aspectWidthOverHeight, const scene::Bounds& boundsWorld);
bool visibleIn(const glm::dmat4& clipFromWorld, const scene::Bounds& boundsWorld);

}  // namespace halfshadow::planner
