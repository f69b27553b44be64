// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/registry/shader_table.hpp"

namespace halfshadow::techniques {
namespace {
using Defines = std::vector<std::string_view>;

/// What selects the way that depth is stored.
const Defines kDepth = {"HS_DEPTH_PACKED24", "HS_DEPTH_PACKED16"};
/// What every program over receivers may have: its output, its facet plane, its draw of two.
const Defines kReceiver = {"HS_VISIBILITY_16", "HS_COUNT_TAPS", "HS_SHADED", "HS_BASE_COLOR_TEXTURE"};
const Defines kMapReceiver = {"HS_FACET_NORMAL", "HS_LIT_OUTSIDE"};
const Defines kTwoDraws = {"HS_PHASE_CLASSIFY", "HS_PHASE_FILTER"};
const Defines kKernel = {"HS_KERNEL", "HS_POISSON_COUNT", "HS_POISSON_TAPS", "HS_ROTATE"};

Defines joined(std::initializer_list<Defines> lists) {
  Defines all;
  for (const Defines& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

gl::AllowedVariants receiver(std::string_view fragmentFile, std::initializer_list<Defines> lists) {
  return {"receiver.vert", fragmentFile, joined({kReceiver, joined(lists)})};
}
}  // namespace

std::vector<gl::AllowedVariants> shaderTable() {
  return {
      {"light_depth.vert", "light_depth.frag", kDepth},
      {"fullscreen.vert", "block_bounds.frag", joined({kDepth, {"HS_FACTOR", "HS_FROM_DEPTH"}})},
      {"fullscreen.vert", "block_dilate.frag", {"HS_REACH_S", "HS_REACH_T", "HS_CELL"}},
      {"fullscreen.vert", "occupancy.frag", kDepth},
      {"fullscreen.vert", "occupancy_level.frag", {"HS_CELL"}},
      {"fullscreen.vert", "pyramid_copy.frag", {}},
      {"fullscreen.vert", "edge_mask.frag", joined({kDepth, {"HS_LAPLACIAN9"}})},
      {"fullscreen.vert", "edge_dilate.frag", {}},
      {"fullscreen.vert", "vsm_moments.frag", joined({kDepth, {"HS_MOMENTS_8"}})},
      {"fullscreen.vert", "vsm_blur.frag", {"HS_MOMENTS_8", "HS_KERNEL"}},
      {"occlusion_slices.vert",
       "occlusion_slices.frag",
       {"HS_SLICE_DEPTH", "HS_LAST_RECEIVERS", "HS_PACK_DEPTH"}},
      {"fullscreen.vert", "occlusion_level.frag", {"HS_FIRST_LEVEL"}},
      {"fullscreen.vert", "occlusion_sum.frag", {"HS_FIRST_STEP"}},
      {"fullscreen.vert", "width_occlusion.frag", joined({kDepth, {"HS_FARTHEST"}})},
      {"fullscreen.vert", "width_minimum.frag", {"HS_NEIGHBOURS"}},
      {"fullscreen.vert", "width_coverage.frag",
       joined({kDepth, {"HS_SAMPLES_S", "HS_SAMPLES_T", "HS_LAST_RECEIVERS"}})},
      {"fullscreen.vert", "width_seed.frag", {}},
      {"fullscreen.vert", "width_flood.frag", {}},
      {"fullscreen.vert", "width_box.frag", {}},
      {"fullscreen.vert", "width_tile.frag", {}},
      {"fullscreen.vert", "width_finish.frag", {}},
      {"volume.vert", "volume.frag", {}},
      {"fullscreen.vert", "volume.frag", {}},
      {"receiver_depth.vert", "receiver_depth.frag", {"HS_FACETS", "HS_FACET_NORMAL"}},
      {"wedge_volume.vert", "wedge_piece.frag", {"HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"}},
      {"wedge_receiver.vert",
       "wedge_receiver.frag",
       {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_EXACT", "HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"}},
      {"fullscreen.vert", "wedge_merge.frag", {}},
      {"caster_volume.vert",
       "caster_cells.frag",
       {"HS_CELLS", "HS_UPPER_CELLS", "HS_CASTING_RECEIVER", "HS_USE_FETCH"}},
      {"caster_volume.vert",
       "caster_blend.frag",
       {"HS_BLEND", "HS_QUADRANT", "HS_CENTRES", "HS_MERGED", "HS_HALVES", "HS_USE_FETCH",
        "HS_CASTING_RECEIVER"}},
      {"fullscreen.vert", "vbuffer_add.frag", {}},
      {"fullscreen.vert", "cell_mean.frag", {}},
      receiver("none.frag", {}),
      receiver("hard.frag", {kDepth, kMapReceiver, {"HS_COUNT_SHADOWED"}}),
      receiver("occlusion_textures.frag",
               {{"HS_SLOTS", "HS_TEXTURES", "HS_BOXES", "HS_FILTER_NBUFFER", "HS_FILTER_MIPMAP",
                 "HS_FILTER_SAT", "HS_COMBINE_SUM", "HS_COMBINE_PRODUCT", "HS_COMBINE_MAX", "HS_SLICE_DEPTH",
                 "HS_CONCENTRIC", "HS_SAT_SMOOTH", "HS_CASTING_RECEIVER", "HS_LAST_RECEIVERS"}}),
      receiver("pcf.frag", {kDepth, kMapReceiver, kKernel}),
      receiver("pcf_masked.frag",
               {kDepth, kMapReceiver, kKernel, kTwoDraws, {"HS_MASK_EDGES", "HS_SKIP_LOOP"}}),
      receiver("pcf_quantized.frag",
               {kDepth, kMapReceiver, kTwoDraws, {"HS_SPREAD_KERNEL", "HS_SEARCH", "HS_CASTING_RECEIVER"}}),
      receiver("pcf_quantized_paper.frag", {kDepth, kMapReceiver, {"HS_SPREAD_KERNEL"}}),
      receiver("pcss.frag", {kDepth, kMapReceiver, kTwoDraws, {"HS_SEARCH", "HS_SPREAD_KERNEL"}}),
      receiver("pcss_mip.frag",
               {kDepth, kMapReceiver, kTwoDraws, {"HS_SPREAD_KERNEL", "HS_SEARCH", "HS_CASTING_RECEIVER"}}),
      receiver("vsm.frag", {kDepth, kMapReceiver, {"HS_MOMENTS_8"}}),
      receiver("shadow_width.frag", {kDepth,
                                     kMapReceiver,
                                     {"HS_POINT_LIGHT", "HS_PAPER", "HS_ATTENUATION_TEXTURE", "HS_CORNERS",
                                      "HS_CASTING_RECEIVER"}}),
      receiver("wedges_cells.frag", {kMapReceiver,
                                     kTwoDraws,
                                     {"HS_CELLS", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
                                      "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("screen_counts.frag", {}),
      receiver("screen_visibility.frag", {}),
      receiver("wedges_blended.frag", {kMapReceiver,
                                       kTwoDraws,
                                       {"HS_CENTRES", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
                                        "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("screen_wedges.frag",
               {kMapReceiver,
                {"HS_WEDGE_SUMS", "HS_WEDGE_SHARES", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
                 "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("screen_cells.frag", {kMapReceiver,
                                     {"HS_CELL_TARGETS", "HS_CELLS", "HS_CASTING_RECEIVER", "HS_ONE_SIDED",
                                      "HS_LISTS", "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("shade_lights.frag", {}),
  };
}

}  // namespace halfshadow::techniques
