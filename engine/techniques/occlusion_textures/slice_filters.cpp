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
/// means of level l vary no faster. (At a quarter, penumbra RMSE is .0016 larger.) Each level of all views'
/// maps is one block.
struct LevelLayout {
  static constexpr int kFinestLevels = 3;
  static constexpr int kPad =
      5;  ///< samples outside the map on each side: as far as any level's kernels reach
  glm::ivec2 mapSize{256};
  glm::ivec2 tiles{1};
  bool tiled = false;
  static int stride(int level) { return 1 << std::max(0, level - kFinestLevels); }
  glm::ivec2 side(int level) const { return (mapSize + stride(level) - 1) / stride(level) + 2 * kPad + 1; }
  /// Of all maps on a level.
  glm::ivec2 block(int level) const { return tiles * side(level); }
  /// The four full-size levels in a square, the others in a column to their right.
  Rect rect(int level) const {
    const glm::ivec2 block0 = block(0), size = block(level);
    if (level <= kFinestLevels) return {level % 2 * block0.x, level / 2 * block0.y, size.x, size.y};
    // Levels of maps of any size may not divide evenly: two samples of room for that.
    const int coarse = level - kFinestLevels, room = 2 * kPad + (tiled ? 3 : 1);
    const int above = mapSize.y - (2 * mapSize.y + stride(level) - 1) / stride(level);
    return {2 * block0.x, tiles.y * (above + room * (coarse - 1)), size.x, size.y};
  }
  int width() const { return 2 * block(0).x + block(kFinestLevels + 1).x; }
  int height(int lastLevel) const {
    const Rect last = rect(lastLevel);
    return std::max(2 * block(0).y, lastLevel > kFinestLevels ? last.y + last.height : 0);
  }
};

/// Mip levels in one atlas: as parts/maps lays out the blocker pyramid; of several views, each map with a
/// margin of one texel.
struct MipLayout {
  glm::ivec2 mapSize{256};
  glm::ivec2 tiles{1};
  bool tiled = false;
  Rect rect(int level) const {
    const glm::ivec2 side = {mapSize.x >> level, mapSize.y >> level};
    if (tiled) {
      const glm::ivec2 block = tiles * (side + 2);
      if (level == 0) return {0, 0, block.x, block.y};
      return {tiles.x * (mapSize.x + 2), tiles.y * (mapSize.y - 2 * side.y + 2 * (level - 1)), block.x,
              block.y};
    }
    if (level == 0) return {1, 1, side.x, side.y};
    return {mapSize.x + 3, 1 + mapSize.y - 2 * side.y + 2 * (level - 1), side.x, side.y};
  }
  int width() const {
    return tiled ? tiles.x * (mapSize.x + mapSize.x / 2 + 4) : mapSize.x + mapSize.x / 2 + 4;
  }
  int height(int lastLevel) const {
    return tiled ? tiles.y * (mapSize.y + 2 * lastLevel) : mapSize.y + 2 * lastLevel + 2;
  }
};

int maxOf(const glm::ivec2& size) {
  return std::max(size.x, size.y);
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

  bool tiled() const { return !space.grid.whole(); }
  /// Of shaders that tell one view's map from the next, and what they need for it.
  void tell(std::vector<std::string>& defines, device::UniformList& uniforms,
            const glm::ivec2& sourceSide) const {
    if (!tiled()) return;
    defines.emplace_back("HS_TILED");
    uniforms.set("u_tiles", glm::vec4(space.tiles, sourceSide));
  }

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
  const MipLayout layout{.mapSize = b.space.mapSize, .tiles = b.space.tiles, .tiled = b.tiled()};
  const auto atlas = b.target(" mip atlas", layout.width(), layout.height(lastLevel), Filter::linear);
  PlannedPass pass{.name = b.prefix + " mip atlas",
                   .writes = {{.resource = atlas}},
                   .contentKey = combineKeys(b.key, 0x3121u + static_cast<std::uint64_t>(lastLevel))};
  for (int level = 0; level <= lastLevel; ++level) {
    PlannedDraw draw = copyDraw(b.plan, source, layout.rect(level));
    if (b.tiled()) {
      draw.program = b.plan.addProgram({"screen/fullscreen.vert", "occlusion/occlusion_mip.frag", {}});
      draw.uniforms.set("u_tiles",
                        glm::vec4(b.space.tiles, b.space.mapSize.x >> level, b.space.mapSize.y >> level));
    }
    pass.draws.push_back(std::move(draw));
  }
  b.plan.passes.push_back(std::move(pass));
  return atlas;
}

/// Based on: Décoret, "N-buffers for efficient depth map query", 2005 (each level from the one before), with
/// sums instead of maxima: Eisemann, Décoret 2006, section 3.2.
ResourceId planNBuffer(const Builder& b, ResourceId source, int lastLevel) {
  const LevelLayout layout{.mapSize = b.space.mapSize, .tiles = b.space.tiles, .tiled = b.tiled()};
  std::vector<ResourceId> levels;
  for (int level = 0; level <= lastLevel; ++level) {
    std::vector<std::string> defines;
    if (level == 0) defines.push_back("HS_FIRST_LEVEL");
    const glm::ivec2 side = layout.block(level);
    const std::string name = " level " + std::to_string(level);
    const auto target = b.target(name, side.x, side.y, Filter::nearest);
    // Sample i of a level lies at stride (i - pad) (level 0: half a texel further).
    const auto pad = static_cast<float>(LevelLayout::kPad);
    const double stride = layout.stride(level), before = level > 0 ? layout.stride(level - 1) : 1.0;
    const glm::ivec2 sourceSide = level == 0 ? layout.mapSize : layout.side(level - 1);
    // Target index -> texel coordinate in the source, of the first of the four boxes and the step to the
    // next.
    glm::vec4 place(side.x, 1.0f, -pad, 0.0f);
    if (level > 0) {
      const double half = 0.5 * (1 << (level - 1));
      const double shift = level == 1 ? -0.5 : 0.0;
      place = {side.x, stride / before, (-pad * stride - half + shift) / before + pad, 2.0 * half / before};
    }
    device::UniformList uniforms;
    uniforms.set("u_place", place);
    b.tell(defines, uniforms, sourceSide);
    const glm::ivec2 sourceSize = level == 0 ? glm::ivec2(b.space.atlasSize) : layout.block(level - 1);
    if (b.tiled()) {
      uniforms.set("u_samples", glm::vec4(layout.side(level), side));
      uniforms.set("u_sourceTexel", 1.0f / glm::vec2(sourceSize));
    }
    addFilterPass(b.plan, {.name = b.prefix + name,
                           .fragmentFile = "occlusion/occlusion_level.frag",
                           .defines = defines,
                           .source = level == 0 ? source : levels.back(),
                           .target = target,
                           .sourceSize = sourceSize.x,
                           .contentKey = combineKeys(b.key, 0x6b0u + static_cast<std::uint64_t>(level)),
                           .sampler = "u_source",
                           .uniforms = std::move(uniforms)});
    levels.push_back(target);
  }
  const auto atlas = b.target(" N-buffer", layout.width(), layout.height(lastLevel), Filter::linear);
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
  const int side = maxOf(b.space.mapSize), size = b.space.atlasSize;
  ResourceId current = source;
  for (int direction = 0; direction < 2; ++direction) {
    for (int stride = 1; stride < side; stride *= 4) {
      const bool first = direction == 0 && stride == 1;
      std::vector<std::string> defines;
      if (first) defines.push_back("HS_FIRST_STEP");
      const std::string name = std::string(direction == 0 ? " row" : " column") + " sums of " +
                               std::to_string(std::min(4 * stride, side));
      const auto target = b.target(name, 2 * size, 2 * size, Filter::nearest);
      const glm::vec4 step(direction == 0 ? stride : 0, direction == 1 ? stride : 0, size, 0);
      const glm::vec4 quantum(countOfFullTexel(side), 0, 0, 0);
      device::UniformList uniforms;
      uniforms.set("u_step", step);
      uniforms.set("u_quantum", quantum);
      b.tell(defines, uniforms, b.space.mapSize);
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

struct FilterSize {
  int lastLevel = 0;
  int width = 0, height = 0;
};

FilterSize sizeOf(const SliceSpace& space, SliceFilter filter) {
  const bool tiled = !space.grid.whole();
  FilterSize size{.lastLevel = levelCovering(space.widestTexels, maxOf(space.mapSize)),
                  .width = 2 * space.atlasSize,
                  .height = 2 * space.atlasSize};
  if (filter == SliceFilter::mipmap) {
    while ((std::min(space.mapSize.x, space.mapSize.y) >> size.lastLevel) < 2) --size.lastLevel;
    const MipLayout layout{.mapSize = space.mapSize, .tiles = space.tiles, .tiled = tiled};
    size.width = layout.width();
    size.height = layout.height(size.lastLevel);
  } else if (filter == SliceFilter::nbuffer) {
    const LevelLayout layout{.mapSize = space.mapSize, .tiles = space.tiles, .tiled = tiled};
    size.width = layout.width();
    size.height = layout.height(size.lastLevel);
  }
  return size;
}
}  // namespace

glm::ivec2 filteredSize(const SliceSpace& space, SliceFilter filter) {
  const FilterSize size = sizeOf(space, filter);
  return {size.width, size.height};
}

Result<FilteredSlices> planSliceFilter(const LightScene& scene, PassPlan& plan, const SliceSpace& space,
                                       const SliceTextures& slices, SliceFilter filter) {
  FilteredSlices result;
  const auto [lastLevel, width, height] = sizeOf(space, filter);
  if (const int limit = scene.capabilities.limits.textureSize; std::max(width, height) > limit) {
    return Error{ErrorCode::invalidArgument,
                 "occlusion-textures.map_size=" + std::to_string(space.atlasSize) + " needs a texture of " +
                     std::to_string(width) + "x" + std::to_string(height) + ", but this device's limit is " +
                     std::to_string(limit) + "; choose a smaller map"};
  }
  result.layout = filter == SliceFilter::summedArea
                      ? glm::vec4(space.atlasSize, 0.5 / space.atlasSize,
                                  256.0 / countOfFullTexel(maxOf(space.mapSize)), 0)
                      : glm::vec4(space.atlasSize, 1.0 / width, 1.0 / height, lastLevel);
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
