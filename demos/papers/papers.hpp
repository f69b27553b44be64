// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The comparisons that the implemented papers print, done again: each becomes a section of the report and a
/// JSON object. Techniques and settings that this build or device lacks are named and left out.
#pragma once

#include <string>

#include "measure/measurement_json.hpp"
#include "report/section.hpp"
#include "scenes/view_command.hpp"

namespace halfshadow::papers {

struct PaperOptions {
  int width = 320, height = 240;
  int samples = 1024;   ///< light points per pixel of the truth
  int repetitions = 3;  ///< timed frames of each configuration
  /// A .gltf or .glb file that joins the built-in scenes; may be empty.
  std::string model{};
  /// Driver, device profile and what is forced off: the words that the page's command lines repeat.
  scenes::ViewCommand device{};
  measure::Progress progress{};
};

struct PaperResult {
  report::Section section;
  measure::Json json;  ///< {"paper", "comparisons": […]}
};

/// Eisemann and Décoret 2006: prefilters (figure 2), combination of slices (figure 3).
Result<PaperResult> occlusionTextures2006(measure::EngineSession& session, const PaperOptions& options);
/// Kirsch and Döllner 2003: frame rates (table 1).
Result<PaperResult> shadowWidth2003(measure::EngineSession& session, const PaperOptions& options);
/// Forest, Barthe, Paulin 2006: blended penumbrae (figures 1 and 2), cost over spheres (figure 12).
Result<PaperResult> penumbraWedges2006(measure::EngineSession& session, const PaperOptions& options);

}  // namespace halfshadow::papers
