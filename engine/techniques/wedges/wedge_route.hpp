// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The two ways of drawing wedges: volumes on the screen, read against the receivers' depth, or the receivers
/// themselves with the projected silhouettes as varyings.
#pragma once

#include <optional>

#include "techniques/wedge_receivers/wedge_receivers.hpp"
#include "techniques/wedge_volumes/wedge_passes.hpp"

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
  /// Declares the pass of `groups[index]`; passes are declared in the order of the groups. `again`: why the
  /// target is bound another time, empty the first time. Errors: shaderFailed.
  Status declareGroup(const LightFrame& frame, std::size_t index, const std::string& name,
                      const GroupTarget& target, const std::string& again);

 private:
  friend class WedgeRoutes;
  Status addScreenPass(const LightFrame& frame, framegraph::PassDesc pass, std::size_t index,
                       const GroupTarget& target);
  Status addReceiverPass(const LightFrame& frame, framegraph::PassDesc pass, std::size_t index,
                         const GroupTarget& target);
  const WedgeVolumes* volumes_ = nullptr;
  std::vector<WedgeGroup> groups_;
  std::optional<ReceiverDepth> depth_;  ///< on the screen
  std::optional<ReceiverDraws> draws_;  ///< by the receivers
  framegraph::ResourceId depthBuffer_;  ///< of the receivers' passes
};

/// Makes routes, and keeps between frames what they share.
class WedgeRoutes {
 public:
  /// Which casters are drawn together.
  using Grouping = std::vector<WedgeGroup> (*)(const WedgePieces& pieces);
  /// `key` names the setting. With `auto`, receivers carry the silhouettes where that takes few draws: no
  /// receiver of many triangles, or not many pieces that reach one; the frame's notes tell. Errors:
  /// outOfMemory, shaderFailed.
  Result<WedgeRoute> choose(const LightFrame& frame, std::string_view key, Grouping grouping);
  void contextLost();

 private:
  WedgeVolumeCache volumes_;
  std::map<int, WedgeReceivers> receivers_;
};

}  // namespace halfshadow::techniques
