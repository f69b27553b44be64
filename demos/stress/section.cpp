// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress/section.hpp"

#include <cstdio>

#include "stress/table.hpp"

namespace halfshadow::stress {

report::Section section(const Table& table, const Options& options) {
  report::Section result{.title = "Stress: scenes that break soft shadows", .blocks = {}};
  const std::string bound =
      options.variantsPerCase > 0
          ? " Scenes of each case, chosen by the seed: " + std::to_string(options.variantsPerCase) +
                "; halfshadow stress draws all of them."
          : "";
  result.blocks.push_back(report::paragraphHtml(
      "Each technique in scenes that the world brings and laboratories do not, " +
      std::to_string(options.width) + "x" + std::to_string(options.height) + " pixels, seed " +
      std::to_string(options.seed) +
      ". The gravest verdict of a case's scenes stands in its cell: ok: as in an ordinary scene; fell back: "
      "worse, and the frame's report says why; worse: a larger error than in an ordinary scene; WRONG: worse "
      "than hard shadows, or not what a closed form says." +
      bound + " " + countsText(table) + "."));

  report::Table verdicts{.title = "", .note = "", .header = {"case"}, .rows = {}};
  verdicts.header.insert(verdicts.header.end(), table.techniques.begin(), table.techniques.end());
  const auto rows = summaryRows(table);
  verdicts.rows.assign(rows.begin() + 2, rows.end());  // behind the two of the text's head
  result.blocks.push_back(report::tableHtml(verdicts));

  report::Table meanings{
      .title = "", .note = "", .header = {"case", "what", "judged", "noise of the truth"}, .rows = {}};
  for (const CaseResult& c : table.cases) {
    char noise[16];
    std::snprintf(noise, sizeof noise, "%.4f", c.noiseRmse);
    meanings.rows.push_back({c.name, c.what, ruleText(c.rule), noise});
  }
  result.blocks.push_back(report::headingHtml("The cases"));
  result.blocks.push_back(report::tableHtml(meanings));

  report::Table missed{
      .title = "", .note = "", .header = {"case", "scene", "technique", "verdict", "why"}, .rows = {}};
  for (const CaseResult& c : table.cases) {
    for (const Cell& cell : c.cells) {
      for (const VariantResult& v : cell.variants) {
        if (v.judgement.verdict != Verdict::ok)
          missed.rows.push_back(
              {c.name, v.variant, cell.technique, verdictText(v.judgement.verdict), v.judgement.reason});
      }
    }
  }
  if (!missed.rows.empty()) {
    result.blocks.push_back(report::headingHtml("What is not ok"));
    result.blocks.push_back(report::tableHtml(missed));
  }
  return result;
}

}  // namespace halfshadow::stress
