// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/screen_walk.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::techniques {
namespace {
/// Of a normal from derivatives: places relative to the eye are interpolated in single precision, which shows
/// in their differences between pixels, four times its half step in each of them. Measured: a table of 168 x
/// 168 seen from 290 away under 11 degrees hid itself without (WideFacetsHideNothingOfThemselves).
double derivativeRounding(const ReceiverRays& rays) {
  constexpr double kOfPlaces = 4.0 / (1 << 24);
  return kOfPlaces / std::max(std::min(glm::length(rays.rayX), glm::length(rays.rayY)), 1e-30);
}

/// World to the map and to planes of facets, relative to the eye and in units of the farthest receiver.
struct RelativeMap {
  glm::mat4 map, plane;
};
RelativeMap relativeMap(const View& view, const ReceiverDepth& depth, const glm::dmat4& mapFromWorld) {
  glm::dmat4 worldFromRelative(depth.farthest);
  worldFromRelative[3] = glm::dvec4(view.eyeWorld, 1.0);
  const glm::dmat4 map = mapFromWorld * worldFromRelative;
  glm::dmat4 plane = glm::transpose(glm::inverse(map));
  double largest = 0.0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(plane[column][row]));
  }
  plane /= std::max(largest, 1e-300);
  return {glm::mat4(map), glm::mat4(plane)};
}
}  // namespace

std::optional<std::vector<NumberedReceiver>> screenWalkers(const LightScene& scene, bool intoTrees) {
  const std::string& asked = scene.settings.choice("list_walk");
  if (asked == "surfaces" || (asked == "auto" && !intoTrees)) return std::nullopt;
  // Places and planes are stored in more bits than mediump has; halves of programs are drawn on surfaces.
  if (!scene.capabilities.has(device::Capability::highp) || hasProgramsInParts(scene)) return std::nullopt;
  const auto hasPlane = [&](const DrawItem& item) {
    return !item.casts || item.facetStream || scene.capabilities.has(device::Capability::derivatives);
  };
  if (!std::ranges::any_of(scene.receivers, &DrawItem::casts) ||
      !std::ranges::all_of(scene.receivers, hasPlane))
    return std::nullopt;
  return numberReceivers(scene);
}

void planScreenWalk(const LightScene& scene, PassPlan& plan, std::span<const NumberedReceiver> walkers,
                    const ListReads& reads, const ScreenWalk& walk) {
  const View& view = scene.screen;
  const ReceiverDepth depth = planReceiverDepth(scene, plan, ReceiverAlpha::numbers, walkers);
  const framegraph::ResourceId facets = planReceiverFacets(scene, plan, depth);
  const framegraph::ResourceId image =
      plan.addImage({.name = scene.name + " own lists", .width = view.width, .height = view.height});

  std::vector<std::string> defines = walk.defines;
  defines.insert(defines.end(), reads.defines.begin(), reads.defines.end());
  if (scene.countsFetches) defines.push_back("HS_COUNT_TAPS");
  const std::uint32_t program = plan.addProgram({"screen/fullscreen.vert", walk.fragmentFile, defines});
  const ReceiverRays rays = receiverRays(view, depth, glm::dmat3(1.0 / depth.farthest), view.eyeWorld);
  const RelativeMap relative = relativeMap(view, depth, reads.mapFromWorld);

  PlannedPass pass{.name = scene.name + " own lists", .stage = framegraph::PassStage::receiverPrepass};
  // Read only where it was drawn.
  pass.writes = {{.resource = image,
                  .point = framegraph::AttachmentPoint::color,
                  .initial = framegraph::InitialContent::clear}};
  const auto byDerivatives = static_cast<float>(derivativeRounding(rays));
  for (const NumberedReceiver& walker : walkers) {
    if (!walker.rect) continue;
    PlannedDraw draw{.program = program, .textures = reads.textures, .uniforms = reads.uniforms};
    draw.viewport = walker.rect;
    addReceiverPosition(draw, view, depth, rays);
    draw.textures.push_back({.sampler = "u_receiverFacets", .resource = facets});
    draw.uniforms.set("u_mapFromRelative", relative.map);
    draw.uniforms.set("u_planeFromFacet", relative.plane);
    draw.uniforms.set("u_facetRounding", walker.item->facetStream ? 0.0f : byDerivatives);
    draw.uniforms.set("u_receiverNumber", static_cast<float>(walker.number));
    reads.tilesOf(*walker.item, draw.uniforms);
    pass.draws.push_back(std::move(draw));
  }
  plan.passes.push_back(std::move(pass));

  ReceiverShading& shading = plan.shading;
  shading.castingFile = "screen/screen_visibility.frag";
  shading.textures.push_back({.sampler = "u_screen", .resource = image});
  // High and low byte of 65280ths.
  shading.uniforms.set("u_channel", glm::vec4(1.0f, 1.0f / 256.0f, 0.0f, 0.0f));
  shading.uniforms.set("u_offset", 0.0f);
  shading.uniforms.set("u_earlierTaps", glm::vec4(255.0f, 255.0f * 256.0f, 0.0f, 0.0f));
}

}  // namespace halfshadow::techniques
