// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Passes that make occlusion textures: slicing the casters, and the three prefilters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "techniques/core/pass_plan.hpp"
#include "techniques/occlusion_textures/slice_space.hpp"

namespace halfshadow::techniques {

enum class SliceContent {
  everything,   ///< all casters of a slice, binary, four slices a texture
  nearestFaces  ///< what the centre of projection sees: share and share times depth, two slices a texture
};
enum class SliceFilter { mipmap, nbuffer, summedArea };

/// Occlusion textures before filtering, mapSize² texels for each view.
struct SliceTextures {
  std::vector<framegraph::ResourceId> textures;
  int slicesPerTexture = 4;
  /// Depth of the last receivers, packed in three bytes, 1 = space.depthSlices; where casters are among them.
  std::optional<framegraph::ResourceId> lastReceivers;
  std::uint64_t contentKey = 0;
};
/// One geometry pass per texture; nearest faces are rasterised twice as fine and averaged.
SliceTextures planSlices(const LightScene& scene, PassPlan& plan, const SliceSpace& space,
                         SliceContent content, SliceFilter filter);

/// Width and height in texels of the largest texture that a filter of these slices takes.
glm::ivec2 filteredSize(const SliceSpace& space, SliceFilter filter);

/// Filtered textures, one for each of the slices', and the layout uniform of occlusion_filter.glsl.
struct FilteredSlices {
  std::vector<framegraph::ResourceId> textures;
  glm::vec4 layout{0.0f};
};
/// N-buffers and mipmaps get the levels that kernels of `space.widestTexels` need; all filters take kernels
/// of any size. Errors: invalidArgument (a texture would be larger than the device allows).
Result<FilteredSlices> planSliceFilter(const LightScene& scene, PassPlan& plan, const SliceSpace& space,
                                       const SliceTextures& slices, SliceFilter filter);

}  // namespace halfshadow::techniques
