// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Eisemann, Décoret, "Plausible image based soft shadows using occlusion textures", 2006: figures 2 and 3.
#include <algorithm>

#include "papers/comparison.hpp"
#include "report/html.hpp"

namespace halfshadow::papers {
namespace {
constexpr const char* kFilters[] = {"mipmap", "sat", "nbuffer"};
constexpr const char* kCombinations[] = {"max", "sum", "product"};
constexpr int kMapSizes[] = {256, 512};

Variant variantOf(const std::string& label, std::vector<measure::Setting> settings) {
  for (measure::Setting& setting : settings) setting.key = "occlusion-textures." + setting.key;
  return {label, {"occlusion-textures", std::move(settings)}};
}

/// Drawing of the casters, apart from what filters them afterwards.
double slicingMs(const profile::FrameTimes& times) {
  double sum = 0.0;
  for (const profile::PassTime& pass : times.passes) {
    if (pass.lightSpace && pass.name.find(" slices ") != std::string::npos) sum += pass.medianMs;
  }
  return sum;
}

/// Mipmaps are made when the slices' pass ends, so that their prefilter is what the maps take beyond the
/// slicing of the N-buffer's run, whose draws are the same.
double prefilterMs(const Comparison& comparison, std::size_t index, std::size_t nbufferIndex) {
  return std::max(0.0, comparison.variants[index].times.lightPasses.medianMs -
                           slicingMs(comparison.variants[nbufferIndex].times));
}

Result<report::Table> addFilters(measure::EngineSession& session, const std::string& preset,
                                 const PaperOptions& options, report::Section& section, measure::Json& json) {
  std::vector<Variant> variants;
  for (const int size : kMapSizes) {
    for (const char* filter : kFilters) {
      variants.push_back(
          variantOf(std::string(filter) + " " + std::to_string(size),
                    {{"preset", preset}, {"filter", filter}, {"map_size", std::to_string(size)}}));
    }
  }
  const Available available = availableOf(session, variants);
  noteLeftOut(section, available.leftOut);
  auto comparison = compare(session, "builtin:leaves@light=1", available.variants, options);
  if (!comparison) return comparison.error();
  report::Table table{
      .note = "Prefilter: time of the map passes without drawing the slices. Frame: light moving.",
      .header = {"preset " + preset, "map", "penumbra RMSE", "on the ground", "p99", "largest",
                 "prefilter ms", "frame ms", "of which receivers"}};
  const std::size_t filters = std::size(kFilters);
  const bool complete = available.leftOut.empty();
  measure::Json entry = toJson(*comparison);
  for (std::size_t i = 0; i < comparison->variants.size(); ++i) {
    const ComparedVariant& variant = comparison->variants[i];
    const auto& error = variant.measurement.error.penumbra;
    std::string prefilter = "–";
    if (complete && variant.times.frame.frames > 0) {
      const double ms = prefilterMs(*comparison, i, i / filters * filters + filters - 1);
      prefilter = report::threeDigits(ms);
      entry["variants"][i]["prefilter_ms"] = ms;
    }
    const std::size_t space = variant.variant.label.find(' ');
    table.rows.push_back(
        {variant.variant.label.substr(0, space), variant.variant.label.substr(space + 1),
         report::fixed(error.rmse, 4), report::fixed(variant.measurement.errorOnGround.penumbra.rmse, 4),
         report::fixed(error.p99, 3), report::fixed(error.max, 2), prefilter,
         report::timeText(variant.times.frame), report::timeText(variant.times.receiverPasses)});
  }
  json["comparisons"].push_back({{"figure", "2"}, {"preset", preset}, {"result", std::move(entry)}});
  for (std::size_t first = 0; first < comparison->variants.size(); first += filters) {
    auto pictures = picturesOf(*comparison, first, std::min(filters, comparison->variants.size() - first));
    if (!pictures) return pictures.error();
    section.blocks.push_back(*pictures);
  }
  return table;
}

Status addCombinations(measure::EngineSession& session, const std::string& source,
                       const PaperOptions& options, report::Section& section, measure::Json& json) {
  std::vector<Variant> variants;
  for (const char* combine : kCombinations) {
    variants.push_back(
        variantOf(combine, {{"preset", "paper"}, {"filter", "nbuffer"}, {"combine", combine}}));
  }
  variants.push_back(variantOf("tuned (first hits, summed)", {{"preset", "tuned"}}));
  const Available available = availableOf(session, variants);
  noteLeftOut(section, available.leftOut);
  PaperOptions untimed = options;
  untimed.repetitions = 0;
  auto comparison = compare(session, source, available.variants, untimed);
  if (!comparison) return comparison.error();
  auto pictures = picturesOf(*comparison);
  if (!pictures) return pictures.error();
  section.blocks.push_back(report::paragraphHtml(source));
  section.blocks.push_back(*pictures);
  json["comparisons"].push_back({{"figure", "3"}, {"result", toJson(*comparison)}});
  return {};
}
}  // namespace

Result<PaperResult> occlusionTextures2006(measure::EngineSession& session, const PaperOptions& options) {
  PaperResult result;
  result.section.title = "Eisemann, Décoret 2006: occlusion textures";
  result.json = {{"paper", "Eisemann, Decoret 2006"}, {"comparisons", measure::Json::array()}};
  std::vector<std::string>& blocks = result.section.blocks;
  blocks.push_back(report::headingHtml("Figure 2: filtering methods"));
  blocks.push_back(report::paragraphHtml(
      "Hardware mipmaps, summed-area tables and N-buffers at two map sizes, as published (binary slices, "
      "multiplied) and tuned. Scene: builtin:leaves@light=1, " +
      conditionsText(options)));
  blocks.push_back(report::errorLegend());
  for (const char* preset : {"paper", "tuned"}) {
    auto table = addFilters(session, preset, options, result.section, result.json);
    if (!table) return table.error();
    blocks.push_back(report::tableHtml(*table));
  }
  blocks.push_back(report::headingHtml("Figure 3: maximum, sum, and the paper's product"));
  for (const char* source : {"builtin:bars@light=1", "builtin:spheres27@light=1"}) {
    if (Status s = addCombinations(session, source, options, result.section, result.json); !s)
      return s.error();
  }
  return result;
}

}  // namespace halfshadow::papers
