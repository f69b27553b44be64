// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_width/signed_width.hpp"

#include <algorithm>
#include <cmath>

#include "base/keys.hpp"
#include "techniques/parts/maps/last_receivers.hpp"

namespace halfshadow::techniques {
namespace {
/// Offsets are stored as whole bytes about 128.
constexpr double kLongestOffset = 125.0;
/// Tiles of the box atlas: the largest boxes are as wide as kernels that reach the longest offset.
constexpr int kMostTiles = 7;
/// Of distances in single precision: casters that are flat against the light have no range.
constexpr double kRounding = 1e-7;
/// Beyond this the map would be some texels; penumbrae are cut.
constexpr double kLargestShrink = 16.0;
/// Longer over shorter side of a kernel in texels that are shaped like the light as far as they go.
constexpr double kLongestKernel = 2.5;
/// Texels of the widest kernel of a sub-light below which its map is made finer, up to twice.
constexpr double kSubLightKernel = 8.0;

glm::vec4 layoutUniform(const SignedWidthMap& map) {
  const glm::dvec2 image = glm::dvec2(map.width, map.height) * static_cast<double>(map.tilesPerSide);
  return {image, 1.0 / image};
}

glm::vec4 tileUniform(const SignedWidthMap& map) {
  return {map.width, map.height, 1.0 / map.width, 1.0 / map.height};
}

glm::vec4 placeUniform(const SignedWidthMap& map) {
  return {1.0 / map.depthTexelsPerTexel.x, 1.0 / map.depthTexelsPerTexel.y, map.margin, 0.0};
}

glm::vec4 boxUniform(const SignedWidthMap& map) {
  const int rows = (map.boxes.tiles + 1) / 2;
  const double maps = map.tilesPerSide;
  return {0.5 / (maps * map.width), 1.0 / (rows * maps * map.height), map.boxes.tiles, 0};
}

/// What the depth map's space is of: the light from its centre, or what its sub-lights share.
const planner::LightFit& sharedFit(const LightScene& scene) {
  return scene.subLights == nullptr ? scene.fit() : scene.subLights->shared;
}

/// The space of one map: with the kernel of what it is seen from.
MapSpace spaceOfOne(const LightDepth& depth) {
  MapSpace space = depth.space;
  if (depth.subLights == nullptr) return space;
  const planner::SubLights& split = *depth.subLights;
  const glm::dvec2 share = split.halfSize / glm::max(split.shared.halfSize, glm::dvec2(1e-300));
  space.kernelTexelsPerDepth = glm::max(space.kernelTexelsPerDepth * share, glm::dvec2(1.0));
  return space;
}

/// What 0 … 1 of the map stands for: distances of casters, less the near distance and in units of it; of a
/// split light depths, with which widths fall evenly.
struct CasterRange {
  double nearest = 0.0, range = 1.0;
};
CasterRange casterRange(const LightScene& scene, const MapSpace& space) {
  const planner::LightFit& fit = sharedFit(scene);
  if (scene.subLights != nullptr) {
    const double nearest = 1.0 - fit.nearDistance / fit.nearestCaster;
    const double farthest = 1.0 - fit.nearDistance / fit.farthestCaster;
    return {nearest * space.depthUnit, std::max(farthest - nearest, kRounding) * space.depthUnit};
  }
  const double rounding = kRounding * fit.farthestCaster / fit.nearDistance;
  return {fit.nearestCaster / fit.nearDistance - 1.0,
          std::max((fit.farthestCaster - fit.nearestCaster) / fit.nearDistance, rounding)};
}

/// The same for coverage, the depth between casters and empty texels, and the depth of a whole range.
glm::vec4 casterRangeUniform(const LightScene& scene, const MapSpace& space) {
  const CasterRange casters = casterRange(scene, space);
  return {casters.nearest, 1.0 / casters.range, 0.5 * (space.farthestCasterDepth + 1.0) * space.depthUnit,
          1.0 / space.depthUnit};
}

/// The light's side in texels of the width map per unit of depth difference. A strip of a light is as wide as
/// squares of the map can tell from a line: its narrow penumbrae are then a few texels of the depth map.
glm::dvec2 kernelPerDepth(const MapSpace& space, const glm::dvec2& depthTexelsPerTexel) {
  const glm::dvec2 kernel = space.kernelTexelsPerDepth / depthTexelsPerTexel;
  return glm::max(kernel, std::max(kernel.x, kernel.y) / kLongestKernel);
}

/// The widest kernel of a receiver inside the map, in texels of the width map, for casters at a depth.
glm::dvec2 widestKernel(const LightScene& scene, const MapSpace& space, const SignedWidthMap& map,
                        double casterDepth) {
  const double farthest =
      1.0 - space.nearDistance / std::max(scene.receiverFarDistance, sharedFit(scene).farthestCaster);
  return kernelPerDepth(space, map.depthTexelsPerTexel) * (farthest - casterDepth);
}
glm::dvec2 widestKernel(const LightScene& scene, const MapSpace& space, const SignedWidthMap& map) {
  return widestKernel(scene, space, map, 1.0 - space.nearDistance / sharedFit(scene).nearestCaster);
}

/// A square kernel's side, see edge_profile.glsl.
glm::vec4 kernelUniform(const LightScene& scene, const MapSpace& space, const SignedWidthMap& map) {
  const glm::dvec2 perDepth = kernelPerDepth(space, map.depthTexelsPerTexel) / space.depthUnit;
  const double side = std::sqrt(perDepth.x * perDepth.y);
  const glm::dvec2 widest = widestKernel(scene, space, map);
  return {side, side * casterRange(scene, space).range, std::sqrt(widest.x * widest.y),
          map.corners == WidthCorners::stored ? 1.0 : 0.0};
}

/// Boxes up to the widest penumbra.
int boxTiles(const LightScene& scene, const MapSpace& space, const SignedWidthMap& map) {
  const glm::dvec2 kernel = widestKernel(scene, space, map);
  const double widest = std::sqrt(kernel.x * kernel.y);
  int tiles = 1;
  while (tiles < kMostTiles && (2 << tiles) < widest) ++tiles;
  return tiles;
}

std::uint64_t shapeKey(const SignedWidthMap& map) {
  const std::uint64_t sides =
      static_cast<std::uint64_t>(map.width) * 65536 + static_cast<std::uint64_t>(map.height);
  return combineKeys(sides, static_cast<std::uint64_t>(map.reachTexels));
}

struct Step {
  const char* name;
  const char* file;
  std::vector<std::string> defines;
  std::vector<TextureRead> sources;
  framegraph::ResourceId target;
  int strideTexels = 0;
  double boxTexels = 0.0;
  std::uint64_t contentKey = 0;
};

void addStep(const LightScene& scene, PassPlan& plan, const LightDepth& depth, const SignedWidthMap& map,
             Step step) {
  if (map.tilesPerSide > 1) step.defines.emplace_back("HS_TILES");
  PlannedPass pass{.name = scene.name + " " + step.name, .contentKey = step.contentKey};
  if (step.strideTexels > 0) pass.name += " " + std::to_string(step.strideTexels);
  pass.writes = {{.resource = step.target, .initial = framegraph::InitialContent::dontCare}};
  PlannedDraw draw{.program = plan.addProgram({"screen/fullscreen.vert", step.file, std::move(step.defines)}),
                   .textures = std::move(step.sources)};
  draw.uniforms.set("u_sourceSize", glm::vec4(depth.space.mapSize, 1.0 / depth.atlasSize, 0, 0));
  draw.uniforms.set("u_widthLayout", layoutUniform(map));
  if (map.tilesPerSide > 1) draw.uniforms.set("u_widthTile", tileUniform(map));
  draw.uniforms.set("u_widthPlace", placeUniform(map));
  draw.uniforms.set("u_casterRange", casterRangeUniform(scene, depth.space));
  draw.uniforms.set("u_flood", glm::vec4(step.strideTexels, 0, 0, 0));
  draw.uniforms.set("u_box", glm::vec4(step.boxTexels, 0, 0, 0));
  draw.uniforms.set("u_boxLayout", boxUniform(map));
  draw.uniforms.set("u_widthRange", glm::vec4(map.reachTexels, map.kneeTexels, 0, 0));
  draw.uniforms.set("u_kernel", kernelUniform(scene, spaceOfOne(depth), map));
  draw.uniforms.set("u_lastMargin", glm::vec4(2.0 * depth.space.quantum * depth.space.depthUnit, 0, 0, 0));
  pass.draws.push_back(std::move(draw));
  plan.passes.push_back(std::move(pass));
}
}  // namespace

glm::dvec2 depthTexelsPerWidthTexel(const MapSpace& space) {
  // At most four a side, which resolves edges to a fraction of a texel by coverage and keeps the passes
  // cheap, unless the shorter side would then be finer than the depth map itself.
  const double longest = space.mapSize >= 256 ? 4.0 : space.mapSize >= 128 ? 2.0 : 1.0;
  const glm::dvec2 kernel = glm::max(space.kernelTexelsPerDepth, glm::dvec2(1e-9));
  const double ratio = std::clamp(kernel.x / kernel.y, 1.0 / 16.0, 16.0);
  const glm::dvec2 shape = ratio > 1.0 ? glm::dvec2(1.0, 1.0 / ratio) : glm::dvec2(ratio, 1.0);
  return shape * std::max(longest, 1.0 / std::min(shape.x, shape.y));
}

static WidthBoxes planWidthBoxes(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                                 const SignedWidthMap& map) {
  const std::string prefix = scene.name + " width ";
  WidthBoxes boxes{.tiles = boxTiles(scene, spaceOfOne(depth), map)};
  const int rows = (boxes.tiles + 1) / 2;
  const int width = map.tilesPerSide * map.width, height = map.tilesPerSide * map.height;
  std::vector<framegraph::ResourceId> levels = {map.coverage};
  for (int level = 0; level <= boxes.tiles; ++level) {
    const auto next = plan.addImage(
        {.name = prefix + "boxes " + std::to_string(2 << level), .width = width, .height = height});
    // To and fro, so that no level's boxes stand far beside their texels.
    const double neighbour = (level % 2 == 0 ? 1.0 : -1.0) * std::exp2(level);
    addStep(scene, plan, depth, map,
            {.name = "width boxes",
             .file = "width/width_box.frag",
             .sources = {{"u_coverage", levels.back()}},
             .target = next,
             .strideTexels = 2 << level,
             .boxTexels = neighbour});
    levels.push_back(next);
  }
  boxes.atlas = plan.addImage({.name = prefix + "box atlas",
                               .width = 2 * width,
                               .height = rows * height,
                               .lifetime = framegraph::Lifetime::persistent,
                               .filter = framegraph::Filter::linear});
  PlannedPass pass{
      .name = prefix + "box atlas",
      .writes = {{.resource = boxes.atlas}},
      .contentKey = combineKeys(depth.contentKey, shapeKey(map) + static_cast<std::uint64_t>(boxes.tiles))};
  for (int tile = 0; tile < boxes.tiles; ++tile) {
    const std::size_t level = static_cast<std::size_t>(tile) + 1;
    const float between =
        static_cast<float>((level % 2 == 0 ? -1.0 : 1.0) * std::exp2(static_cast<double>(level) - 1.0));
    PlannedDraw draw{.program = plan.addProgram({"screen/fullscreen.vert", "width/width_tile.frag", {}}),
                     .textures = {{.sampler = "u_smallerBoxes", .resource = levels[level]},
                                  {.sampler = "u_largerBoxes", .resource = levels[level + 1]}},
                     .viewport = Rect{(tile % 2) * width, (tile / 2) * height, width, height}};
    draw.uniforms.set("u_widthLayout", layoutUniform(map));
    draw.uniforms.set("u_box", glm::vec4(between, 0, 0, 0));
    pass.draws.push_back(std::move(draw));
  }
  plan.passes.push_back(std::move(pass));
  return boxes;
}

SignedWidthMap planSignedWidth(const LightScene& scene, PassPlan& plan, const LightDepth& casters,
                               WidthCorners corners) {
  LightDepth depth = casters;
  const MapSpace space = spaceOfOne(depth);
  SignedWidthMap map;
  map.tilesPerSide = depth.tilesPerSide();
  map.corners = corners;
  map.depthTexelsPerTexel = depthTexelsPerWidthTexel(space);
  if (depth.subLights != nullptr) {
    const glm::dvec2 coarse = widestKernel(scene, space, map);
    map.depthTexelsPerTexel *= std::clamp(std::sqrt(coarse.x * coarse.y) / kSubLightKernel, 0.5, 1.0);
  }
  // Distances reach kLongestOffset texels: the widest kernel should fit. Where a caster stands next to the
  // light that would cost all others their resolution, so its penumbra is cut, but for lights so large that
  // casters half-way to the farthest have such penumbrae too.
  const auto texelsTooFew = [&](double casterDepth) {
    return (0.5 * glm::length(widestKernel(scene, space, map, casterDepth)) + 1.0) / (kLongestOffset - 1.0);
  };
  const double halfWay =
      1.0 - 2.0 * space.nearDistance / (sharedFit(scene).nearestCaster + sharedFit(scene).farthestCaster);
  map.depthTexelsPerTexel *=
      std::max({1.0, std::min(texelsTooFew(1.0 - space.nearDistance / sharedFit(scene).nearestCaster), 2.0),
                std::min(texelsTooFew(halfWay), kLargestShrink)});
  // The corner of the widest kernel; one texel more, since the map is interpolated.
  const glm::dvec2 widest = widestKernel(scene, space, map);
  const double wanted = 0.5 * glm::length(widest) + 1.0;
  // Steps of eight texels: a receiver that moves a little keeps the map's content.
  map.reachTexels = std::min(8.0 * std::ceil(wanted / 8.0), kLongestOffset);
  map.kneeTexels = 0.25 * map.reachTexels;
  const glm::dvec2 inner = glm::ceil(glm::dvec2(space.mapSize) / map.depthTexelsPerTexel);
  // The box atlas repeats the map in two columns.
  const double limit = scene.capabilities.limits.textureSize;
  const bool withBoxes = corners != WidthCorners::off;
  const int columns = withBoxes ? 2 : 1, rows = withBoxes ? (boxTiles(scene, space, map) + 1) / 2 : 1;
  const double maps = map.tilesPerSide;
  const double room = std::min(limit / (columns * maps) - inner.x, limit / (rows * maps) - inner.y) / 2.0;
  map.margin = static_cast<int>(std::max(std::min(map.reachTexels, std::floor(room)), 0.0));
  map.width = static_cast<int>(inner.x) + 2 * map.margin;
  map.height = static_cast<int>(inner.y) + 2 * map.margin;

  const std::string prefix = scene.name + " width ";
  const auto addTarget = [&](const std::string& name, framegraph::Lifetime lifetime,
                             framegraph::Filter filter) {
    return plan.addImage({.name = prefix + name,
                          .width = map.tilesPerSide * map.width,
                          .height = map.tilesPerSide * map.height,
                          .lifetime = lifetime,
                          .filter = filter});
  };
  using framegraph::Filter;
  using framegraph::Lifetime;
  const auto coverage = addTarget("coverage", Lifetime::transient, Filter::nearest);
  auto defines = depthDefines(depth.storage);
  const glm::ivec2 samples(glm::min(glm::ceil(map.depthTexelsPerTexel - 1e-6), glm::dvec2(16.0)));
  defines.push_back("HS_SAMPLES_S " + std::to_string(samples.x));
  defines.push_back("HS_SAMPLES_T " + std::to_string(samples.y));
  std::vector<TextureRead> sources = {{"u_depthMap", depth.map}};
  if (!lastReceivers(scene).empty) {
    const LightDepth last = planLightDepths(scene, plan, MapContent::lastReceivers);
    defines.push_back("HS_LAST_RECEIVERS");
    sources.push_back({"u_lastReceivers", last.map});
    depth.contentKey = combineKeys(depth.contentKey, last.contentKey);
  }
  addStep(scene, plan, depth, map,
          {.name = "width coverage",
           .file = "width/width_coverage.frag",
           .defines = defines,
           .sources = std::move(sources),
           .target = coverage});
  map.coverage = coverage;
  auto offsets = addTarget("seeds", Lifetime::transient, Filter::nearest);
  addStep(scene, plan, depth, map,
          {.name = "width seeds",
           .file = "width/width_seed.frag",
           .sources = {{"u_coverage", coverage}},
           .target = offsets});
  int stride = 1;
  while (2 * stride < std::min<double>(kLongestOffset, map.reachTexels)) stride *= 2;
  for (; stride >= 1; stride /= 2) {
    const auto next = addTarget("offsets " + std::to_string(stride), Lifetime::transient, Filter::nearest);
    addStep(scene, plan, depth, map,
            {.name = "width flood",
             .file = "width/width_flood.frag",
             .sources = {{"u_offsets", offsets}},
             .target = next,
             .strideTexels = stride});
    offsets = next;
  }
  map.map = addTarget("map", Lifetime::persistent, Filter::linear);
  const std::uint64_t shape = shapeKey(map);
  std::vector<TextureRead> finished = {{"u_offsets", offsets}, {"u_coverage", coverage}};
  if (withBoxes) {
    map.boxes = planWidthBoxes(scene, plan, depth, map);
    finished.push_back({"u_boxes", map.boxes.atlas});
  }
  std::vector<std::string> finishDefines;
  if (withBoxes) finishDefines.emplace_back("HS_BOXES");
  if (corners == WidthCorners::stored) finishDefines.emplace_back("HS_CORNER_SHARE");
  addStep(scene, plan, depth, map,
          {.name = "width map",
           .file = "width/width_finish.frag",
           .defines = std::move(finishDefines),
           .sources = std::move(finished),
           .target = map.map,
           .contentKey = combineKeys(depth.contentKey, shape)});
  return map;
}

void addWidthBoxes(ReceiverShading& shading, const SignedWidthMap& map) {
  shading.textures.push_back({.sampler = "u_boxes", .resource = map.boxes.atlas});
  shading.uniforms.set("u_boxLayout", boxUniform(map));
}

void addSignedWidth(const LightScene& scene, ReceiverShading& shading, const LightDepth& depth,
                    const SignedWidthMap& map) {
  shading.textures.push_back({.sampler = "u_widthMap", .resource = map.map});
  const MapSpace space = spaceOfOne(depth);
  const glm::dvec2 kernel = kernelPerDepth(space, map.depthTexelsPerTexel) / space.depthUnit;
  const glm::vec4 range(map.reachTexels, map.kneeTexels, kernel.x, kernel.y);
  const CasterRange casters = casterRange(scene, space);
  // Narrower than a depth texel, a penumbra is an edge.
  const glm::vec4 casterDepth(casters.nearest, casters.range,
                              1.0 / std::max(map.depthTexelsPerTexel.x, map.depthTexelsPerTexel.y),
                              space.depthUnit);
  shading.uniforms.set("u_widthLayout", layoutUniform(map));
  if (map.tilesPerSide > 1) {
    shading.uniforms.set("u_widthTile", tileUniform(map));
    shading.uniforms.set("u_kernel", kernelUniform(scene, space, map));
    const glm::dvec2 ofAtlas(layoutUniform(map).z, layoutUniform(map).w);
    const glm::dvec2 perDepthTexel = ofAtlas / map.depthTexelsPerTexel;
    shading.uniforms.set("u_widthSteps",
                         glm::vec4(subLightSteps(depth) * glm::dvec4(perDepthTexel, perDepthTexel)));
    shading.uniforms.set("u_widthFirst", glm::vec4(perDepthTexel, ofAtlas * static_cast<double>(map.margin)));
  }
  shading.uniforms.set("u_widthPlace", placeUniform(map));
  shading.uniforms.set("u_widthRange", range);
  shading.uniforms.set("u_casterDepth", casterDepth);
}

}  // namespace halfshadow::techniques
