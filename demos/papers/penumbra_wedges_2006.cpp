// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Forest, Barthe, Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006: figures 1, 2 and 12.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/ext/matrix_transform.hpp>

#include "papers/comparison.hpp"
#include "report/html.hpp"
#include "report/line_plot.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::papers {
namespace {
/// The published methods, and this project's answer.
const std::vector<Variant> kPictured = {
    {"wedges", {"wedges"}},
    {"wedges-probabilistic", {"wedges-probabilistic"}},
    {"wedges-blended", {"wedges-blended", {{"wedges-blended.cog", "off"}}}},
    {"wedges-blended, centre of gravity", {"wedges-blended", {{"wedges-blended.cog", "on"}}}},
    {"wedges-cells, 16 bytes", {"wedges-cells", {{"wedges-cells.bytes", "16"}}}},
    {"wedges-cells, 32 bytes", {"wedges-cells", {{"wedges-cells.bytes", "32"}}}}};
const std::vector<Variant> kTimed = {{"wedges", {"wedges"}},
                                     {"wedges-probabilistic", {"wedges-probabilistic"}},
                                     {"wedges-blended", {"wedges-blended"}},
                                     {"wedges-cells", {"wedges-cells"}}};
/// Above this many triangles a software driver takes seconds a frame: pictures without times.
constexpr std::uint64_t kMostTimedTriangles = 200000;

struct PicturedScene {
  std::string source, what;
};

std::uint64_t casterTriangles(const scene::SceneDescription& scene) {
  std::uint64_t triangles = 0;
  for (const scene::SceneObject& object : scene.objects) {
    if (object.casts) triangles += object.mesh->triangleCount();
  }
  return triangles;
}

Status addPictures(measure::EngineSession& session, const PicturedScene& pictured,
                   const std::vector<Variant>& variants, const PaperOptions& options, PaperResult& result) {
  const auto scene = scenes::openScene(pictured.source, {});
  if (!scene) return scene.error();
  PaperOptions own = options;
  if (casterTriangles(*scene) > kMostTimedTriangles) own.repetitions = 0;
  auto comparison = compare(session, pictured.source, variants, own);
  if (!comparison) return comparison.error();
  if (!pictured.source.starts_with("builtin:"))
    comparison->source = std::filesystem::path(pictured.source).filename().string();
  auto pictures = picturesOf(*comparison);
  if (!pictures) return pictures.error();
  result.section.blocks.push_back(report::paragraphHtml(pictured.what + ": " + comparison->source));
  result.section.blocks.push_back(*pictures);
  result.json["comparisons"].push_back({{"figure", "1, 2"}, {"result", toJson(*comparison)}});
  return {};
}

/// The layer of builtin:spheres81 with `perRow`² of its spheres, and with more layers of 81 on top of it.
scene::SceneDescription spheres(const scene::SceneDescription& layer, int perRow, int layers) {
  scene::SceneDescription result = layer;
  const auto mostPerRow =
      static_cast<int>(std::lround(std::sqrt(static_cast<double>(layer.objects.size() - 1))));
  const int first = (mostPerRow - perRow) / 2;
  result.objects.clear();
  const double spacing =
      glm::length(glm::dvec3(layer.objects[1].worldFromObject[3] - layer.objects[0].worldFromObject[3]));
  int index = 0;
  for (const scene::SceneObject& object : layer.objects) {
    if (!object.casts) {
      result.objects.push_back(object);
      continue;
    }
    const int row = index / mostPerRow - first, column = index % mostPerRow - first;
    ++index;
    if (row < 0 || row >= perRow || column < 0 || column >= perRow) continue;
    for (int i = 0; i < layers; ++i) {
      result.objects.push_back(object);
      result.objects.back().worldFromObject =
          glm::translate(glm::dmat4(1.0), {0, spacing * i, 0}) * object.worldFromObject;
    }
  }
  return result;
}

struct CostPoint {
  int spheres = 0;
  std::uint64_t triangles = 0;
  std::vector<profile::FrameTimes> times;
};

Result<std::vector<CostPoint>> costs(measure::EngineSession& session, const std::vector<Variant>& variants,
                                     const PaperOptions& options) {
  const auto layer = scenes::openScene("builtin:spheres81@light=1", {});
  if (!layer) return layer.error();
  std::vector<measure::Configuration> configurations;
  for (const Variant& variant : variants) configurations.push_back(variant.configuration);
  constexpr std::pair<int, int> kSteps[] = {{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1},
                                            {7, 1}, {9, 1}, {9, 2}, {9, 3}};
  std::vector<CostPoint> points;
  for (const auto& [perRow, layers] : kSteps) {
    CostPoint point{.spheres = perRow * perRow * layers};
    const std::string stage = "figure 12, " + std::to_string(point.spheres) + " spheres";
    const measure::Progress progress = [&](const std::string&, double share) {
      if (options.progress) options.progress(stage, share);
    };
    const scene::SceneDescription scene = spheres(*layer, perRow, layers);
    point.triangles = casterTriangles(scene);
    auto times = profile::interleavedTimes(session, scene, configurations,
                                           {.width = options.width,
                                            .height = options.height,
                                            .repetitions = options.repetitions,
                                            .progress = progress});
    if (!times) return times.error();
    point.times = std::move(*times);
    points.push_back(std::move(point));
  }
  return points;
}

Status addCosts(measure::EngineSession& session, const std::vector<Variant>& variants,
                const PaperOptions& options, PaperResult& result) {
  const auto points = costs(session, variants, options);
  if (!points) return points.error();
  std::vector<report::Curve> moving, still;
  for (const Variant& variant : variants) {
    moving.push_back({.label = variant.label, .points = {}});
    still.push_back({.label = variant.label, .points = {}});
  }
  report::Table table{.note = "Milliseconds of a frame whose light moved / in which nothing changed.",
                      .header = {"spheres", "triangles"}};
  for (const Variant& variant : variants) table.header.push_back(variant.label);
  measure::Json json = measure::Json::array();
  for (const CostPoint& point : *points) {
    std::vector<std::string> row{std::to_string(point.spheres), report::counted(point.triangles)};
    measure::Json entry{
        {"spheres", point.spheres}, {"triangles", point.triangles}, {"ms", {}}, {"static_ms", {}}};
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const profile::FrameTimes& times = point.times[i];
      moving[i].points.push_back({static_cast<double>(point.spheres), times.frame.medianMs});
      still[i].points.push_back({static_cast<double>(point.spheres), times.frameStatic.medianMs});
      row.push_back(report::timeText(times.frame) + " / " + report::timeText(times.frameStatic));
      entry["ms"][variants[i].label] = times.frame.medianMs;
      entry["static_ms"][variants[i].label] = times.frameStatic.medianMs;
    }
    table.rows.push_back(std::move(row));
    json.push_back(std::move(entry));
  }
  result.json["comparisons"].push_back(
      {{"figure", "12"}, {"size", {options.width, options.height}}, {"points", std::move(json)}});
  const std::string spheresTitle = "spheres of 762 triangles (log)";
  std::vector<std::string>& blocks = result.section.blocks;
  blocks.push_back(
      report::plotHtml(report::lineSvg(moving, {spheresTitle, "time of a frame whose light moved, ms (log)"}),
                       "Silhouettes, lists and pictures are made anew in every frame."));
  blocks.push_back(report::plotHtml(
      report::lineSvg(still, {spheresTitle, "time of a frame in which nothing changed, ms (log)"}),
      "What a technique caches is cached."));
  blocks.push_back(report::tableHtml(table));
  return {};
}
}  // namespace

Result<PaperResult> penumbraWedges2006(measure::EngineSession& session, const PaperOptions& options) {
  PaperResult result;
  result.section.title = "Forest, Barthe, Paulin 2006: penumbra-wedges blending";
  result.json = {{"paper", "Forest, Barthe, Paulin 2006"}, {"comparisons", measure::Json::array()}};
  std::vector<std::string>& blocks = result.section.blocks;
  const Available pictured = availableOf(session, kPictured);
  noteLeftOut(result.section, pictured.leftOut);
  if (pictured.variants.empty()) return result;
  blocks.push_back(report::headingHtml("Figures 1 and 2: combinations of overlapping penumbrae"));
  blocks.push_back(report::paragraphHtml(conditionsText(options)));
  blocks.push_back(report::errorLegend());
  std::vector<PicturedScene> scenes = {{"builtin:spheres81@light=1", "9×9 spheres in one layer"},
                                       {"builtin:spheres-cube@light=1", "9×9×9 spheres"},
                                       {"builtin:bars@light=1", "Crossed bars"}};
  if (!options.model.empty()) scenes.push_back({options.model, "A model"});
  for (const PicturedScene& scene : scenes) {
    if (Status s = addPictures(session, scene, pictured.variants, options, result); !s) return s.error();
  }
  if (options.repetitions < 1) return result;
  blocks.push_back(report::headingHtml("Figure 12: cost over the number of spheres"));
  const Available timed = availableOf(session, kTimed);
  if (Status s = addCosts(session, timed.variants, options, result); !s) return s.error();
  return result;
}

}  // namespace halfshadow::papers
