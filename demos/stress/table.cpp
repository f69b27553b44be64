// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress/table.hpp"

namespace halfshadow::stress {
namespace {
using measure::Json;

constexpr Verdict kVerdicts[] = {Verdict::ok, Verdict::fellBack, Verdict::refused, Verdict::worse,
                                 Verdict::wrong};

Json toJson(const Errors& errors) {
  return {{"mae", errors.mae},
          {"max", errors.worst},
          {"penumbra_rmse", errors.penumbraRmse},
          {"rmse_beyond_pixel", errors.rmseBeyondPixel},
          {"false_share", errors.falseShare},
          {"pixels", errors.judged},
          {"penumbra_pixels", errors.penumbra}};
}

Json toJson(const VariantResult& result, Rule rule) {
  Json json{{"variant", result.variant}, {"verdict", verdictText(result.judgement.verdict)}};
  if (!result.judgement.reason.empty()) json["reason"] = result.judgement.reason;
  if (!result.fellBack.empty()) json["fell_back"] = result.fellBack;
  if (result.judgement.verdict == Verdict::refused) return json;
  json["error"] = toJson(result.errors);
  if (sharesTruth(rule) || rule == Rule::own) json["error_base_scene"] = toJson(result.base);
  if (rule == Rule::restated) json["change_p999"] = result.changed;
  if (rule == Rule::steady) {
    json["jump_beyond_truth_p999"] = result.jump;
  } else {
    json["error_hard_shadows"] = toJson(result.hard);
  }
  return json;
}
}  // namespace

std::vector<std::vector<std::string>> summaryRows(const Table& table) {
  std::vector<std::vector<std::string>> rows(2, {""});
  for (const std::string& id : table.techniques) {
    const std::size_t hyphen = id.find('-');
    rows[0].push_back(hyphen == std::string::npos ? "" : id.substr(0, hyphen + 1));
    rows[1].push_back(hyphen == std::string::npos ? id : id.substr(hyphen + 1));
  }
  for (const CaseResult& c : table.cases) {
    std::vector<std::string> row{c.name};
    for (const Cell& cell : c.cells)
      row.emplace_back(cell.variants.empty() ? "-" : verdictText(cell.gravest().judgement.verdict));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::string> remarks(const Table& table) {
  std::vector<std::string> lines;
  for (const CaseResult& c : table.cases) {
    for (const Cell& cell : c.cells) {
      for (const VariantResult& v : cell.variants) {
        if (v.judgement.verdict == Verdict::ok) continue;
        lines.push_back(c.name + "/" + v.variant + " " + cell.technique + ": " +
                        verdictText(v.judgement.verdict) + ": " + v.judgement.reason);
      }
    }
  }
  return lines;
}

std::string countsText(const Table& table) {
  std::string text;
  for (const Verdict verdict : kVerdicts) {
    text += (text.empty() ? "" : ", ") + std::to_string(table.count(verdict)) + " " + verdictText(verdict);
  }
  return text;
}

Json toJson(const Table& table, const Options& options, const DriverRecord& driver) {
  Json json{{"driver", measure::driverJson(driver)},
            {"size", {options.width, options.height}},
            {"samples", reference::tracedSamples(options.samples)},
            {"seed", options.seed},
            {"techniques", table.techniques}};
  json["counts"] = Json::object();
  for (const Verdict verdict : kVerdicts) json["counts"][verdictText(verdict)] = table.count(verdict);
  json["cases"] = Json::array();
  for (const CaseResult& c : table.cases) {
    Json cells = Json::array();
    for (const Cell& cell : c.cells) {
      if (cell.variants.empty()) continue;
      Json variants = Json::array();
      for (const VariantResult& v : cell.variants) variants.push_back(toJson(v, c.rule));
      cells.push_back({{"technique", cell.technique},
                       {"verdict", verdictText(cell.gravest().judgement.verdict)},
                       {"variants", std::move(variants)}});
    }
    json["cases"].push_back({{"name", c.name},
                             {"what", c.what},
                             {"judged", ruleText(c.rule)},
                             {"noise_rmse", c.noiseRmse},
                             {"cells", std::move(cells)}});
  }
  return json;
}

}  // namespace halfshadow::stress
