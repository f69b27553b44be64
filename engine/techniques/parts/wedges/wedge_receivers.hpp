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
  gl::Buffer footprints;
  struct Range {
    std::size_t first = 0, count = 0;
  };
  std::vector<Range> ranges;  ///< in `footprints`: two a group, of WedgePart::beside and ::beyond
};

/// One draw over a receiver.
struct ReceiverDraw {
  std::size_t item = 0;  ///< in LightFrame::receivers
  WedgePart part = WedgePart::beyond;
  const WedgeReceiver* receiver = nullptr;
  WedgeReceiver::Range range;  ///< of receiver->footprints
  std::uint32_t piece = 0;     ///< of receivers drawn whole
  gl::Rect scissor;            ///< of receivers drawn whole: what the piece's volume can touch
};

/// What a frame draws for each group.
struct ReceiverDraws {
  bool allCut = true;  ///< receivers of few triangles have footprints; else there are too many
  std::vector<std::vector<ReceiverDraw>> groups;
  std::size_t wholeDraws = 0, wholeVertices = 0;  ///< over all groups
};

/// Keeps footprints between frames.
class WedgeReceivers {
 public:
  /// Cuts receivers that are new or moved, or all when the wedges changed, and lists the frame's draws in an
  /// order of few program changes. Pointers hold until the next update. Errors: outOfMemory.
  Result<ReceiverDraws> update(const LightFrame& frame, const WedgeVolumes& volumes,
                               std::span<const WedgeGroup> groups);

 private:
  Status cut(const LightFrame& frame, const WedgeVolumes& volumes, std::span<const WedgeGroup> groups,
             const DrawItem& item, WedgeReceiver& receiver);
  std::uint64_t contentKey_ = 0;
  std::map<const void*, WedgeReceiver> receivers_;  ///< by the object's geometry
};

/// Whether this device's rasteriser moves vertices so much that narrow penumbrae show it.
/// outlines::Footprints then find their place by the pixel's ray, which only fragments with highp can.
bool snapsCoarsely(const device::Capabilities& capabilities);

/// Programs of wedge_receiver.frag: of footprints and of whole receivers, for both parts.
struct ReceiverWedgePrograms {
  gl::Program* byKind[2][2] = {};  ///< [cut][beyond]
};
/// Errors: shaderFailed.
Result<ReceiverWedgePrograms> receiverWedgePrograms(const LightFrame& frame,
                                                    const std::vector<std::string>& defines);

/// Leaves the draws of receivers with footprints.
void keepFootprints(ReceiverDraws& draws);

/// For each piece the largest height of a receiver of many triangles that it can reach, 0 where there is
/// none.
struct VolumeEnds {
  std::vector<double> heights;
  std::uint64_t key = 0;
};
VolumeEnds volumeEnds(const LightFrame& frame, const WedgeVolumes& volumes);

/// Fills the depth attachment with the visible surfaces; writes no colour.
void drawReceiverDepth(framegraph::PassContext& context, gl::Program& program, const View& view,
                       std::span<const DrawItem> items);

/// Draws where the surface is the visible one, `steps` of full coverage, blended. `clipFromWorld`: what the
/// depth attachment was drawn with.
void drawReceiverWedges(framegraph::PassContext& context, const ReceiverWedgePrograms& programs,
                        const WedgeVolumes& volumes, const View& view, const glm::dmat4& clipFromWorld,
                        std::span<const DrawItem> items, std::span<const ReceiverDraw> draws,
                        const gl::BlendState& blend, float steps);

}  // namespace halfshadow::techniques
