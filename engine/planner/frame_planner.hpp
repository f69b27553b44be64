// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What this frame needs: which casters can matter, which light views are still valid, and the reason of
/// every skip. Pure data, no GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/light_fit.hpp"
#include "scene/bounds.hpp"
#include "scene/camera.hpp"
#include "scene/light.hpp"
#include "scene/supporting_planes.hpp"

namespace halfshadow::planner {

// X(enumerator, "code", "sentence")
#define HALFSHADOW_SKIP_LIST(X)                                                                        \
  X(unchanged, "unchanged", "its inputs have the same revisions as when it was last made")             \
  X(behindLight, "behind-light", "the caster lies wholly behind the light's plane")                    \
  X(noReceiverBehind, "no-receiver-behind", "no receiver lies in the caster's shadow region")          \
  X(nothingBeyond, "nothing-beyond", "no receiver lies beyond the caster, seen from the light")        \
  X(shadowOutOfView, "shadow-out-of-view", "the caster's shadow region misses every visible receiver") \
  X(receiverOutOfView, "receiver-out-of-view", "the receiver lies outside the camera's view")          \
  X(noCasters, "no-casters", "no caster can shadow a receiver")                                        \
  X(lightOff, "light-off", "the light has no intensity")                                               \
  X(notRead, "not-read", "no pass reads its result")

enum class SkipReason {
#define HALFSHADOW_SKIP_ENUM(name, code, text) name,
  HALFSHADOW_SKIP_LIST(HALFSHADOW_SKIP_ENUM)
#undef HALFSHADOW_SKIP_ENUM
};
std::string_view skipCode(SkipReason reason);
std::string_view skipText(SkipReason reason);

/// One object as the planner sees it. `revision` changes whenever its mesh or transform does.
struct PlannedObject {
  std::uint32_t id = 0;
  scene::Bounds boundsWorld;
  std::uint64_t revision = 0;
  bool casts = true, receives = true;
  /// Its shape, all three or none: with them more casters are known to shadow nothing (see separation.hpp).
  const scene::TriangleMesh* mesh = nullptr;
  const scene::SupportingPlanes* support = nullptr;
  glm::dmat4 worldFromObject{1.0};
};

struct FrameInput {
  std::span<const PlannedObject> objects;
  const scene::Camera* camera = nullptr;
  double aspectWidthOverHeight = 1.0;
  std::span<const scene::AreaLight> lights;
  std::span<const std::uint64_t> lightRevisions;
};

struct Skip {
  std::string what;  ///< "caster 3", "receiver 7", "light 0"
  SkipReason reason = SkipReason::unchanged;
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
class FramePlanner {
 public:
  FramePlan plan(const FrameInput& input);

 private:
  struct LightHistory {
    std::uint64_t lightRevision = 0;
    std::uint64_t castersRevision = 0;
    int changedFramesRunning = 0;
    std::vector<std::uint32_t> drawnIds;  ///< sorted
    std::uint64_t key = 0;
    bool reduced = false;  ///< the view lacks casters that no visible receiver needed
    // Searched again only when the scene or the light changes; or the camera, where relevance depends on it.
    std::uint64_t sceneRevision = 0;
    struct ByCamera {
      std::uint32_t caster = 0, receiver = 0;  ///< indices
      bool cannotShadow = false;
    };
    std::vector<ByCamera> byCamera;
    std::uint64_t cameraKey = 0;
    std::vector<std::uint32_t> relevant;
    std::vector<Skip> irrelevant;
  };
  struct Receivers {
    std::vector<std::uint32_t> all, visible;  // largest first
  };
  /// Of all objects, once a frame.
  struct Revisions {
    std::uint64_t casters = 0, scene = 0;
  };
  static Revisions revisionsOf(const FrameInput& input);
  static void findRelevant(const FrameInput& input, std::size_t light, const Receivers& receivers,
                           LightHistory& history);
  static bool relevanceIsStale(const FrameInput& input, std::size_t light, LightHistory& history);
  static LightPlan planLight(const FrameInput& input, std::size_t light, const Receivers& receivers,
                             const Revisions& revisions, LightHistory& history, std::vector<Skip>& skips);
  std::vector<LightHistory> history_;
};

/// True when the caster's penumbra region (all rays from points of the light through the box) can meet the
/// other box. Conservative: never false when a shadow is possible.
bool shadowRegionMeets(const scene::AreaLight& light, const scene::Bounds& casterWorld,
                       const scene::Bounds& receiverWorld);

/// True when the box can be inside the camera's view. Conservative.
bool visibleFrom(const scene::Camera& camera, double aspectWidthOverHeight, const scene::Bounds& boundsWorld);
bool visibleIn(const glm::dmat4& clipFromWorld, const scene::Bounds& boundsWorld);

}  // namespace halfshadow::planner
