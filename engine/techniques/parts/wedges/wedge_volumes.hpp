// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Penumbra wedges of a light on the GPU: made once per content, drawn by every wedge technique.
#pragma once

#include <map>

#include "outlines/wedge_pieces.hpp"
#include "techniques/parts/screen/receiver_depth.hpp"

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
  bool lightEnclosed = false;   ///< a closed caster stands around the light's centre: nothing outside is lit
  double stepsPerUnit = 1.0;    ///< of the vertex stream: 1 where fragments have highp
  std::uint64_t streamKey = 0;  ///< of what the buffers hold
  bool trimmed = false;         ///< volumes end before the farthest receiver
  bool small = false;           ///< by more than half of their length, on average
  gl::Buffer vertices, indices;
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

/// Keeps the wedges of each light between frames.
class WedgeVolumeCache {
 public:
  /// The wedges for this frame, made again only when light, casters or the receivers' reach changed. The
  /// pointer stays valid until contextLost().
  const WedgeVolumes* updatePieces(const LightFrame& frame);
  /// The same for the buffers. `ends`, one a piece: the largest height of a receiver that its volume must
  /// hold, 0 = none; empty: all receivers. `endsKey` changes with them. Errors: outOfMemory.
  Status upload(const LightFrame& frame, const ReceiverDepth& depth, std::span<const double> ends,
                std::uint64_t endsKey);
  void contextLost() { volumes_.clear(); }

 private:
  std::map<int, WedgeVolumes> volumes_;
};

/// Draws the volumes of casters, in a pass whose depth attachment is ReceiverDepth::depthTest. The program is
/// current and made of wedge_volume.vert with a fragment shader that includes wedge_piece.glsl. Pixels of
/// receivers outside the volume may be touched: what a piece contributes there is 0 by its arithmetic.
/// `state.depth` and `state.cull` are set here.
void drawWedgeVolumes(framegraph::PassContext& context, gl::Program& program, const WedgeVolumes& volumes,
                      const ReceiverDepth& depth, const View& view, std::span<const CasterRange> casters,
                      WedgePart part, gl::DrawState state);

}  // namespace halfshadow::techniques
