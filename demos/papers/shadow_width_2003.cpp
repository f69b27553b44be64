// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Kirsch, Döllner, "Real-time soft shadows using a single light sample", 2003: table 1.
#include "papers/comparison.hpp"
#include "report/html.hpp"

namespace halfshadow::papers {
namespace {
constexpr int kMapSizes[] = {256, 512, 1024};
constexpr int kStarts[] = {4, 16, 64, 256};
constexpr int kNeighbours[] = {3, 6};
constexpr const char* kBuilds[] = {"gpu", "cpu"};
constexpr const char* kScene = "builtin:figure@light=1";

Variant variantOf(const char* build, int mapSize, int start, int neighbours) {
  return {std::string(build) + " " + std::to_string(mapSize) + ", 1/" + std::to_string(start) + ", " +
              std::to_string(neighbours) + " neighbours",
          {"shadow-width",
           {{"shadow-width.preset", "paper"},
            {"shadow-width.build", build},
            {"map_size", std::to_string(mapSize)},
            {"shadow-width.start", std::to_string(start)},
            {"shadow-width.neighbours", std::to_string(neighbours)}}}};
}

std::vector<Variant> tableVariants() {
  std::vector<Variant> variants;
  for (const char* build : kBuilds) {
    for (const int size : kMapSizes) {
      for (const int start : kStarts) {
        for (const int neighbours : kNeighbours)
          variants.push_back(variantOf(build, size, start, neighbours));
      }
    }
  }
  return variants;
}

std::string rate(double milliseconds) {
  return milliseconds > 0 ? report::threeDigits(1000.0 / milliseconds) : "–";
}

/// One row per build and map size, one column per start difference: "three / six neighbours".
template <typename Value>
report::Table tableOf(const Comparison& comparison, const std::string& note, Value&& value) {
  report::Table table{.note = note, .header = {"build", "map"}};
  for (const int start : kStarts) table.header.push_back("start 1/" + std::to_string(start));
  std::size_t index = 0;
  for (const char* build : kBuilds) {
    for (const int size : kMapSizes) {
      std::vector<std::string> row{build, std::to_string(size)};
      for (std::size_t start = 0; start < std::size(kStarts); ++start, index += 2) {
        row.push_back(value(comparison.variants[index]) + " / " + value(comparison.variants[index + 1]));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Result<std::string> pictures(measure::EngineSession& session, const PaperOptions& options,
                             measure::Json& json) {
  std::vector<Variant> variants;
  for (const int start : kStarts) {
    variants.push_back(variantOf("gpu", 512, start, 6));
    variants.back().label = "start 1/" + std::to_string(start);
  }
  variants.push_back({"signed (two-sided)", {"shadow-width", {}}});
  PaperOptions untimed = options;
  untimed.repetitions = 0;
  auto comparison = compare(session, kScene, variants, untimed);
  if (!comparison) return comparison.error();
  json["comparisons"].push_back({{"figure", "start differences"}, {"result", toJson(*comparison)}});
  return picturesOf(*comparison);
}
}  // namespace

Result<PaperResult> shadowWidth2003(measure::EngineSession& session, const PaperOptions& options) {
  PaperResult result;
  result.section.title = "Kirsch, Döllner 2003: shadow-width maps";
  result.json = {{"paper", "Kirsch, Doellner 2003"}, {"comparisons", measure::Json::array()}};
  const std::vector<Variant> variants = tableVariants();
  Available available = availableOf(session, variants);
  if (!available.leftOut.empty()) {
    available.leftOut.resize(1);  // one setting or the technique is missing in all of them
    noteLeftOut(result.section, available.leftOut);
    return result;
  }
  PaperOptions coarse = options;  // 48 configurations, told apart by their times
  coarse.samples = std::min(options.samples, 256);
  auto comparison = compare(session, kScene, variants, coarse);
  if (!comparison) return comparison.error();
  std::vector<std::string>& blocks = result.section.blocks;
  blocks.push_back(report::headingHtml("Table 1: frames per second"));
  blocks.push_back(report::tableHtml(tableOf(
      *comparison,
      "Depth map and width map are made anew in every frame. Each cell: three / six neighbours compared. "
      "The start difference 1/n bounds penumbrae to about n texels, and the number of passes. Scene: " +
          std::string(kScene) + ", " + conditionsText(options),
      [](const ComparedVariant& v) { return rate(v.times.frame.medianMs); })));
  blocks.push_back(report::headingHtml("Time of the map passes, ms"));
  blocks.push_back(report::tableHtml(
      tableOf(*comparison, "Depth map, occlusion map and width map, each pass waited for.",
              [](const ComparedVariant& v) { return report::threeDigits(v.times.lightPasses.medianMs); })));
  blocks.push_back(report::headingHtml("Penumbra RMSE"));
  blocks.push_back(report::tableHtml(
      tableOf(*comparison, "Against ray-traced visibility; the paper gives no errors.",
              [](const ComparedVariant& v) { return report::fixed(v.measurement.error.penumbra.rmse, 3); })));
  result.json["comparisons"].push_back({{"figure", "table 1"}, {"result", toJson(*comparison)}});
  auto cards = pictures(session, options, result.json);
  if (!cards) return cards.error();
  blocks.push_back(report::errorLegend());
  blocks.push_back(*cards);
  return result;
}

}  // namespace halfshadow::papers
