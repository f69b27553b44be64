// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/html.hpp"

#include <cmath>
#include <cstdio>

namespace halfshadow::report {
namespace {

constexpr std::string_view kStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #f6f7f9; --card: #ffffff; --ink: #1b2330; --soft: #5d6878; --line: #dde2e9; --accent: #2b62c4;
  --good: #1d7a4b; --bad: #b3372f; --front: #c2740a;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #12151a; --card: #1a1f27; --ink: #e6eaf0; --soft: #98a3b3; --line: #2d3540; --accent: #7aa7f7;
    --good: #63c996; --bad: #f0867c; --front: #f0b04a;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif;
}
main { max-width: 1240px; margin: 0 auto; padding: 40px 24px 80px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 8px; letter-spacing: -0.01em; }
h2 { font-size: 22px; margin: 56px 0 4px; letter-spacing: -0.01em; }
h3 { font-size: 16px; margin: 32px 0 10px; }
p { margin: 6px 0; max-width: 78ch; }
.soft { color: var(--soft); }
nav { margin: 18px 0 0; display: flex; flex-wrap: wrap; gap: 8px; }
nav a {
  color: var(--ink); text-decoration: none; padding: 4px 12px; border: 1px solid var(--line); border-radius: 99px;
  background: var(--card);
}
nav a:hover { border-color: var(--accent); }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 16px; }
dl.facts { display: grid; grid-template-columns: max-content 1fr; gap: 2px 18px; margin: 20px 0 0; }
dl.facts dt { color: var(--soft); }
dl.facts dd { margin: 0; overflow-wrap: anywhere; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); gap: 16px; margin-top: 16px; }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(360px, 1fr)); gap: 16px; margin-top: 16px; }
.strip { display: grid; grid-template-columns: repeat(var(--columns), minmax(0, 1fr)); gap: 14px; margin: 14px 0; }
@media (max-width: 760px) { .strip { grid-template-columns: 1fr 1fr; } }
.strip .card { padding: 12px; }
.strip h4 { margin: 0 0 8px; font-size: 14px; }
.strip figure { margin-bottom: 8px; }
.strip .numbers { font-size: 13px; font-variant-numeric: tabular-nums; }
figure { margin: 0; }
figure img { display: block; width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); }
figcaption { color: var(--soft); font-size: 13px; margin-top: 6px; }
.technique h4 { margin: 0; font-size: 15px; }
.technique .settings { color: var(--soft); font-size: 12.5px; min-height: 19px; overflow-wrap: anywhere; }
.technique .two { display: grid; grid-template-columns: 1fr 1fr; gap: 8px; margin: 10px 0 8px; }
.technique .two figcaption { font-size: 12px; margin-top: 3px; }
.technique .numbers { font-size: 13.5px; font-variant-numeric: tabular-nums; }
.legend { display: flex; align-items: center; gap: 10px; font-size: 13px; color: var(--soft); margin: 14px 0 0; }
.legend i { display: block; width: 220px; height: 12px; border-radius: 6px; border: 1px solid var(--line); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 13.5px; font-variant-numeric: tabular-nums; }
th { text-align: right; font-weight: 600; color: var(--soft); padding: 4px 10px; vertical-align: bottom; }
td { text-align: right; padding: 5px 10px; border-top: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child, th.text, td.text { text-align: left; }
td.text { white-space: normal; }
td.best { color: var(--good); font-weight: 650; }
td.front { color: var(--front); font-weight: 650; }
thead tr.groups th { border-bottom: 1px solid var(--line); text-align: center; }
td small { color: var(--soft); }
details { margin-top: 10px; }
.view { margin-top: 6px; font-size: 12.5px; }
.view code {
  display: block; margin: 4px 0; padding: 6px 8px; border: 1px solid var(--line); border-radius: 6px;
  background: var(--page); white-space: pre-wrap; overflow-wrap: anywhere; user-select: all;
}
summary { cursor: pointer; color: var(--accent); padding: 4px 0; }
svg { display: block; width: 100%; height: auto; }
svg text { fill: var(--ink); font: 12.5px system-ui, sans-serif; }
svg .label { paint-order: stroke; stroke: var(--card); stroke-width: 4px; stroke-linejoin: round; }
svg .axis { fill: var(--soft); }
svg .minor { stroke: var(--line); stroke-width: 0.5; }
svg .major { stroke: var(--line); stroke-width: 1; }
svg .front { stroke: var(--front); stroke-width: 1.5; fill: none; stroke-dasharray: 5 4; }
svg .dot { fill: var(--accent); }
svg .dot.on { fill: var(--front); }
svg .curve { stroke: currentColor; stroke-width: 2; fill: none; stroke-linejoin: round; }
svg .point { fill: currentColor; }
svg text.c0, svg text.c1, svg text.c2, svg text.c3, svg text.c4, svg text.c5, svg text.c6, svg text.c7 {
  fill: currentColor; font-weight: 600;
}
.c0 { color: #2b62c4; } .c1 { color: #c2740a; } .c2 { color: #1d7a4b; } .c3 { color: #b3372f; }
.c4 { color: #7a4fc0; } .c5 { color: #0f7f8c; } .c6 { color: #96700c; } .c7 { color: #a83a86; }
@media (prefers-color-scheme: dark) {
  .c0 { color: #7aa7f7; } .c1 { color: #f0b04a; } .c2 { color: #63c996; } .c3 { color: #f0867c; }
  .c4 { color: #b493f0; } .c5 { color: #4fc3cf; } .c6 { color: #d6b04c; } .c7 { color: #e58ac9; }
}
)css";

std::string printed(const char* format, int decimals, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, decimals, value);
  return text;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? printed("%.*f", decimals, value) : "–";
}

std::string threeDigits(double value) {
  if (!std::isfinite(value)) return "–";
  const double magnitude = std::abs(value);
  return printed("%.*f", magnitude >= 100 ? 0 : magnitude >= 10 ? 1 : magnitude >= 1 ? 2 : 3, value);
}

std::string byteText(std::uint64_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " B";
  if (bytes < 1000000) return fixed(static_cast<double>(bytes) / 1e3, bytes < 100000 ? 1 : 0) + " kB";
  return fixed(static_cast<double>(bytes) / 1e6, bytes < 100000000 ? 1 : 0) + " MB";
}

std::string counted(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}

std::string tableRow(const std::vector<Cell>& cells, std::string_view tag) {
  const std::string name(tag);
  std::string row = "<tr>";
  for (const Cell& cell : cells) {
    row += "<" + name + (cell.className.empty() ? "" : " class=\"" + cell.className + "\"") + ">" +
           cell.html + "</" + name + ">";
  }
  return row + "</tr>\n";
}

std::string figureHtml(const std::string& uri, const std::string& caption, int width, int height) {
  return "<figure><img src=\"" + uri + "\" alt=\"" + escaped(caption) + "\" width=\"" +
         std::to_string(width) + "\" height=\"" + std::to_string(height) + "\"><figcaption>" +
         escaped(caption) + "</figcaption></figure>\n";
}

std::string pageHead(std::string_view title) {
  std::string head = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  head +=
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" + escaped(title);
  head += "</title>\n<style>";
  head += kStyle;
  return head + "</style>\n</head>\n<body>\n<main>\n";
}

}  // namespace halfshadow::report
