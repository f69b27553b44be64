// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Every technique in every case.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "measure/engine_session.hpp"
#include "stress/cases.hpp"
#include "stress/judge.hpp"

namespace halfshadow::stress {

struct Options {
  int width = 96, height = 72;
  int samples = 256;  ///< light points per pixel of the truth
  std::uint64_t seed = 1;
  /// At most so many scenes of each case, chosen by the seed; 0 = all. The case `base` keeps all of its own.
  int variantsPerCase = 0;
  std::vector<measure::Setting> settings{};
  std::filesystem::path dumpFolder{};  ///< empty = none
  /// Stage and share done, 0 … 1. May be empty.
  std::function<void(const std::string& stage, double share)> progress{};
};

/// One technique in one variant.
struct VariantResult {
  std::string variant;
  Judgement judgement;
  Errors errors, base, hard;  ///< `base`: as far as the rule compares with one
  double jump = 0.0;          ///< steady: see jumpBeyondTruth
  double changed = 0.0;       ///< restated: see changeBetween
  std::string fellBack;       ///< what the frame's report says
};

/// One technique in one case: its gravest variant.
struct Cell {
  std::string technique;
  std::vector<VariantResult> variants;   ///< empty where the case asks nothing of it
  const VariantResult& gravest() const;  ///< ok when there are none
};

struct CaseResult {
  std::string name, what;
  Rule rule = Rule::own;
  std::vector<std::string> variants;
  double noiseRmse = 0.0;   ///< largest, of one truth image
  std::vector<Cell> cells;  ///< one per column of the table
};

struct Table {
  std::vector<std::string> techniques;  ///< columns; the last is `reference`
  std::vector<CaseResult> cases;
  std::size_t count(Verdict verdict) const;
};

/// The column of the ray tracer itself: its own picture of the variant where the answer is a closed form or
/// the truth of the base scene; nothing is asked of it elsewhere.
inline constexpr const char* kReferenceColumn = "reference";

/// Techniques that draw shadows: all of the engine's but `none`, whose answer is "lit" whatever the scene.
std::vector<std::string> shadowTechniques(measure::EngineSession& session);

/// A renewed engine for each picture, so that a cell is the same whatever was asked before. What a technique
/// cannot do is a verdict. Errors: those of tracing, unknownSetting, invalidArgument, and of files.
Result<Table> run(measure::EngineSession& session, const std::vector<Case>& cases,
                  const std::vector<std::string>& techniques, const Options& options);

}  // namespace halfshadow::stress
