// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/section.hpp"

#include "report/html.hpp"
#include "report/picture.hpp"

namespace halfshadow::report {
namespace {
/// More cards stand in two rows.
constexpr std::size_t kMostColumns = 5;
}  // namespace

std::string paragraphHtml(const std::string& text) {
  return "<p>" + escaped(text) + "</p>\n";
}

std::string headingHtml(const std::string& text) {
  return "<h3>" + escaped(text) + "</h3>\n";
}

std::string tableHtml(const Table& table) {
  std::string html;
  if (!table.note.empty()) html += "<p class=\"soft\">" + escaped(table.note) + "</p>\n";
  html += "<div class=\"card scroll\"><table><thead>";
  std::vector<Cell> head;
  for (const std::string& cell : table.header) head.push_back({escaped(cell)});
  html += tableRow(head, "th") + "</thead><tbody>\n";
  for (const auto& cells : table.rows) {
    std::vector<Cell> row;
    for (const std::string& cell : cells) row.push_back({escaped(cell)});
    html += tableRow(row);
  }
  return html + "</tbody></table></div>\n";
}

std::string plotHtml(const std::string& svg, const std::string& note) {
  if (svg.empty()) return {};
  return "<div class=\"card\">" + svg + "</div>\n<p class=\"soft\">" + escaped(note) + "</p>\n";
}

std::string viewCommandsHtml(const scenes::ViewCommand& view, PictureKind kind) {
  const bool isShaded = kind == PictureKind::shaded;
  scenes::ViewCommand inWindow = view;
  // A window is drawn by a driver of the system's own.
  if (view.driver != "llvmpipe" && view.driver != "softpipe") inWindow.driver = "default";
  inWindow.eglLibrary.clear();
  const std::string commands[] = {
      scenes::commandText("halfshadow-viewer", inWindow, isShaded ? "" : "--show visibility --beside truth"),
      scenes::commandText("halfshadow render", view,
                          isShaded ? "-o picture.png" : "--visibility picture.exr")};
  std::string html = "<details class=\"view\"><summary>open this view</summary>";
  for (const std::string& command : commands) html += "<code>" + escaped(command) + "</code>";
  return html + "</details>\n";
}

Result<std::string> comparisonHtml(const measure::Truth& truth,
                                   const std::vector<ComparedPicture>& pictures) {
  const std::vector<std::uint8_t>& receivers = truth.receivers.kind;
  auto reference = visibilityUri(truth.width, truth.height, truth.visibility, receivers);
  if (!reference) return reference.error();
  const std::size_t cards = pictures.size() + 1;
  const std::size_t columns = cards <= kMostColumns ? cards : (cards + 1) / 2;
  std::string html = "<div class=\"strip\" style=\"--columns: " + std::to_string(columns) +
                     "\">\n<div class=\"card\"><h4>reference</h4>\n" +
                     figureHtml(*reference, "visibility", truth.width, truth.height) +
                     "<div class=\"numbers\">" + counted(static_cast<std::uint64_t>(truth.samples)) +
                     " light points a pixel, noise RMSE " + fixed(truth.noiseRmse, 4) + "</div></div>\n";
  for (const ComparedPicture& picture : pictures) {
    const std::vector<float>& measured = picture.measurement->visibility;
    auto visibility = visibilityUri(truth.width, truth.height, measured, receivers);
    if (!visibility) return visibility.error();
    auto errors = errorMapUri(truth.width, truth.height, measured, truth.visibility, receivers);
    if (!errors) return errors.error();
    html += "<div class=\"card\"><h4>" + escaped(picture.title) + "</h4>\n" +
            figureHtml(*visibility, "visibility", truth.width, truth.height) +
            figureHtml(*errors, "difference to the reference", truth.width, truth.height) +
            "<div class=\"numbers\">" + escaped(picture.numbers) + "</div>" +
            viewCommandsHtml(picture.view, PictureKind::visibility) + "</div>\n";
  }
  return html + "</div>\n";
}

std::string errorLegend() {
  return "<div class=\"legend\"><span>too dark, −" + fixed(kErrorMapLimit, 1) +
         "</span><i style=\"background: " + errorMapGradient() + "\"></i><span>+" + fixed(kErrorMapLimit, 1) +
         ", too light</span></div>\n";
}

std::string timeText(const measure::TimeStatistics& time) {
  return time.frames > 0 ? threeDigits(time.medianMs) : "–";
}

std::string sectionHtml(const Section& section, const std::string& anchor) {
  std::string html = "<section id=\"" + anchor + "\"><h2>" + escaped(section.title) + "</h2>\n";
  for (const std::string& block : section.blocks) html += block;
  return html + "</section>\n";
}

}  // namespace halfshadow::report
