// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Penumbra wedges of a light on the GPU: made once per content, drawn by every wedge technique.
#pragma once

#include "outlines/wedge_pieces.hpp"
#include "techniques/parts/screen/receiver_depth.hpp"
#include "techniques/parts/wedges/volume_boxes.hpp"

namespace halfshadow::techniques {

/// A vertex counts for a receiver that is so much farther from the light, over the receiver's distance from
/// the eye: hundreds of times what rounding of stored distances moves it, a fraction of a pixel. Where a
/// caster ends in a contour close to a receiver among its faces, a chord across it stands in, which rounding
/// would turn.
inline constexpr double kNearOfDistance = 256.0 / (1 << 20);

/// The wedges of one light.
struct WedgeVolumes {
  std::uint64_t contentKey = 0;
  scene::LightPlane plane;
  double farthest = 1.0;  ///< largest height of a receiver
  /// Volumes end a little behind the farthest receiver, so that it lies inside whatever rounding does.
  double end() const { return 1.01 * farthest; }
  double reach = 1.0;  ///< volumes end here sideways: half a side of a square of (a, b) around the receivers
  scene::LightSilhouetteCache silhouettes;
  outlines::WedgePieces pieces;
  bool takenTogether = false;   ///< some casters are one, see outlines::takenTogether()
  bool lightEnclosed = false;   ///< a closed caster stands around the light's centre: nothing outside is lit
  double stepsPerUnit = 1.0;    ///< of the vertex stream: 1 where fragments have highp
  std::uint64_t streamKey = 0;  ///< of what the stream was made from
  bool trimmed = false;         ///< volumes end before the farthest receiver
  bool small = false;           ///< by more than half of their length, on average
  PlannedBuffer stream{.id = 1};
  VolumeIndices indices;
  std::uint32_t streamInPlan = 0, indicesInPlan = 0;
};

/// A contiguous range of casters.
struct CasterRange {
  std::uint32_t first = 0, count = 0;
};

/// Receivers of a piece, told apart by their height; each has its own program.
enum class WedgePart {
  beside,  ///< not all of the piece is nearer to the light: HS_WEDGE_CLIP
  beyond   ///< all of it is
};

/// Keeps the wedges of a light between frames.
class WedgeVolumeCache {
 public:
  /// The wedges for this frame, made again only when light, casters or the receivers' reach changed. The
  /// reference lasts as long as this.
  const WedgeVolumes& updatePieces(const LightScene& scene);
  /// The same for the buffers, which go to the plan. `ends`, one a piece: the largest height of a receiver
  /// that its volume must hold, 0 = none; empty: all receivers. `endsKey` changes with them.
  void addBuffers(const LightScene& scene, PassPlan& plan, const ReceiverDepth& depth,
                  std::span<const double> ends, std::uint64_t endsKey);

 private:
  WedgeVolumes volumes_;
};

/// Adds draws like `draw` of the volumes of casters, to a pass whose depth attachment is
/// ReceiverDepth::depthTest; its program is made of wedge_volume.vert with a fragment shader that includes
/// wedge_piece.glsl. Pixels of receivers outside the volume may be touched: what a piece contributes there is
/// 0 by its arithmetic. Depth and cull of the state are set here.
void addWedgeVolumes(PlannedPass& pass, PlannedDraw draw, const WedgeVolumes& volumes,
                     const ReceiverDepth& depth, const View& view, std::span<const CasterRange> casters,
                     WedgePart part);

}  // namespace halfshadow::techniques
