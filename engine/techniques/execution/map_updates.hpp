// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Maps follow what moves: of a pass that draws casters into what it keeps, only the part is drawn again in
/// which something is different, and in it all that lies there. No GL.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "techniques/core/pass_plan.hpp"
#include "techniques/execution/item_history.hpp"

namespace halfshadow::techniques {

/// Setting map_updates.
enum class UpdateRule {
  never,
  worthwhile,  ///< where it saves more draws than loading the target costs a GPU that renders by tiles
  always
};
UpdateRule updateRuleOf(const Settings& settings);

/// Of one light under one technique, from frame to frame.
class MapUpdates {
 public:
  /// A draw of a pass, in the part of the target where it is different.
  struct DrawPart {
    TexelRect part;
    std::vector<std::uint32_t> items;  ///< of the draw's, that may set texels there
  };
  /// How often casters were drawn into a map, and how often the map kept them.
  struct Counts {
    std::uint64_t drawn = 0, kept = 0;
  };

  /// Items with what tells them apart, see ItemHistory::update().
  struct KeyedItems {
    std::span<const DrawItem> items;
    std::span<const ItemHistory::Key> keys;
    ListChanges changes;
  };
  /// Finds what of the plan's passes is different from what they drew. The plan stays until the frame ends.
  void begin(const PassPlan& plan, UpdateRule rule, const KeyedItems& casters);
  /// For the graph: `fromKey` is 0 where the pass can only be drawn whole.
  framegraph::Update updateOf(std::size_t pass) const;
  /// By draw, of a pass with an update.
  const std::vector<DrawPart>& parts(std::size_t pass) const { return passes_[pass].parts; }
  enum class Extent { whole, update };
  /// The pass of the plan was drawn.
  void drawn(std::size_t pass, Extent extent);
  const Counts& counts() const { return counts_; }  ///< since begin()

 private:
  /// What a draw of a pass was made from when the pass was last drawn, all but its items.
  struct DrawnDraw {
    device::ProgramVariant program;
    PlannedDraw draw;
    std::uint64_t readKey = 0;     ///< of what it reads
    std::uint64_t generation = 0;  ///< of its items
    ItemPlaces places;
  };
  struct DrawnPass {
    std::uint64_t contentKey = 0;
    std::vector<framegraph::Attachment> writes;
    std::vector<DrawnDraw> draws;
  };
  /// A pass in this frame.
  struct PassNow {
    bool followed = false;
    bool changed = false;  ///< its content is another than that which it last drew
    bool alike = false;    ///< at most its items are others
    std::uint64_t fromKey = 0;
    std::vector<std::uint32_t> lists;  ///< by draw, in `lists_`
    std::vector<DrawPart> parts;
    std::vector<Rect> clearedParts;
  };
  struct ListNow {
    std::span<const DrawItem> items;
    bool takenOver = false;
  };
  bool isFollowed(const PlannedPass& pass) const;
  std::uint64_t readKeyOf(const PlannedDraw& draw) const;
  MapWindow windowOf(const PlannedPass& pass, const PlannedDraw& draw) const;
  std::uint32_t listOf(std::span<const DrawItem> items);
  void follow(const PlannedPass& pass, PassNow& now, UpdateRule rule, const KeyedItems& casters);
  bool isDrawnAlike(const PlannedPass& pass, const DrawnPass& drawn) const;
  /// Where the pass is different. False where that cannot be told.
  bool findParts(const PlannedPass& pass, const DrawnPass& drawn, PassNow& now) const;
  void findItems(const PlannedPass& pass, DrawnPass& drawn, PassNow& now);
  bool pays(const PlannedPass& pass, const PassNow& now) const;
  void remember(const PlannedPass& pass, const PassNow& now, DrawnPass& drawn) const;

  const PassPlan* plan_ = nullptr;
  std::map<std::string, DrawnPass, std::less<>> drawn_;  ///< by name
  std::vector<ItemHistory> lists_;                       ///< in the order in which plans name them
  std::vector<ListNow> listsNow_;                        ///< the same of this frame's plan
  std::vector<PassNow> passes_;
  std::uint64_t nextGeneration_ = 1;
  Counts counts_;
};

}  // namespace halfshadow::techniques
