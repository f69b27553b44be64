// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Aligned columns on standard output.
#pragma once

#include <string>
#include <vector>

namespace halfshadow::cli {

/// First column left-aligned, the others right-aligned unless `leftAligned`.
struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> leftAligned{0};
};

/// Columns are as wide as their widest cell; the last one is never padded.
void print(const TextTable& table);

/// printf("%.*f").
std::string fixedText(double value, int decimals);

}  // namespace halfshadow::cli
