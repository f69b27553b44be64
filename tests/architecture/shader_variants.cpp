// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "shader_variants.hpp"

#include <span>

#include "techniques/parts/maps/poisson_disc.hpp"

namespace halfshadow::architecture {
namespace {

using Depth = ShaderFamily::Depth;
using Kind = ShaderFamily::Kind;

/// Kernels of pcf and pcf-masked: smallest, odd, largest; the disc, turned and not.
std::vector<Defines> kernels(const Defines& with) {
  std::vector<Defines> sets;
  for (const char* size : {"2", "7", "17"}) sets.push_back({std::string("HS_KERNEL ") + size});
  const Defines disc = {"HS_POISSON_COUNT 16", techniques::poissonTapsDefine(16)};
  sets.push_back(disc);
  sets.push_back(disc);
  sets.back().push_back("HS_ROTATE");
  for (Defines& set : sets) set.insert(set.end(), with.begin(), with.end());
  return sets;
}

std::vector<Defines> joined(std::initializer_list<std::vector<Defines>> lists) {
  std::vector<Defines> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// Both presets with each prefilter; the most slices; elongated lights.
std::vector<Defines> occlusionSets() {
  std::vector<Defines> sets;
  for (const char* filter : {"HS_FILTER_NBUFFER", "HS_FILTER_MIPMAP", "HS_FILTER_SAT"}) {
    sets.push_back({"HS_SLOTS 4", "HS_TEXTURES 2", "HS_BOXES 1", filter, "HS_COMBINE_SUM", "HS_SLICE_DEPTH",
                    "HS_CONCENTRIC"});
    sets.push_back({"HS_SLOTS 16", "HS_TEXTURES 4", "HS_BOXES 1", filter, "HS_COMBINE_PRODUCT"});
  }
  sets.push_back({"HS_SLOTS 4", "HS_TEXTURES 2", "HS_BOXES 1", "HS_FILTER_SAT", "HS_COMBINE_SUM",
                  "HS_SLICE_DEPTH", "HS_SAT_SMOOTH"});
  sets.push_back({"HS_SLOTS 4", "HS_TEXTURES 2", "HS_BOXES 1", "HS_FILTER_NBUFFER", "HS_COMBINE_SUM",
                  "HS_SLICE_DEPTH", "HS_CONCENTRIC", "HS_CASTING_RECEIVER", "HS_LAST_RECEIVERS"});
  sets.push_back({"HS_SLOTS 14", "HS_TEXTURES 7", "HS_BOXES 8", "HS_FILTER_NBUFFER", "HS_COMBINE_MAX",
                  "HS_SLICE_DEPTH"});
  return sets;
}

std::vector<Defines> searches(const std::string& macro) {
  std::vector<Defines> sets;
  for (const char* size : {"2", "9"}) {
    sets.push_back({"HS_SPREAD_KERNEL " + std::string(size)});
    if (!macro.empty()) sets.back().push_back(macro + " " + size);
  }
  return sets;
}

}  // namespace

const std::vector<ShaderFamily>& shaderFamilies() {
  static const std::vector<ShaderFamily> families = {
      {"map/light_depth.vert", "map/light_depth.frag", Depth::perStorage},
      {"screen/fullscreen.vert",
       "map/block_bounds.frag",
       Depth::perStorage,
       Kind::pass,
       {{"HS_FACTOR 2"},
        {"HS_FACTOR 4"},
        {"HS_FACTOR 8"},
        {"HS_FACTOR 2", "HS_FROM_DEPTH"},
        {"HS_FACTOR 4", "HS_FROM_DEPTH"},
        {"HS_FACTOR 8", "HS_FROM_DEPTH"}}},
      {"screen/fullscreen.vert",
       "map/block_dilate.frag",
       Depth::independent,
       Kind::pass,
       {{"HS_REACH_S 1", "HS_REACH_T 1", "HS_CELL 1"},
        {"HS_REACH_S 4", "HS_REACH_T 4", "HS_CELL 1"},
        {"HS_REACH_S 4", "HS_REACH_T 0", "HS_CELL 8"},
        {"HS_REACH_S 0", "HS_REACH_T 4", "HS_CELL 1"}}},
      {"screen/fullscreen.vert",
       "map/edge_mask.frag",
       Depth::perStorage,
       Kind::pass,
       {{}, {"HS_LAPLACIAN9"}}},
      {"screen/fullscreen.vert", "map/edge_dilate.frag"},
      {"screen/fullscreen.vert", "map/occupancy.frag", Depth::perStorage},
      {"screen/fullscreen.vert",
       "map/occupancy_level.frag",
       Depth::independent,
       Kind::pass,
       {{"HS_CELL 1"}, {"HS_CELL 8"}}},
      {"screen/fullscreen.vert", "map/pyramid_copy.frag"},
      {"screen/fullscreen.vert",
       "map/vsm_moments.frag",
       Depth::perStorage,
       Kind::pass,
       {{}, {"HS_MOMENTS_8"}}},
      {"screen/fullscreen.vert",
       "map/vsm_blur.frag",
       Depth::independent,
       Kind::pass,
       {{"HS_KERNEL 3"}, {"HS_KERNEL 9"}, {"HS_KERNEL 3", "HS_MOMENTS_8"}}},
      {"occlusion/occlusion_slices.vert",
       "occlusion/occlusion_slices.frag",
       Depth::independent,
       Kind::pass,
       {{}, {"HS_SLICE_DEPTH"}, {"HS_SLICE_DEPTH", "HS_LAST_RECEIVERS"}, {"HS_PACK_DEPTH"}}},
      {"screen/fullscreen.vert",
       "occlusion/occlusion_level.frag",
       Depth::independent,
       Kind::pass,
       {{}, {"HS_FIRST_LEVEL"}}},
      {"screen/fullscreen.vert",
       "occlusion/occlusion_sum.frag",
       Depth::independent,
       Kind::pass,
       {{}, {"HS_FIRST_STEP"}}},
      {"receiver/receiver.vert", "occlusion/occlusion_textures.frag", Depth::independent, Kind::receiver,
       occlusionSets()},
      {"screen/fullscreen.vert",
       "width/width_occlusion.frag",
       Depth::perStorage,
       Kind::pass,
       {{}, {"HS_FARTHEST"}}},
      {"screen/fullscreen.vert",
       "width/width_minimum.frag",
       Depth::independent,
       Kind::pass,
       {{"HS_NEIGHBOURS 3"}, {"HS_NEIGHBOURS 6"}}},
      {"screen/fullscreen.vert",
       "width/width_coverage.frag",
       Depth::perStorage,
       Kind::pass,
       {{"HS_SAMPLES_S 1", "HS_SAMPLES_T 1"},
        {"HS_SAMPLES_S 16", "HS_SAMPLES_T 1"},
        {"HS_SAMPLES_S 4", "HS_SAMPLES_T 4", "HS_LAST_RECEIVERS"}}},
      {"screen/fullscreen.vert", "width/width_seed.frag"},
      {"screen/fullscreen.vert", "width/width_flood.frag"},
      {"screen/fullscreen.vert", "width/width_box.frag"},
      {"screen/fullscreen.vert", "width/width_tile.frag"},
      {"screen/fullscreen.vert", "width/width_finish.frag"},
      {"screen/receiver_depth.vert",
       "screen/receiver_depth.frag",
       Depth::independent,
       Kind::pass,
       {{}, {"HS_FACET_NORMAL"}, {"HS_FACETS", "HS_FACET_NORMAL"}}},
      {"wedge/wedge_volume.vert",
       "wedge/wedge_piece.frag",
       Depth::independent,
       Kind::pass,
       {{}, {"HS_WEDGE_CLIP"}, {"HS_WEDGE_MULTIPLY"}, {"HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"}}},
      {"wedge/wedge_receiver.vert",
       "wedge/wedge_receiver.frag",
       Depth::independent,
       Kind::pass,
       {{},
        {"HS_WEDGE_CLIP"},
        {"HS_WEDGE_MULTIPLY"},
        {"HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"},
        {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_EXACT"},
        {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_EXACT", "HS_WEDGE_CLIP"},
        {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_EXACT", "HS_WEDGE_MULTIPLY"},
        {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_EXACT", "HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"},
        {"HS_WEDGE_FOOTPRINT"},
        {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_CLIP"},
        {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_MULTIPLY"},
        {"HS_WEDGE_FOOTPRINT", "HS_WEDGE_MULTIPLY", "HS_WEDGE_CLIP"}}},
      {"screen/fullscreen.vert", "wedge/wedge_merge.frag"},
      {"list/caster_volume.vert",
       "list/caster_cells.frag",
       Depth::independent,
       Kind::pass,
       {{"HS_CELLS 16"},
        {"HS_CELLS 16", "HS_CASTING_RECEIVER"},
        {"HS_CELLS 4", "HS_CASTING_RECEIVER", "HS_USE_FETCH"},
        {"HS_CELLS 32", "HS_UPPER_CELLS", "HS_USE_FETCH"},
        {"HS_CELLS 32", "HS_CASTING_RECEIVER"}}},
      {"receiver/receiver.vert",
       "list/screen_cells.frag",
       Depth::independent,
       Kind::receiver,
       {{"HS_CELL_TARGETS 1", "HS_CELLS 4"},
        {"HS_CELL_TARGETS 4", "HS_CELLS 16"},
        {"HS_CELL_TARGETS 1", "HS_CELLS 32"},
        {"HS_CELL_TARGETS 4", "HS_CELLS 16", "HS_CASTING_RECEIVER", "HS_LISTS", "HS_BEHIND_FACETS"},
        {"HS_CELL_TARGETS 4", "HS_CELLS 16", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS",
         "HS_BEHIND_FACETS"}}},
      {"receiver/receiver.vert",
       "wedge/screen_wedges.frag",
       Depth::independent,
       Kind::receiver,
       {{"HS_WEDGE_SUMS"},
        {"HS_WEDGE_SHARES"},
        {},
        {"HS_WEDGE_SUMS", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS", "HS_BEHIND_FACETS"},
        {"HS_CASTING_RECEIVER", "HS_LISTS"}}},
      {"list/caster_volume.vert",
       "list/caster_blend.frag",
       Depth::independent,
       Kind::pass,
       {{"HS_BLEND 0", "HS_CENTRES", "HS_HALVES"},
        {"HS_BLEND 0", "HS_CASTING_RECEIVER"},
        {"HS_BLEND 1", "HS_CASTING_RECEIVER"},
        {"HS_BLEND 1", "HS_MERGED"},
        {"HS_BLEND 2", "HS_QUADRANT 0", "HS_CASTING_RECEIVER"},
        {"HS_BLEND 2", "HS_QUADRANT 1", "HS_MERGED"},
        {"HS_BLEND 2", "HS_QUADRANT 2", "HS_USE_FETCH"},
        {"HS_BLEND 2", "HS_QUADRANT 3"},
        {"HS_BLEND 3", "HS_CENTRES", "HS_CASTING_RECEIVER"},
        {"HS_BLEND 4", "HS_CENTRES", "HS_MERGED", "HS_USE_FETCH"},
        {"HS_BLEND 3", "HS_CENTRES", "HS_MERGED", "HS_HALVES"}}},
      {"screen/fullscreen.vert", "list/vbuffer_add.frag"},
      {"screen/fullscreen.vert", "list/cell_mean.frag"},
      {"receiver/receiver.vert", "receiver/none.frag", Depth::independent, Kind::receiver},
      {"receiver/receiver.vert",
       "map/hard.frag",
       Depth::perStorage,
       Kind::receiver,
       {{}, {"HS_COUNT_SHADOWED"}, {"HS_LIT_OUTSIDE"}}},
      {"volume/volume.vert", "volume/volume.frag"},
      {"screen/fullscreen.vert", "volume/volume.frag"},
      {"receiver/receiver.vert",
       "list/wedges_blended.frag",
       Depth::independent,
       Kind::receiver,
       {{"HS_CENTRES", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS", "HS_BEHIND_FACETS"},
        {"HS_CENTRES", "HS_CASTING_RECEIVER", "HS_LISTS"},
        {"HS_CASTING_RECEIVER", "HS_LISTS", "HS_BEHIND_FACETS"},
        {"HS_CENTRES", "HS_LISTS", "HS_AMONG_RECEIVERS"},
        {"HS_LISTS"}},
       true},
      {"receiver/receiver.vert",
       "list/wedges_cells.frag",
       Depth::independent,
       Kind::receiver,
       {{"HS_CELLS 16", "HS_CASTING_RECEIVER", "HS_ONE_SIDED", "HS_LISTS", "HS_BEHIND_FACETS"},
        {"HS_CELLS 16", "HS_CASTING_RECEIVER", "HS_LISTS"},
        {"HS_CELLS 16", "HS_LISTS", "HS_AMONG_RECEIVERS"},
        {"HS_CELLS 16", "HS_LISTS"},
        {"HS_CELLS 4", "HS_LISTS"},
        {"HS_CELLS 32", "HS_LISTS"}},
       true},
      {"receiver/receiver.vert", "screen/screen_counts.frag", Depth::independent, Kind::receiver},
      {"receiver/receiver.vert", "screen/screen_visibility.frag", Depth::independent, Kind::receiver},
      {"receiver/receiver.vert",
       "receiver/shade_lights.frag",
       Depth::independent,
       Kind::pass,
       {{"HS_SHADED"}, {"HS_SHADED", "HS_BASE_COLOR_TEXTURE"}}},
      {"receiver/receiver.vert", "map/pcf.frag", Depth::perStorage, Kind::receiver, kernels({})},
      {"receiver/receiver.vert", "map/pcf_masked.frag", Depth::perStorage, Kind::receiver,
       joined({kernels({}), kernels({"HS_MASK_EDGES"}), {{"HS_KERNEL 4", "HS_SKIP_LOOP"}}}), true},
      {"receiver/receiver.vert",
       "map/pcf_quantized.frag",
       Depth::perStorage,
       Kind::receiver,
       {{"HS_SPREAD_KERNEL 5"},
        {"HS_SPREAD_KERNEL 7"},
        {"HS_SPREAD_KERNEL 7", "HS_SEARCH 5", "HS_CASTING_RECEIVER"}},
       true},
      {"receiver/receiver.vert",
       "map/pcf_quantized_paper.frag",
       Depth::perStorage,
       Kind::receiver,
       {{"HS_SPREAD_KERNEL 5"}, {"HS_SPREAD_KERNEL 7"}}},
      {"receiver/receiver.vert", "map/pcss.frag", Depth::perStorage, Kind::receiver, searches("HS_SEARCH"),
       true},
      {"receiver/receiver.vert", "map/pcss_mip.frag", Depth::perStorage, Kind::receiver,
       joined({searches(""), {{"HS_SPREAD_KERNEL 6", "HS_SEARCH 5", "HS_CASTING_RECEIVER"}}}), true},
      {"receiver/receiver.vert",
       "width/shadow_width.frag",
       Depth::perStorage,
       Kind::receiver,
       {{"HS_CORNERS"},
        {"HS_CORNERS", "HS_CASTING_RECEIVER"},
        {},
        {"HS_POINT_LIGHT"},
        {"HS_PAPER"},
        {"HS_PAPER", "HS_ATTENUATION_TEXTURE"}}},
      {"receiver/receiver.vert", "map/vsm.frag", Depth::perStorage, Kind::receiver, {{}, {"HS_MOMENTS_8"}}},
  };
  return families;
}

std::vector<ShaderVariant> shaderVariants() {
  struct Rung {
    Defines defines;
    bool highp;
  };
  const std::vector<Rung> kDepthRungs = {
      {{}, true}, {{"HS_DEPTH_PACKED24"}, true}, {{"HS_DEPTH_PACKED16"}, false}};
  const std::vector<Rung> kPlainRungs = {{{}, true}, {{}, false}};
  const std::vector<Defines> kOutputs = {{},
                                         {"HS_VISIBILITY_16"},
                                         {"HS_COUNT_TAPS"},
                                         {"HS_SHADED"},
                                         {"HS_SHADED", "HS_BASE_COLOR_TEXTURE"},
                                         {"HS_FORWARD"}};

  std::vector<ShaderVariant> variants;
  const auto add = [&](const ShaderFamily& family, const Rung& rung, std::initializer_list<Defines> parts,
                       bool derivatives) {
    ShaderVariant variant{family.vertexFile, family.fragmentFile, rung.defines, rung.highp, derivatives};
    // Hosts put these two in front of their own main().
    for (const Defines& part : parts) {
      if (part == Defines{"HS_FORWARD"}) variant.vertexFile = "receiver/forward.vert";
    }
    for (const Defines& part : parts) variant.defines.insert(variant.defines.end(), part.begin(), part.end());
    variants.push_back(std::move(variant));
  };
  for (const ShaderFamily& family : shaderFamilies()) {
    for (const Rung& rung : family.depth == Depth::perStorage ? kDepthRungs : kPlainRungs) {
      for (const Defines& set : family.defineSets) {
        if (family.kind == Kind::pass) {
          add(family, rung, {set}, true);
          continue;
        }
        // Without highp, or without derivatives, the facet's plane comes as a vertex attribute.
        const std::vector<bool> kFacets =
            rung.highp ? std::vector<bool>{false, true} : std::vector<bool>{true};
        for (const bool facet : kFacets) {
          const Defines plane = facet ? Defines{"HS_FACET_NORMAL"} : Defines{};
          // The output does not change the kernel: all outputs with the first define set, one with the
          // others.
          const std::size_t outputs = &set == &family.defineSets.front() ? kOutputs.size() : 1;
          for (const Defines& output : std::span(kOutputs).first(outputs)) {
            add(family, rung, {set, plane, output}, !facet);
            if (!family.twoDraws || output == Defines{"HS_COUNT_TAPS"} || output == Defines{"HS_FORWARD"})
              continue;
            for (const char* phase : {"HS_PHASE_CLASSIFY", "HS_PHASE_FILTER"}) {
              add(family, rung, {set, plane, output, {phase}}, !facet);
            }
          }
        }
      }
    }
  }
  return variants;
}

}  // namespace halfshadow::architecture
