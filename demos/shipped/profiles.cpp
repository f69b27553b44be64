// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "shipped/profiles.hpp"

#include <algorithm>

namespace halfshadow::shipped {
namespace {

constexpr File kFiles[] = {
#include "shipped_profiles.inc"
};

bool isIn(const File& file, std::string_view folder) {
  return folder.empty() || (file.path.size() > folder.size() && file.path.starts_with(folder) &&
                            file.path[folder.size()] == '/');
}

}  // namespace

std::span<const File> profiles(std::string_view folder) {
  // Sorted by path when embedded: those of a folder stand side by side.
  const auto inFolder = [&](const File& file) { return isIn(file, folder); };
  const auto* const first = std::ranges::find_if(kFiles, inFolder);
  return {first, std::find_if_not(first, std::end(kFiles), inFolder)};
}

const File* profile(std::string_view path) {
  const auto* const found = std::ranges::find(kFiles, path, &File::path);
  return found == std::end(kFiles) ? nullptr : found;
}

}  // namespace halfshadow::shipped
