// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "text_table.hpp"

#include <algorithm>
#include <cstdio>

namespace halfshadow::cli {
namespace {
/// Code points of UTF-8, near enough to columns for the Latin letters in names.
std::size_t columnsOf(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}
}  // namespace

void print(const TextTable& table) {
  std::vector<std::size_t> widths;
  const auto measureRow = [&widths](const std::vector<std::string>& row) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columnsOf(row[i]));
  };
  measureRow(table.header);
  for (const auto& row : table.rows) measureRow(row);
  const auto printRow = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - columnsOf(row[i]), ' ');
      const bool left = std::ranges::find(table.leftAligned, i) != table.leftAligned.end();
      if (i > 0) line += "  ";
      line += left ? row[i] + (i + 1 < row.size() ? padding : "") : padding + row[i];
    }
    std::printf("%s\n", line.c_str());
  };
  if (!table.header.empty()) printRow(table.header);
  for (const auto& row : table.rows) printRow(row);
}

std::string fixedText(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

}  // namespace halfshadow::cli
