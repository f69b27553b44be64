// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Text of the report's page: escaping, numbers, style sheet.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace halfshadow::report {

/// Safe between tags and in quoted attributes.
std::string escaped(std::string_view text);
/// Fixed decimals; "–" when not finite.
std::string fixed(double value, int decimals);
/// Three significant digits, for times.
std::string threeDigits(double value);
/// "1.4 MB", "310 kB", "12 B" (powers of 1000).
std::string byteText(std::uint64_t bytes);
/// "1,234".
std::string counted(std::uint64_t value);

/// A table cell: text that is markup already, and a class ("" for none).
struct Cell {
  std::string html;
  std::string className{};
};
std::string tableRow(const std::vector<Cell>& cells, std::string_view tag = "td");

/// An image with its caption.
std::string figureHtml(const std::string& uri, const std::string& caption, int width, int height);

/// Everything up to and with <body>.
std::string pageHead(std::string_view title);

}  // namespace halfshadow::report
