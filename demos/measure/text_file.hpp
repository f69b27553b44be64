// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Text files written whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"

namespace halfshadow::measure {

/// Pipes and devices, and names such as /dev/stdout that may lead to a file: renaming would replace the name.
bool isSpecial(const std::filesystem::path& path);

/// Writes beside the target and renames into place; devices and pipes (/dev/stdout) are written directly.
/// Errors: fileNotWritable.
Status writeTextFile(const std::filesystem::path& path, const std::string& text);

/// Proves, before expensive work, that `path` can be written later: its folder exists and takes new files,
/// and it is not a folder itself. Leaves nothing behind. Errors: fileNotWritable.
Status checkWritable(const std::filesystem::path& path);

}  // namespace halfshadow::measure
