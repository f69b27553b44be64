// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes of a light, sorted into vertex lists per tile of each receiver and kept in textures: what a
/// fragment walks that gathers its casters.
#pragma once

#include <map>

#include "techniques/core/pass_plan.hpp"
#include "techniques/parts/lists/light_loops.hpp"
#include "techniques/parts/lists/list_textures.hpp"
#include "techniques/parts/lists/screen_walk.hpp"

namespace halfshadow::techniques {

/// Most tiles along a side.
inline constexpr int kMaxTiles = 512;

/// Receivers that get lists.
enum class ListedReceivers { all, casting };

/// What a technique wants in its lists.
struct ListRequest {
  std::span<const outlines::SubLight> subLights;  ///< each with silhouettes of its own
  outlines::ListedEdges edges = outlines::ListedEdges::covering;
  ListedReceivers receivers = ListedReceivers::all;
  int tiles = 128;            ///< along the longer side of what the shadows cover, seen from the light
  std::string_view tilesKey;  ///< the setting that says so, for messages
};

/// What shaders with list_vertices.glsl need to know of a fragment's place: the least height of a receiver;
/// by how many steps vertices are nearer to its height than stored; by how many steps, and by what share of
/// its (t, i), it stands off its facet.
glm::vec4 listPlace(const LightScene& scene, double minHeight);

/// The image as a texture of the plan; `key` changes with its content.
std::uint32_t addList(PassPlan& plan, std::string name, const ListImage& image, std::uint64_t key);

/// The lists of one light.
class LightLists {
 public:
  /// Makes anew what changed. `loops` are updated, too, and must outlive this. Errors: outOfMemory (lists
  /// exceed the largest texture).
  Status update(const LightScene& scene, PassPlan& plan, LightLoops& loops, const ListRequest& request);

  /// Adds textures and uniforms to the plan's shading, for a fragment shader with caster_lists.glsl. It
  /// refers to this object. `own`: how casting receivers walk them where they do that on the screen.
  void provide(const LightScene& scene, PassPlan& plan, const ScreenWalk& own) const;

 private:
  struct Receiver {
    std::uint64_t revision = 0;
    bool seenFromBehind = false, casts = false;
    int doublings = 0;  ///< of its tiles, for what pixels show of them
    outlines::ReceiverTiles tiles;
    outlines::TileLists lists;
    glm::ivec2 firstTexel{0};
  };

  bool haveTrees() const;
  /// What a fragment shader with caster_lists.glsl reads.
  ListReads reads(const LightScene& scene, PassPlan& plan) const;
  /// False when what bounds the tiles changed.
  bool boundShadows(const LightScene& scene);

  const LightLoops* loops_ = nullptr;  ///< of the last update
  std::uint64_t loopsSeen_ = 0;
  outlines::NearSurfaces surfaces_;
  std::uint64_t sceneKey_ = 0;
  outlines::TangentRect shadows_;
  outlines::TileScale scale_;
  double shadowSize_ = 1.0;  ///< the longer side of where shadows meet receivers, on that scale
  /// Of the tiles' size, so that all lists fit; kept while the casters are the same.
  int doublings_ = 0, casterDoublings_ = 0;
  std::vector<std::uint64_t> casters_;           ///< by DrawItem::object
  std::map<std::uint64_t, Receiver> receivers_;  ///< by DrawItem::object
  std::vector<std::uint64_t> encoded_;           ///< those in the textures
  ListImage tiles_, records_;
  std::uint64_t imageKey_ = 0;  ///< counts up with them
};

}  // namespace halfshadow::techniques
