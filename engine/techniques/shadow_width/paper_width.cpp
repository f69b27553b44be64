// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_width/paper_width.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/keys.hpp"
#include "techniques/parts/maps/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
/// Depth half-way between that of casters and that of empty texels, in depth units.
double emptyBorder(const LightDepth& depth) {
  const MapSpace& space = depth.space;
  if (depth.content == MapContent::castersFarthest) return 0.5 * space.quantum * space.depthUnit;
  return 0.5 * (space.farthestCasterDepth + 1.0) * space.depthUnit;
}

struct WidthPasses {
  const LightFrame& frame;
  std::string prefix;
  int side = 0;
  std::uint64_t contentKey = 0;
  framegraph::ResourceId occlusion;

  framegraph::ResourceId addTarget(const std::string& name, framegraph::Lifetime lifetime) const {
    return frame.graph.addResource({.name = prefix + name,
                                    .width = side,
                                    .height = side,
                                    .lifetime = lifetime,
                                    .filter = lifetime == framegraph::Lifetime::persistent
                                                  ? framegraph::Filter::linear
                                                  : framegraph::Filter::nearest});
  }
};

Result<framegraph::ResourceId> declareGpuSteps(const WidthPasses& passes,
                                               const std::vector<WidthStep>& steps) {
  framegraph::ResourceId source = passes.occlusion;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool last = i + 1 == steps.size();
    const std::string name = last ? "map" : "map step " + std::to_string(i);
    const auto target =
        passes.addTarget(name, last ? framegraph::Lifetime::persistent : framegraph::Lifetime::transient);
    const std::size_t count = steps[i].neighbours.size();
    auto program = passes.frame.programs.get(
        {"screen/fullscreen.vert", "width/width_minimum.frag", {"HS_NEIGHBOURS " + std::to_string(count)}});
    if (!program) return program.error();
    std::vector<glm::vec4> offsets;
    for (const glm::ivec2& offset : steps[i].neighbours)
      offsets.emplace_back(glm::vec2(offset) / static_cast<float>(passes.side), 0, 0);
    addFilterPass(passes.frame.graph, {.name = passes.prefix + name,
                                       .program = *program,
                                       .source = source,
                                       .target = target,
                                       .sourceSize = passes.side,
                                       .contentKey = last ? passes.contentKey : 0,
                                       .sampler = "u_source",
                                       .setUniforms = [offsets, difference = steps[i].differenceBytes](
                                                          gl::Program& linked, gl::Context& context) {
                                         linked.set(context, "u_difference", glm::vec4(difference, 0, 0, 0));
                                         linked.setArray(context, "u_neighbours", offsets.data(),
                                                         static_cast<int>(offsets.size()));
                                       }});
    source = target;
  }
  return source;
}

/// Reads the occlusion map back, computes, uploads, and copies into the target, which keeps its content.
Status computeOnCpu(framegraph::PassContext& context, framegraph::ResourceId occlusion, int side,
                    const std::vector<WidthStep>& steps, gl::Texture& upload) {
  gl::Context& gl = context.encoder.context();
  auto framebuffer = gl::Framebuffer::create(gl, {.color = &context.texture(occlusion)});
  if (!framebuffer) return framebuffer.error();
  const std::size_t texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::vector<std::uint8_t> pixels(texels * 4);
  context.encoder.readPixels(*framebuffer, {0, 0, side, side}, pixels.data());
  std::vector<std::uint8_t> map(texels);
  for (std::size_t i = 0; i < texels; ++i) map[i] = pixels[4 * i];
  widthMapOnCpu(map, side, steps);
  for (std::size_t i = 0; i < texels; ++i) std::fill_n(&pixels[4 * i], 4, map[i]);
  auto texture = gl::Texture::create(gl, {.width = side, .height = side}, pixels.data());
  if (!texture) return texture.error();
  upload = std::move(texture).value();
  return {};
}

Result<framegraph::ResourceId> declareCpuSteps(const WidthPasses& passes,
                                               const std::vector<WidthStep>& steps) {
  auto program = passes.frame.programs.get({"screen/fullscreen.vert", "map/pyramid_copy.frag", {}});
  if (!program) return program.error();
  const auto target = passes.addTarget("map", framegraph::Lifetime::persistent);
  framegraph::PassDesc pass{.name = passes.prefix + "map on the CPU",
                            .stage = framegraph::PassStage::mask,
                            .reads = {passes.occlusion}};
  pass.writes = {{.resource = target}};
  pass.contentKey = passes.contentKey;
  pass.execute = [program = *program, occlusion = passes.occlusion, side = passes.side,
                  steps](framegraph::PassContext& context) {
    gl::Texture upload;
    // Without memory for the copy the target stays clear: no shadow rather than a garbled one.
    if (!computeOnCpu(context, occlusion, side, steps, upload)) return;
    context.encoder.useProgram(*program);
    const gl::TextureBinding binding{program->samplerUnit("u_source"), &upload};
    context.encoder.bindTextures({&binding, 1});
    context.encoder.drawFullscreen({});
  };
  passes.frame.graph.addPass(std::move(pass));
  return target;
}
}  // namespace

std::vector<WidthStep> widthSteps(int neighbours, int start) {
  constexpr double kPi = 3.14159265358979323846;
  const int first = std::max(1, static_cast<int>(std::lround(255.0 / start)));
  std::vector<WidthStep> steps;
  for (int distance = 1; first * distance <= 255; distance *= 2) {
    WidthStep step{.differenceBytes = first * distance};
    const double turn = neighbours == 3 && steps.size() % 2 == 1 ? kPi : 0.0;
    for (int i = 0; i < neighbours; ++i) {
      const double angle = turn + 2.0 * kPi * i / neighbours;
      step.neighbours.emplace_back(std::lround(distance * std::cos(angle)),
                                   std::lround(distance * std::sin(angle)));
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

void widthMapOnCpu(std::vector<std::uint8_t>& map, int side, const std::vector<WidthStep>& steps) {
  std::vector<std::uint8_t> before;
  for (const WidthStep& step : steps) {
    before = map;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        int smallest = before[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                              static_cast<std::size_t>(x)];
        if (smallest == 0) continue;
        for (const glm::ivec2& offset : step.neighbours) {
          const auto column = static_cast<std::size_t>(std::clamp(x + offset.x, 0, side - 1));
          const auto row = static_cast<std::size_t>(std::clamp(y + offset.y, 0, side - 1));
          smallest = std::min(smallest,
                              before[row * static_cast<std::size_t>(side) + column] + step.differenceBytes);
        }
        map[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)] =
            static_cast<std::uint8_t>(smallest);
      }
    }
  }
}

Result<PaperWidthMap> declarePaperWidth(const LightFrame& frame, const LightDepth& depth,
                                        const std::vector<WidthStep>& steps, WidthBuild build) {
  WidthPasses passes{.frame = frame,
                     .prefix = "light " + std::to_string(frame.lightIndex) + " shadow width ",
                     .side = depth.space.mapSize};
  const std::size_t shape = steps.size() * 16 + steps.front().neighbours.size();
  passes.contentKey = combineKeys(depth.contentKey,
                                  shape * 512 + static_cast<std::size_t>(steps.front().differenceBytes) * 2 +
                                      (build == WidthBuild::cpu ? 1 : 0));
  passes.occlusion = passes.addTarget("occlusion", framegraph::Lifetime::transient);
  auto defines = depthDefines(depth.storage);
  if (depth.content == MapContent::castersFarthest) defines.push_back("HS_FARTHEST");
  auto program = frame.programs.get({"screen/fullscreen.vert", "width/width_occlusion.frag", defines});
  if (!program) return program.error();
  addFilterPass(frame.graph,
                {.name = passes.prefix + "occlusion",
                 .program = *program,
                 .source = depth.map,
                 .target = passes.occlusion,
                 .sourceSize = passes.side,
                 .sampler = "u_depthMap",
                 .setUniforms = [border = emptyBorder(depth)](gl::Program& linked, gl::Context& context) {
                   linked.set(context, "u_casterRange", glm::vec4(0, 0, border, 0));
                 }});
  auto map = build == WidthBuild::cpu ? declareCpuSteps(passes, steps) : declareGpuSteps(passes, steps);
  if (!map) return map.error();
  return PaperWidthMap{.occlusion = passes.occlusion, .map = *map};
}

}  // namespace halfshadow::techniques
