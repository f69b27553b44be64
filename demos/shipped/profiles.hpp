// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The files of profiles/, compiled in: the tool finds its suites, device profiles and compiled counts
/// wherever it is copied or installed.
#pragma once

#include <span>
#include <string_view>

namespace halfshadow::shipped {

struct File {
  std::string_view path;  ///< below profiles/: "benchmarks/quick.json"
  std::string_view text;
};

/// All of them, by path; of `folder` below profiles/ alone, such as "devices", when one is named.
std::span<const File> profiles(std::string_view folder = {});
/// One by its path, or null.
const File* profile(std::string_view path);

}  // namespace halfshadow::shipped
