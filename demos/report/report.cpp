// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/report.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <utility>

#include "measure/text_file.hpp"
#include "report/html.hpp"
#include "report/scene_section.hpp"

namespace halfshadow::report {
namespace {

std::string sceneAnchor(std::size_t index) {
  return "scene-" + std::to_string(index + 1);
}

std::string sectionAnchor(std::size_t index) {
  return "section-" + std::to_string(index + 1);
}

std::string header(const Report& report) {
  std::string html = "<h1>" + escaped(report.title) + "</h1>\n<p>" + escaped(report.introduction) + "</p>\n";
  html +=
      "<p class=\"soft\">\"Open this view\" below a picture holds two command lines: one shows it in the "
      "viewer, where it can be moved, the other makes it again. Both programs are in the build's folder bin; "
      "files are named as they were when this page was made.</p>\n";
  const Device& device = report.device;
  html += "<dl class=\"facts\">";
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, const std::string&>>{
           {"Device", device.renderer},
           {"Vendor", device.vendor},
           {"Driver", device.version},
           {"Shadow map storage", device.depthStorage},
           {"8-bit rounding", device.byteRounding}}) {
    if (!value.empty()) html += "<dt>" + std::string(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
  }
  html += "</dl>\n<nav>";
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    html += "<a href=\"#" + sceneAnchor(i) + "\">" + escaped(report.scenes[i].title) + "</a>";
  }
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    html += "<a href=\"#" + sectionAnchor(i) + "\">" + escaped(report.sections[i].title) + "</a>";
  }
  return html + "</nav>\n";
}

/// Techniques × scenes: penumbra RMSE and time.
std::string overview(const Report& report) {
  std::vector<std::string> names;
  std::map<std::string, std::map<std::size_t, const measure::TechniqueMeasurement*>> byName;
  for (std::size_t s = 0; s < report.scenes.size(); ++s) {
    const auto labels = configurationLabels(report.scenes[s].techniques);
    for (std::size_t t = 0; t < labels.size(); ++t) {
      if (byName[labels[t]].empty()) names.push_back(labels[t]);
      byName[labels[t]][s] = &report.scenes[s].techniques[t];
    }
  }
  std::string html =
      "<h2>Overview</h2>\n<p class=\"soft\">Penumbra RMSE of visibility, and below it the time of a "
      "dynamic frame. The best error of a scene is green.</p>\n<div class=\"card scroll\"><table><thead>";
  std::vector<Cell> head{{"technique"}};
  for (const SceneReport& scene : report.scenes) head.push_back({escaped(scene.title)});
  html += tableRow(head, "th") + "</thead><tbody>\n";
  for (const std::string& name : names) {
    std::vector<Cell> row{{escaped(name)}};
    for (std::size_t s = 0; s < report.scenes.size(); ++s) {
      const auto found = byName[name].find(s);
      if (found == byName[name].end() || !found->second->measured()) {
        row.push_back({"–"});
        continue;
      }
      double best = 2.0;
      for (const auto& other : report.scenes[s].techniques) {
        if (other.measured()) best = std::min(best, other.error.penumbra.rmse);
      }
      const double rmse = found->second->error.penumbra.rmse;
      const measure::TimeStatistics& time = found->second->time;
      row.push_back({fixed(rmse, 4) +
                         (time.frames > 0 ? "<br><small>" + threeDigits(time.medianMs) + " ms</small>" : ""),
                     rmse <= best ? "best" : ""});
    }
    html += tableRow(row);
  }
  return html + "</tbody></table></div>\n";
}

std::string ownText(const char* text) {
  return text == nullptr ? std::string() : std::string(text);
}

}  // namespace

Device deviceOf(const DriverRecord& driver) {
  return {ownText(driver.vendor), ownText(driver.renderer), ownText(driver.version),
          ownText(driver.depthStorage), ownText(driver.byteRounding)};
}

Result<std::string> reportHtml(const Report& report) {
  std::string html = pageHead(report.title) + header(report);
  if (report.scenes.size() > 1) html += overview(report);
  for (const Table& table : report.tables)
    html += "<h2>" + escaped(table.title) + "</h2>\n" + tableHtml(table);
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    auto section = sceneSection(report.scenes[i], sceneAnchor(i));
    if (!section) return section.error();
    html += *section;
  }
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    html += sectionHtml(report.sections[i], sectionAnchor(i));
  }
  return html + "</main>\n</body>\n</html>\n";
}

Status writeReport(const std::filesystem::path& path, const Report& report) {
  auto html = reportHtml(report);
  if (!html) return html.error();
  return measure::writeTextFile(path, *html);
}

}  // namespace halfshadow::report
