// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_width/paper_width.hpp"

#include <algorithm>
#include <cmath>

#include "base/keys.hpp"
#include "techniques/parts/maps/filter_pass.hpp"

namespace halfshadow::techniques {
namespace {
/// Depth half-way between that of casters and that of empty texels, in depth units.
double emptyBorder(const LightDepth& depth) {
  const MapSpace& space = depth.space;
  if (depth.content == MapContent::castersFarthest) return 0.5 * space.quantum * space.depthUnit;
  return 0.5 * (space.farthestCasterDepth + 1.0) * space.depthUnit;
}

struct WidthPasses {
  PassPlan& plan;
  std::string prefix;
  int side = 0;
  std::uint64_t contentKey = 0;
  framegraph::ResourceId occlusion;

  framegraph::ResourceId addTarget(const std::string& name, framegraph::Lifetime lifetime) const {
    return plan.addImage({.name = prefix + name,
                          .width = side,
                          .height = side,
                          .lifetime = lifetime,
                          .filter = lifetime == framegraph::Lifetime::persistent
                                        ? framegraph::Filter::linear
                                        : framegraph::Filter::nearest});
  }
};

framegraph::ResourceId planGpuSteps(const WidthPasses& passes, const std::vector<WidthStep>& steps) {
  framegraph::ResourceId source = passes.occlusion;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool last = i + 1 == steps.size();
    const std::string name = last ? "map" : "map step " + std::to_string(i);
    const auto target =
        passes.addTarget(name, last ? framegraph::Lifetime::persistent : framegraph::Lifetime::transient);
    const std::size_t count = steps[i].neighbours.size();
    std::vector<glm::vec4> offsets;
    for (const glm::ivec2& offset : steps[i].neighbours)
      offsets.emplace_back(glm::vec2(offset) / static_cast<float>(passes.side), 0, 0);
    device::UniformList uniforms;
    uniforms.set("u_difference", glm::vec4(steps[i].differenceBytes, 0, 0, 0));
    uniforms.set("u_neighbours", std::move(offsets));
    addFilterPass(passes.plan, {.name = passes.prefix + name,
                                .fragmentFile = "width/width_minimum.frag",
                                .defines = {"HS_NEIGHBOURS " + std::to_string(count)},
                                .source = source,
                                .target = target,
                                .sourceSize = passes.side,
                                .contentKey = last ? passes.contentKey : 0,
                                .sampler = "u_source",
                                .uniforms = std::move(uniforms)});
    source = target;
  }
  return source;
}

/// The same on the red channel of what was read back.
void computeOnCpu(std::vector<std::uint8_t>& rgba, int side, const std::vector<WidthStep>& steps) {
  std::vector<std::uint8_t> map(rgba.size() / 4);
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = rgba[4 * i];
  widthMapOnCpu(map, side, steps);
  for (std::size_t i = 0; i < map.size(); ++i) std::fill_n(&rgba[4 * i], 4, map[i]);
}

framegraph::ResourceId planCpuSteps(const WidthPasses& passes, const std::vector<WidthStep>& steps) {
  const auto target = passes.addTarget("map", framegraph::Lifetime::persistent);
  PlannedPass pass{.name = passes.prefix + "map on the CPU",
                   .writes = {{.resource = target}},
                   .contentKey = passes.contentKey};
  pass.draws.push_back(
      {.program = passes.plan.addProgram({"screen/fullscreen.vert", "map/pyramid_copy.frag", {}}),
       .what = ReadBackDraw{.image = passes.occlusion,
                            .width = passes.side,
                            .height = passes.side,
                            .sampler = "u_source",
                            .change = [side = passes.side, steps](std::vector<std::uint8_t>& rgba) {
                              computeOnCpu(rgba, side, steps);
                            }}});
  passes.plan.passes.push_back(std::move(pass));
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

framegraph::ResourceId planPaperWidth(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                                      const std::vector<WidthStep>& steps, WidthBuild build) {
  WidthPasses passes{.plan = plan, .prefix = scene.name + " shadow width ", .side = depth.space.mapSize};
  const std::size_t shape = steps.size() * 16 + steps.front().neighbours.size();
  passes.contentKey = combineKeys(depth.contentKey,
                                  shape * 512 + static_cast<std::size_t>(steps.front().differenceBytes) * 2 +
                                      (build == WidthBuild::cpu ? 1 : 0));
  passes.occlusion = passes.addTarget("occlusion", framegraph::Lifetime::transient);
  auto defines = depthDefines(depth.storage);
  if (depth.content == MapContent::castersFarthest) defines.push_back("HS_FARTHEST");
  device::UniformList uniforms;
  uniforms.set("u_casterRange", glm::vec4(0, 0, emptyBorder(depth), 0));
  addFilterPass(plan, {.name = passes.prefix + "occlusion",
                       .fragmentFile = "width/width_occlusion.frag",
                       .defines = std::move(defines),
                       .source = depth.map,
                       .target = passes.occlusion,
                       .sourceSize = passes.side,
                       .sampler = "u_depthMap",
                       .uniforms = std::move(uniforms)});
  return build == WidthBuild::cpu ? planCpuSteps(passes, steps) : planGpuSteps(passes, steps);
}

}  // namespace halfshadow::techniques
