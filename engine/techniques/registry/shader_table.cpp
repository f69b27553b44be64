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
  return {"receiver/receiver.vert", fragmentFile, joined({kReceiver, joined(lists)})};
}
}  // namespace

std::vector<gl::AllowedVariants> shaderTable() {
  return {
      {"map/light_depth.vert", "map/light_depth.frag", kDepth},
      {"screen/fullscreen.vert", "map/block_bounds.frag", joined({kDepth, {"HS_FACTOR", "HS_FROM_DEPTH"}})},
      {"screen/fullscreen.vert", "map/block_dilate.frag", {"HS_REACH_S", "HS_REACH_T", "HS_CELL"}},
      {"screen/fullscreen.vert", "map/occupancy.frag", kDepth},
      {"screen/fullscreen.vert", "map/occupancy_level.frag", {"HS_CELL"}},
      {"screen/fullscreen.vert", "map/pyramid_copy.frag", {}},
      {"screen/fullscreen.vert", "map/edge_mask.frag", joined({kDepth, {"HS_LAPLACIAN9"}})},
      {"screen/fullscreen.vert", "map/edge_dilate.frag", {}},
      {"screen/fullscreen.vert", "map/vsm_moments.frag", joined({kDepth, {"HS_MOMENTS_8"}})},
      {"screen/fullscreen.vert", "map/vsm_blur.frag", {"HS_MOMENTS_8", "HS_KERNEL"}},
      {"occlusion/occlusion_slices.vert",
       "occlusion/occlusion_slices.frag",
       {"HS_SLICE_DEPTH", "HS_LAST_RECEIVERS", "HS_PACK_DEPTH"}},
      {"screen/fullscreen.vert", "occlusion/occlusion_level.frag", {"HS_FIRST_LEVEL"}},
      {"screen/fullscreen.vert", "occlusion/occlusion_sum.frag", {"HS_FIRST_STEP"}},
      {"screen/fullscreen.vert", "width/width_occlusion.frag", joined({kDepth, {"HS_FARTHEST"}})},
      {"screen/fullscreen.vert", "width/width_minimum.frag", {"HS_NEIGHBOURS"}},
      {"screen/fullscreen.vert", "width/width_coverage.frag",
       joined({kDepth, {"HS_SAMPLES_S", "HS_SAMPLES_T", "HS_LAST_RECEIVERS"}})},
      {"screen/fullscreen.vert", "width/width_seed.frag", {}},
      {"screen/fullscreen.vert", "width/width_flood.frag", {}},
      {"screen/fullscreen.vert", "width/width_box.frag", {}},
      {"screen/fullscreen.vert", "width/width_tile.frag", {}},
      {"screen/fullscreen.vert", "width/width_finish.frag", {}},
      {"volume/volume.vert", "volume/volume.frag", {}},
      {"screen/fullscreen.vert", "volume/volume.frag", {}},
      {"screen/receiver_depth.vert", "screen/receiver_depth.frag", {"HS_FACETS", "HS_FACET_NORMAL"}},
      {"wedge/wedge_volume.vert", "wedge/wedge_piece.frag", {"HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"}},
      {"wedge/wedge_receiver.vert",
       "wedge/wedge_receiver.frag",
       {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_EXACT", "HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"}},
      {"screen/fullscreen.vert", "wedge/wedge_merge.frag", {}},
      {"list/caster_volume.vert",
       "list/caster_cells.frag",
       {"HS_CELLS", "HS_UPPER_CELLS", "HS_CASTING_RECEIVER", "HS_USE_FETCH"}},
      {"list/caster_volume.vert",
       "list/caster_blend.frag",
       {"HS_BLEND", "HS_QUADRANT", "HS_CENTRES", "HS_MERGED", "HS_HALVES", "HS_USE_FETCH",
        "HS_CASTING_RECEIVER"}},
      {"screen/fullscreen.vert", "list/vbuffer_add.frag", {}},
      {"screen/fullscreen.vert", "list/cell_mean.frag", {}},
      receiver("receiver/none.frag", {}),
      receiver("map/hard.frag", {kDepth, kMapReceiver, {"HS_COUNT_SHADOWED"}}),
      receiver("occlusion/occlusion_textures.frag",
               {{"HS_SLOTS", "HS_TEXTURES", "HS_BOXES", "HS_FILTER_NBUFFER", "HS_FILTER_MIPMAP",
                 "HS_FILTER_SAT", "HS_COMBINE_SUM", "HS_COMBINE_PRODUCT", "HS_COMBINE_MAX", "HS_SLICE_DEPTH",
                 "HS_CONCENTRIC", "HS_SAT_SMOOTH", "HS_CASTING_RECEIVER", "HS_LAST_RECEIVERS"}}),
      receiver("map/pcf.frag", {kDepth, kMapReceiver, kKernel}),
      receiver("map/pcf_masked.frag",
               {kDepth, kMapReceiver, kKernel, kTwoDraws, {"HS_MASK_EDGES", "HS_SKIP_LOOP"}}),
      receiver("map/pcf_quantized.frag",
               {kDepth, kMapReceiver, kTwoDraws, {"HS_SPREAD_KERNEL", "HS_SEARCH", "HS_CASTING_RECEIVER"}}),
      receiver("map/pcf_quantized_paper.frag", {kDepth, kMapReceiver, {"HS_SPREAD_KERNEL"}}),
      receiver("map/pcss.frag", {kDepth, kMapReceiver, kTwoDraws, {"HS_SEARCH", "HS_SPREAD_KERNEL"}}),
      receiver("map/pcss_mip.frag",
               {kDepth, kMapReceiver, kTwoDraws, {"HS_SPREAD_KERNEL", "HS_SEARCH", "HS_CASTING_RECEIVER"}}),
      receiver("map/vsm.frag", {kDepth, kMapReceiver, {"HS_MOMENTS_8"}}),
      receiver("width/shadow_width.frag", {kDepth,
                                           kMapReceiver,
                                           {"HS_POINT_LIGHT", "HS_PAPER", "HS_ATTENUATION_TEXTURE",
                                            "HS_CORNERS", "HS_CASTING_RECEIVER"}}),
      receiver("list/wedges_cells.frag", {kMapReceiver,
                                          kTwoDraws,
                                          {"HS_CELLS", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
                                           "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("screen/screen_counts.frag", {}),
      receiver("screen/screen_visibility.frag", {}),
      receiver("list/wedges_blended.frag", {kMapReceiver,
                                            kTwoDraws,
                                            {"HS_CENTRES", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
                                             "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("wedge/screen_wedges.frag",
               {kMapReceiver,
                {"HS_WEDGE_SUMS", "HS_WEDGE_SHARES", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
                 "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("list/screen_cells.frag",
               {kMapReceiver,
                {"HS_CELL_TARGETS", "HS_CELLS", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
                 "HS_AMONG_RECEIVERS", "HS_BEHIND_FACETS"}}),
      receiver("receiver/shade_lights.frag", {}),
  };
}

}  // namespace halfshadow::techniques
