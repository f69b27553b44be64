// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Parts of the page that a caller puts together: text, tables, plots, rows of pictures beside the truth.
#pragma once

#include <string>
#include <vector>

#include "measure/measurement.hpp"
#include "scenes/view_command.hpp"

namespace halfshadow::report {

/// The first cell of a row is its name.
struct Table {
  std::string title, note;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

struct Section {
  std::string title;
  std::vector<std::string> blocks;  ///< markup, of the functions below
};

std::string paragraphHtml(const std::string& text);
std::string headingHtml(const std::string& text);
/// Without its title.
std::string tableHtml(const Table& table);
/// `svg` of scatterSvg or lineSvg; empty stays empty.
std::string plotHtml(const std::string& svg, const std::string& note);

/// The command lines that show `view` again, folded up below its picture: in the viewer, beside the truth
/// where the picture is of visibility, and by `halfshadow render`.
enum class PictureKind { shaded, visibility };
std::string viewCommandsHtml(const scenes::ViewCommand& view, PictureKind kind);

/// One picture beside the truth.
struct ComparedPicture {
  std::string title;
  scenes::ViewCommand view;
  const measure::TechniqueMeasurement* measurement = nullptr;  ///< measured
  std::string numbers{};                                       ///< below the pictures
};
/// A row of cards: the truth, then each technique's visibility above its error map. Errors: invalidArgument
/// (an image is not of the truth's size).
Result<std::string> comparisonHtml(const measure::Truth& truth, const std::vector<ComparedPicture>& pictures);
/// What the colours of error maps mean.
std::string errorLegend();

/// Median with three digits; "–" when nothing was timed.
std::string timeText(const measure::TimeStatistics& time);

std::string sectionHtml(const Section& section, const std::string& anchor);

}  // namespace halfshadow::report
