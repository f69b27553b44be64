// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// outlines::Coverage drawn with the receivers themselves: silhouettes projected onto the light's plane are
/// linear in the receiver's position, so they are varyings. No depth texture, no precision in fragments but
/// that of a quotient, and no fragment off the receivers. Receivers of few triangles are cut to what each
/// piece can shadow, once for all cameras: one draw of all pieces. Others are drawn whole, a draw for each
/// piece that can reach them. Based on: Akenine-Moller, Assarsson 2002, evaluated on the receiver's geometry
/// instead of the wedge's.
#pragma once

#include <map>

#include "outlines/footprints.hpp"
#include "techniques/parts/wedges/wedge_volumes.hpp"

namespace halfshadow::techniques {

/// Casters that are drawn together.
using WedgeGroup = std::vector<CasterRange>;

/// How one receiver meets the wedges of a light.
struct WedgeReceiver {
  std::uint64_t revision = 0;
  outlines::LightBox bounds;
  std::size_t vertexCount = 0;  ///< of the mesh
  bool cut = false;             ///< to footprints; else it is drawn whole
  PlannedBuffer footprints;
  struct Range {
    std::size_t first = 0, count = 0;
  };
  std::vector<Range> ranges;  ///< in `footprints`: two a group, of WedgePart::beside and ::beyond
};

/// One draw over a receiver.
struct ReceiverDraw {
  std::size_t item = 0;  ///< in LightScene::receivers
  WedgePart part = WedgePart::beyond;
  const WedgeReceiver* receiver = nullptr;
  WedgeReceiver::Range range;  ///< of receiver->footprints
  std::uint32_t piece = 0;     ///< of receivers drawn whole
  Rect scissor;                ///< of receivers drawn whole: what the piece's volume can touch
};

/// What a frame draws for each group.
struct ReceiverDraws {
  bool allCut = true;  ///< receivers of few triangles have footprints; else there are too many
  std::vector<std::vector<ReceiverDraw>> groups;
  std::size_t wholeDraws = 0, wholeVertices = 0;  ///< over all groups
};

/// Where receivers that cast have their shadows from.
enum class CastingReceivers {
  drawn,  ///< from what is drawn over them, like all others
  listed  ///< from lists (own_receivers.hpp): what is drawn over them is not read
};

/// Keeps footprints between frames.
class WedgeReceivers {
 public:
  /// Cuts receivers that are new or moved, or all when the wedges changed, and lists the frame's draws in an
  /// order of few program changes. Receivers of few triangles that are listed are left out. Pointers hold
  /// until the next update.
  ReceiverDraws update(const LightScene& scene, const WedgeVolumes& volumes,
                       std::span<const WedgeGroup> groups, CastingReceivers casting);

 private:
  void cut(const WedgeVolumes& volumes, std::span<const WedgeGroup> groups, const DrawItem& item,
           WedgeReceiver& receiver);
  std::uint64_t contentKey_ = 0;
  std::map<std::uint64_t, WedgeReceiver> receivers_;  ///< by DrawItem::object
};

/// Whether this device's rasteriser moves vertices so much that narrow penumbrae show it.
/// outlines::Footprints then find their place by the pixel's ray, which only fragments with highp can.
bool snapsCoarsely(const device::Capabilities& capabilities);

/// Leaves the draws of receivers with footprints.
void keepFootprints(ReceiverDraws& draws);

/// For each piece the largest height of a receiver of many triangles that it can reach, 0 where there is
/// none.
struct VolumeEnds {
  std::vector<double> heights;
  std::uint64_t key = 0;
};
VolumeEnds volumeEnds(const LightScene& scene, const WedgeVolumes& volumes);

/// Fills the depth attachment with the visible surfaces; writes no colour.
PlannedDraw receiverSurfaces(const LightScene& scene, PassPlan& plan);

/// How wedges are drawn with the receivers.
struct ReceiverWedges {
  std::vector<std::string> defines;  ///< of wedge_receiver.frag
  glm::dmat4 clipFromWorld{1.0};     ///< what the depth attachment was drawn with
  device::BlendState blend;
  float steps = 0.0f;  ///< of full coverage
};
/// Draws where the surface is the visible one.
void addReceiverWedges(const LightScene& scene, PassPlan& plan, PlannedPass& pass,
                       const WedgeVolumes& volumes, std::span<const ReceiverDraw> draws,
                       const ReceiverWedges& how);

}  // namespace halfshadow::techniques
