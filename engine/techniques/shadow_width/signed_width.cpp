// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_width/signed_width.hpp"

#include <algorithm>
#include <cmath>

#include "base/keys.hpp"
#include "techniques/parts/maps/last_receivers.hpp"
#include "techniques/parts/maps/light_blocks.hpp"

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

glm::vec4 layoutUniform(const SignedWidthMap& map) {
  return {map.width, map.height, 1.0 / map.width, 1.0 / map.height};
}

glm::vec4 placeUniform(const SignedWidthMap& map) {
  return {1.0 / map.depthTexelsPerTexel.x, 1.0 / map.depthTexelsPerTexel.y, map.margin, 0.0};
}

glm::vec4 boxUniform(const SignedWidthMap& map) {
  const int rows = (map.boxes.tiles + 1) / 2;
  return {0.5 / map.width, 1.0 / (rows * map.height), map.boxes.tiles, 0};
}

/// Distances of casters, less the near distance and in units of it: the nearest, and their range.
struct CasterDistances {
  double nearest = 0.0, range = 1.0;
};
CasterDistances casterDistances(const planner::LightFit& fit) {
  const double rounding = kRounding * fit.farthestCaster / fit.nearDistance;
  return {fit.nearestCaster / fit.nearDistance - 1.0,
          std::max((fit.farthestCaster - fit.nearestCaster) / fit.nearDistance, rounding)};
}

/// Distances of casters to 0 … 1, the depth between them and empty texels, and the depth of a whole range.
glm::vec4 casterRange(const planner::LightFit& fit, const MapSpace& space) {
  const CasterDistances casters = casterDistances(fit);
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
glm::dvec2 widestKernel(const LightFrame& frame, const MapSpace& space, const SignedWidthMap& map,
                        double casterDepth) {
  const double farthest =
      1.0 - space.nearDistance / std::max(frame.receiverFarDistance, frame.fit.farthestCaster);
  return kernelPerDepth(space, map.depthTexelsPerTexel) * (farthest - casterDepth);
}
glm::dvec2 widestKernel(const LightFrame& frame, const MapSpace& space, const SignedWidthMap& map) {
  return widestKernel(frame, space, map, 1.0 - space.nearDistance / frame.fit.nearestCaster);
}

/// Boxes up to the widest penumbra.
int boxTiles(const LightFrame& frame, const MapSpace& space, const SignedWidthMap& map) {
  const glm::dvec2 kernel = widestKernel(frame, space, map);
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

struct Source {
  gl::UniformKey sampler;
  framegraph::ResourceId resource;
};
struct Step {
  const char* name;
  const char* file;
  std::vector<std::string> defines;
  std::vector<Source> sources;
  framegraph::ResourceId target;
  int strideTexels = 0;
  double boxTexels = 0.0;
  std::uint64_t contentKey = 0;
};

Status addStep(const LightFrame& frame, const LightDepth& depth, const SignedWidthMap& map, Step step) {
  auto program = frame.programs.get({"screen/fullscreen.vert", step.file, step.defines});
  if (!program) return program.error();
  framegraph::PassDesc pass{.name = step.name, .stage = framegraph::PassStage::mask};
  pass.name = "light " + std::to_string(frame.lightIndex) + " " + step.name;
  if (step.strideTexels > 0) pass.name += " " + std::to_string(step.strideTexels);
  for (const Source& source : step.sources) pass.reads.push_back(source.resource);
  pass.writes = {{.resource = step.target, .initial = framegraph::InitialContent::dontCare}};
  pass.contentKey = step.contentKey;
  const float mapSize = static_cast<float>(depth.space.mapSize);
  pass.execute = [program = *program, sources = std::move(step.sources), boxes = boxUniform(map),
                  layout = layoutUniform(map), mapSize, casters = casterRange(frame.fit, depth.space),
                  place = placeUniform(map), flood = glm::vec4(step.strideTexels, 0, 0, 0),
                  box = glm::vec4(step.boxTexels, 0, 0, 0),
                  lastMargin = glm::vec4(2.0 * depth.space.quantum * depth.space.depthUnit, 0, 0, 0),
                  range =
                      glm::vec4(map.reachTexels, map.kneeTexels, 0, 0)](framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    encoder.useProgram(*program);
    program->set(encoder.context(), "u_sourceSize", glm::vec4(mapSize, 1.0f / mapSize, 0, 0));
    program->set(encoder.context(), "u_widthLayout", layout);
    program->set(encoder.context(), "u_widthPlace", place);
    program->set(encoder.context(), "u_casterRange", casters);
    program->set(encoder.context(), "u_flood", flood);
    program->set(encoder.context(), "u_box", box);
    program->set(encoder.context(), "u_boxLayout", boxes);
    program->set(encoder.context(), "u_widthRange", range);
    program->set(encoder.context(), "u_lastMargin", lastMargin);
    std::vector<gl::TextureBinding> bindings;
    for (const Source& source : sources) {
      bindings.push_back({program->samplerUnit(source.sampler), &context.texture(source.resource)});
    }
    encoder.bindTextures(bindings);
    encoder.drawFullscreen({});
  };
  frame.graph.addPass(std::move(pass));
  return {};
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

static Result<WidthBoxes> declareWidthBoxes(const LightFrame& frame, const LightDepth& depth,
                                            const SignedWidthMap& map) {
  const std::string prefix = "light " + std::to_string(frame.lightIndex) + " width ";
  WidthBoxes boxes{.tiles = boxTiles(frame, depth.space, map)};
  const int rows = (boxes.tiles + 1) / 2;
  std::vector<framegraph::ResourceId> levels = {map.coverage};
  for (int level = 0; level <= boxes.tiles; ++level) {
    const auto next = frame.graph.addResource(
        {.name = prefix + "boxes " + std::to_string(2 << level), .width = map.width, .height = map.height});
    // To and fro, so that no level's boxes stand far beside their texels.
    const double neighbour = (level % 2 == 0 ? 1.0 : -1.0) * std::exp2(level);
    if (Status s = addStep(frame, depth, map,
                           {.name = "width boxes",
                            .file = "width/width_box.frag",
                            .sources = {{"u_coverage", levels.back()}},
                            .target = next,
                            .strideTexels = 2 << level,
                            .boxTexels = neighbour});
        !s) {
      return s.error();
    }
    levels.push_back(next);
  }
  auto program = frame.programs.get({"screen/fullscreen.vert", "width/width_tile.frag", {}});
  if (!program) return program.error();
  boxes.atlas = frame.graph.addResource({.name = prefix + "box atlas",
                                         .width = 2 * map.width,
                                         .height = rows * map.height,
                                         .lifetime = framegraph::Lifetime::persistent,
                                         .filter = framegraph::Filter::linear});
  framegraph::PassDesc pass{.name = prefix + "box atlas", .stage = framegraph::PassStage::mask};
  pass.reads.assign(levels.begin() + 1, levels.end());
  pass.writes = {{.resource = boxes.atlas}};
  pass.contentKey = combineKeys(depth.contentKey, shapeKey(map) + static_cast<std::uint64_t>(boxes.tiles));
  pass.execute = [program = *program, levels, layout = layoutUniform(map), width = map.width,
                  height = map.height, tiles = boxes.tiles](framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    encoder.useProgram(*program);
    program->set(encoder.context(), "u_widthLayout", layout);
    for (int tile = 0; tile < tiles; ++tile) {
      const std::size_t level = static_cast<std::size_t>(tile) + 1;
      const float between =
          static_cast<float>((level % 2 == 0 ? -1.0 : 1.0) * std::exp2(static_cast<double>(level) - 1.0));
      program->set(encoder.context(), "u_box", glm::vec4(between, 0, 0, 0));
      const gl::TextureBinding bindings[] = {
          {program->samplerUnit("u_smallerBoxes"), &context.texture(levels[level])},
          {program->samplerUnit("u_largerBoxes"), &context.texture(levels[level + 1])}};
      encoder.bindTextures(bindings);
      encoder.setViewport({(tile % 2) * width, (tile / 2) * height, width, height});
      encoder.drawFullscreen({});
    }
  };
  frame.graph.addPass(std::move(pass));
  return boxes;
}

Result<SignedWidthMap> declareSignedWidth(const LightFrame& frame, const LightDepth& casters) {
  LightDepth depth = casters;
  const MapSpace& space = depth.space;
  SignedWidthMap map;
  map.depthTexelsPerTexel = depthTexelsPerWidthTexel(space);
  // Distances reach kLongestOffset texels: the widest kernel should fit. Where a caster stands next to the
  // light that would cost all others their resolution, so its penumbra is cut, but for lights so large that
  // casters half-way to the farthest have such penumbrae too.
  const auto texelsTooFew = [&](double casterDepth) {
    return (0.5 * glm::length(widestKernel(frame, space, map, casterDepth)) + 1.0) / (kLongestOffset - 1.0);
  };
  const double halfWay =
      1.0 - 2.0 * space.nearDistance / (frame.fit.nearestCaster + frame.fit.farthestCaster);
  map.depthTexelsPerTexel *=
      std::max({1.0, std::min(texelsTooFew(1.0 - space.nearDistance / frame.fit.nearestCaster), 2.0),
                std::min(texelsTooFew(halfWay), kLargestShrink)});
  // The corner of the widest kernel; one texel more, since the map is interpolated.
  const glm::dvec2 widest = widestKernel(frame, space, map);
  const double wanted = 0.5 * glm::length(widest) + 1.0;
  // Steps of eight texels: a receiver that moves a little keeps the map's content.
  map.reachTexels = std::min(8.0 * std::ceil(wanted / 8.0), kLongestOffset);
  map.kneeTexels = 0.25 * map.reachTexels;
  const glm::dvec2 inner = glm::ceil(glm::dvec2(space.mapSize) / map.depthTexelsPerTexel);
  // The box atlas repeats the map in two columns.
  const double limit = frame.capabilities.limits.textureSize;
  const int rows = (boxTiles(frame, space, map) + 1) / 2;
  const double room = std::min(0.5 * limit - inner.x, limit / rows - inner.y) / 2.0;
  map.margin = static_cast<int>(std::max(std::min(map.reachTexels, std::floor(room)), 0.0));
  map.width = static_cast<int>(inner.x) + 2 * map.margin;
  map.height = static_cast<int>(inner.y) + 2 * map.margin;

  const std::string prefix = "light " + std::to_string(frame.lightIndex) + " width ";
  const auto addTarget = [&](const std::string& name, framegraph::Lifetime lifetime,
                             framegraph::Filter filter) {
    return frame.graph.addResource({.name = prefix + name,
                                    .width = map.width,
                                    .height = map.height,
                                    .lifetime = lifetime,
                                    .filter = filter});
  };
  using framegraph::Filter;
  using framegraph::Lifetime;
  const auto coverage = addTarget("coverage", Lifetime::transient, Filter::nearest);
  auto defines = depthDefines(depth.storage);
  const glm::ivec2 samples = glm::min(glm::ivec2(glm::ceil(map.depthTexelsPerTexel - 1e-6)), glm::ivec2(16));
  defines.push_back("HS_SAMPLES_S " + std::to_string(samples.x));
  defines.push_back("HS_SAMPLES_T " + std::to_string(samples.y));
  std::vector<Source> sources = {{"u_depthMap", depth.map}};
  if (!lastReceivers(frame).empty) {
    auto last = declareLightDepth(frame, MapContent::lastReceivers);
    if (!last) return last.error();
    defines.push_back("HS_LAST_RECEIVERS");
    sources.push_back({"u_lastReceivers", last->map});
    depth.contentKey = combineKeys(depth.contentKey, last->contentKey);
  }
  if (Status s = addStep(frame, depth, map,
                         {.name = "width coverage",
                          .file = "width/width_coverage.frag",
                          .defines = defines,
                          .sources = std::move(sources),
                          .target = coverage});
      !s) {
    return s.error();
  }
  map.coverage = coverage;
  auto offsets = addTarget("seeds", Lifetime::transient, Filter::nearest);
  if (Status s = addStep(frame, depth, map,
                         {.name = "width seeds",
                          .file = "width/width_seed.frag",
                          .sources = {{"u_coverage", coverage}},
                          .target = offsets});
      !s) {
    return s.error();
  }
  int stride = 1;
  while (2 * stride < std::min<double>(kLongestOffset, map.reachTexels)) stride *= 2;
  for (; stride >= 1; stride /= 2) {
    const auto next = addTarget("offsets " + std::to_string(stride), Lifetime::transient, Filter::nearest);
    if (Status s = addStep(frame, depth, map,
                           {.name = "width flood",
                            .file = "width/width_flood.frag",
                            .sources = {{"u_offsets", offsets}},
                            .target = next,
                            .strideTexels = stride});
        !s) {
      return s.error();
    }
    offsets = next;
  }
  map.map = addTarget("map", Lifetime::persistent, Filter::linear);
  const std::uint64_t shape = shapeKey(map);
  auto boxes = declareWidthBoxes(frame, depth, map);
  if (!boxes) return boxes.error();
  map.boxes = *boxes;
  if (Status s =
          addStep(frame, depth, map,
                  {.name = "width map",
                   .file = "width/width_finish.frag",
                   .sources = {{"u_offsets", offsets}, {"u_coverage", coverage}, {"u_boxes", boxes->atlas}},
                   .target = map.map,
                   .contentKey = combineKeys(depth.contentKey, shape)});
      !s) {
    return s.error();
  }
  return map;
}

void addWidthBoxes(ReceiverShading& shading, const SignedWidthMap& map) {
  shading.textures.push_back({.sampler = "u_boxes", .resource = map.boxes.atlas});
  shading.setUniforms = [layout = boxUniform(map), inner = std::move(shading.setUniforms)](
                            gl::Program& program, gl::Context& context) {
    inner(program, context);
    program.set(context, "u_boxLayout", layout);
  };
}

void addSignedWidth(const LightFrame& frame, ReceiverShading& shading, const LightDepth& depth,
                    const SignedWidthMap& map) {
  shading.textures.push_back({.sampler = "u_widthMap", .resource = map.map});
  const MapSpace& space = depth.space;
  const glm::dvec2 kernel = kernelPerDepth(space, map.depthTexelsPerTexel) / space.depthUnit;
  const glm::vec4 range(map.reachTexels, map.kneeTexels, kernel.x, kernel.y);
  const CasterDistances casters = casterDistances(frame.fit);
  // Narrower than a depth texel, a penumbra is an edge.
  const glm::vec4 casterDepth(casters.nearest, casters.range,
                              1.0 / std::max(map.depthTexelsPerTexel.x, map.depthTexelsPerTexel.y),
                              space.depthUnit);
  shading.setUniforms = [layout = layoutUniform(map), place = placeUniform(map), range, casterDepth,
                         inner = std::move(shading.setUniforms)](gl::Program& program, gl::Context& context) {
    inner(program, context);
    program.set(context, "u_widthLayout", layout);
    program.set(context, "u_widthPlace", place);
    program.set(context, "u_widthRange", range);
    program.set(context, "u_casterDepth", casterDepth);
  };
}

}  // namespace halfshadow::techniques
