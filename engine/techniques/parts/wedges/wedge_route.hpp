// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The two ways of drawing wedges: volumes on the screen, read against the receivers' depth, or the receivers
/// themselves with the projected silhouettes as varyings.
#pragma once

#include <optional>

#include "techniques/parts/wedges/coincident_receivers.hpp"
#include "techniques/parts/wedges/wedge_passes.hpp"
#include "techniques/parts/wedges/wedge_receivers.hpp"

namespace halfshadow::techniques {

/// The setting `key`, for settings().
SettingInfo routeSetting(const std::string& key);

/// How a group's coverage meets what its target holds.
enum class WedgeMix { add, multiply };

/// A pass over a group of casters, to be given a name; its target is cleared first.
struct GroupTarget {
  framegraph::ResourceId color;
  float clear = 0.0f;
  WedgeMix mix = WedgeMix::add;
  float steps = 0.0f;  ///< of full coverage, for WedgeMix::add
};

/// What draws the wedges of one light in one frame.
class WedgeRoute {
 public:
  const WedgeVolumes& volumes() const { return *volumes_; }
  /// Adds the pass of `groups[index]`; passes are added in the order of the groups. `again`: why the target
  /// is bound another time, empty the first time.
  void addGroup(const LightScene& scene, PassPlan& plan, std::size_t index, const std::string& name,
                const GroupTarget& target, const std::string& again);

 private:
  friend class WedgeRoutes;
  void drawOnScreen(const LightScene& scene, PassPlan& plan, PlannedPass& pass, std::size_t index,
                    const GroupTarget& target) const;
  void drawByReceivers(const LightScene& scene, PassPlan& plan, PlannedPass& pass, std::size_t index,
                       const GroupTarget& target);
  const WedgeVolumes* volumes_ = nullptr;
  std::vector<WedgeGroup> groups_;
  std::optional<ReceiverDepth> depth_;  ///< on the screen
  std::optional<ReceiverDraws> draws_;  ///< by the receivers
  framegraph::ResourceId depthBuffer_;  ///< of the receivers' passes
};

/// Makes routes for a light, and keeps between frames what they share.
class WedgeRoutes {
 public:
  /// Which casters are drawn together.
  using Grouping = std::vector<WedgeGroup> (*)(const outlines::WedgePieces& pieces);
  /// `setting` is the value of a routeSetting(). With `auto`, receivers of few triangles carry the
  /// silhouettes; so do all others where that takes at most 64 draws and 65,536 vertices (none where the
  /// device snapsCoarsely()), else they meet volumes that end behind them. Where receivers coincide, each of
  /// them would take what their pixels are to get once: then all is drawn on the screen. The frame's notes
  /// tell.
  WedgeRoute choose(const LightScene& scene, PassPlan& plan, std::string_view setting, Grouping grouping,
                    CastingReceivers casting);
  /// Adds up all casters in one pass: exact where one caster shadows a receiver. Makes the plan's shading.
  void planSums(const LightScene& scene, PassPlan& plan, std::string_view setting, CastingReceivers casting);
  /// What choose() groups.
  const WedgeVolumes& volumes(const LightScene& scene) { return volumes_.updatePieces(scene); }

 private:
  WedgeVolumeCache volumes_;
  WedgeReceivers receivers_;
  CoincidentReceivers coincident_;
};

}  // namespace halfshadow::techniques
