// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "base/keys.hpp"
#include "techniques/occlusion_textures/slice_passes.hpp"
#include "techniques/parts/maps/filter_pass.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::Filter;
using framegraph::Lifetime;
using framegraph::ResourceId;

/// Filtered levels in one texture, as occlusion_filter.glsl computes it from the map's side. Level l holds
/// means over 2^l x 2^l texels, at every texel up to level 3, then at an eighth of the kernel's side: the
/// means of level l vary no faster. (At a quarter, penumbra RMSE is .0016 larger.)
struct LevelLayout {
  static constexpr int kFinestLevels = 3;
  static constexpr int kPad =
      5;  ///< samples outside the map on each side: as far as any level's kernels reach
  int mapSize = 256;
  int stride(int level) const { return 1 << std::max(0, level - kFinestLevels); }
  int side(int level) const { return mapSize / stride(level) + 2 * kPad + 1; }
  /// The four full-size levels in a square, the others in a column to their right.
  Rect rect(int level) const {
    if (level <= kFinestLevels) return {level % 2 * side(0), level / 2 * side(0), side(level), side(level)};
    int y = 0;
    for (int l = kFinestLevels + 1; l < level; ++l) y += side(l);
    return {2 * side(0), y, side(level), side(level)};
  }
  int width() const { return 2 * side(0) + side(kFinestLevels + 1); }
  int height() const { return 2 * side(0); }
};

/// Where a mip level lies in its atlas: as parts/maps lays out the blocker pyramid.
Rect mipRect(int mapSize, int level) {
  const int side = mapSize >> level;
  if (level == 0) return {1, 1, side, side};
  return {mapSize + 3, 1 + mapSize - 2 * side + 2 * (level - 1), side, side};
}

int levelCovering(double texels, int mapSize) {
  int level = 1;
  while ((1 << level) < texels && (1 << level) < 2 * mapSize) ++level;
  return level;
}

/// What a texel with value 1 counts in the sums: as finely as 24 bits hold the whole map's total.
double countOfFullTexel(int mapSize) {
  return std::min(255.0, std::floor(16777215.0 / (static_cast<double>(mapSize) * mapSize)));
}

struct Builder {
  PassPlan& plan;
  const SliceSpace& space;
  std::string prefix;
  std::uint64_t key;

  ResourceId target(const std::string& name, int width, int height, Filter filter) const {
    return plan.addImage({.name = prefix + name,
                          .width = width,
                          .height = height,
                          .lifetime = Lifetime::persistent,
                          .filter = filter});
  }
};

/// Into a part of the target.
PlannedDraw copyDraw(PassPlan& plan, ResourceId source, const Rect& target) {
  return {.program = plan.addProgram({"screen/fullscreen.vert", "map/pyramid_copy.frag", {}}),
          .textures = {{.sampler = "u_source", .resource = source}},
          .viewport = target};
}

ResourceId planMipmaps(const Builder& b, ResourceId source, int lastLevel) {
  const int size = b.space.mapSize;
  const auto atlas = b.target(" mip atlas", size + size / 2 + 4, size + 2 * lastLevel + 2, Filter::linear);
  PlannedPass pass{.name = b.prefix + " mip atlas",
                   .writes = {{.resource = atlas}},
                   .contentKey = combineKeys(b.key, 0x3121u + static_cast<std::uint64_t>(lastLevel))};
  for (int level = 0; level <= lastLevel; ++level)
    pass.draws.push_back(copyDraw(b.plan, source, mipRect(size, level)));
  b.plan.passes.push_back(std::move(pass));
  return atlas;
}

/// Based on: Décoret, "N-buffers for efficient depth map query", 2005 (each level from the one before), with
/// sums instead of maxima: Eisemann, Décoret 2006, section 3.2.
ResourceId planNBuffer(const Builder& b, ResourceId source, int lastLevel) {
  const LevelLayout layout{.mapSize = b.space.mapSize};
  std::vector<ResourceId> levels;
  for (int level = 0; level <= lastLevel; ++level) {
    std::vector<std::string> defines;
    if (level == 0) defines.push_back("HS_FIRST_LEVEL");
    const int side = layout.side(level);
    const std::string name = " level " + std::to_string(level);
    const auto target = b.target(name, side, side, Filter::nearest);
    // Sample i of a level lies at stride (i - pad) (level 0: half a texel further).
    const auto pad = static_cast<float>(LevelLayout::kPad);
    const double stride = layout.stride(level), before = level > 0 ? layout.stride(level - 1) : 1.0;
    const float sourceSide = static_cast<float>(level == 0 ? layout.mapSize : layout.side(level - 1));
    // Target index -> texel coordinate in the source, of the first of the four boxes and the step to the
    // next.
    glm::vec4 place(side, 1.0f, -pad, 0.0f);
    if (level > 0) {
      const double half = 0.5 * (1 << (level - 1));
      const double shift = level == 1 ? -0.5 : 0.0;
      place = {side, stride / before, (-pad * stride - half + shift) / before + pad, 2.0 * half / before};
    }
    device::UniformList uniforms;
    uniforms.set("u_place", place);
    addFilterPass(b.plan, {.name = b.prefix + name,
                           .fragmentFile = "occlusion/occlusion_level.frag",
                           .defines = defines,
                           .source = level == 0 ? source : levels.back(),
                           .target = target,
                           .sourceSize = static_cast<int>(sourceSide),
                           .contentKey = combineKeys(b.key, 0x6b0u + static_cast<std::uint64_t>(level)),
                           .sampler = "u_source",
                           .uniforms = std::move(uniforms)});
    levels.push_back(target);
  }
  const auto atlas = b.target(" N-buffer", layout.width(), layout.height(), Filter::linear);
  PlannedPass pass{.name = b.prefix + " N-buffer",
                   .writes = {{.resource = atlas}},
                   .contentKey = combineKeys(b.key, 0x6bffu + static_cast<std::uint64_t>(lastLevel))};
  for (std::size_t level = 0; level < levels.size(); ++level)
    pass.draws.push_back(copyDraw(b.plan, levels[level], layout.rect(static_cast<int>(level))));
  b.plan.passes.push_back(std::move(pass));
  return atlas;
}

/// Prefix sums along rows, then along columns, four texels at a time (log4 of the side passes each): counts
/// of 24 bits in red, green and blue, the texture's four channels in four tiles.
ResourceId planSummedArea(const Builder& b, ResourceId source) {
  const int size = b.space.mapSize;
  ResourceId current = source;
  for (int direction = 0; direction < 2; ++direction) {
    for (int stride = 1; stride < size; stride *= 4) {
      const bool first = direction == 0 && stride == 1;
      std::vector<std::string> defines;
      if (first) defines.push_back("HS_FIRST_STEP");
      const std::string name = std::string(direction == 0 ? " row" : " column") + " sums of " +
                               std::to_string(std::min(4 * stride, size));
      const auto target = b.target(name, 2 * size, 2 * size, Filter::nearest);
      const glm::vec4 step(direction == 0 ? stride : 0, direction == 1 ? stride : 0, size, 0);
      const glm::vec4 quantum(countOfFullTexel(size), 0, 0, 0);
      device::UniformList uniforms;
      uniforms.set("u_step", step);
      uniforms.set("u_quantum", quantum);
      addFilterPass(b.plan, {.name = b.prefix + name,
                             .fragmentFile = "occlusion/occlusion_sum.frag",
                             .defines = defines,
                             .source = current,
                             .target = target,
                             .sourceSize = first ? size : 2 * size,
                             .contentKey = combineKeys(
                                 b.key, 0x5a70000u + static_cast<std::uint64_t>(direction * 65536 + stride)),
                             .sampler = "u_source",
                             .uniforms = std::move(uniforms)});
      current = target;
    }
  }
  return current;
}
}  // namespace

Result<FilteredSlices> planSliceFilter(const LightScene& scene, PassPlan& plan, const SliceSpace& space,
                                       const SliceTextures& slices, SliceFilter filter) {
  FilteredSlices result;
  const int size = space.mapSize;
  const LevelLayout layout{.mapSize = size};
  int lastLevel = levelCovering(space.widestTexels, size);
  int width = 2 * size, height = 2 * size;
  if (filter == SliceFilter::mipmap) {
    while ((size >> lastLevel) < 2) --lastLevel;
    width = size + size / 2 + 4;
    height = size + 2 * lastLevel + 2;
  } else if (filter == SliceFilter::nbuffer) {
    width = layout.width();
    height = layout.height();
  }
  if (const int limit = scene.capabilities.limits.textureSize; std::max(width, height) > limit) {
    return Error{ErrorCode::invalidArgument, "occlusion-textures.map_size=" + std::to_string(size) +
                                                 " needs a texture of " + std::to_string(width) + "x" +
                                                 std::to_string(height) + ", but this device's limit is " +
                                                 std::to_string(limit) + "; choose a smaller map"};
  }
  result.layout = filter == SliceFilter::summedArea
                      ? glm::vec4(size, 0.5 / size, 256.0 / countOfFullTexel(size), 0)
                      : glm::vec4(size, 1.0 / width, 1.0 / height, lastLevel);
  for (std::size_t i = 0; i < slices.textures.size(); ++i) {
    const Builder builder{plan, space, scene.name + " occlusion " + std::to_string(i + 1),
                          combineKeys(slices.contentKey, i + 1)};
    result.textures.push_back(
        filter == SliceFilter::mipmap    ? planMipmaps(builder, slices.textures[i], lastLevel)
        : filter == SliceFilter::nbuffer ? planNBuffer(builder, slices.textures[i], lastLevel)
                                         : planSummedArea(builder, slices.textures[i]));
  }
  return result;
}

}  // namespace halfshadow::techniques
