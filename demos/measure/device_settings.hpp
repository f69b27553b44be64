// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Measured choices for a device, read from a device profile: what `halfshadow profile` writes as
/// device.json, and what profiles/devices/ keeps and the tool has in it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "measure/engine_session.hpp"
#include "shipped/profiles.hpp"

namespace halfshadow::measure {

/// Settings of the profile `source`: a file; "auto": the one of profiles/devices/ whose `match.renderer`, a
/// text or one of a list, is part of `renderer`, nothing when none is; "none": nothing. Errors: fileNotFound,
/// fileMalformed (naming the file).
Result<std::vector<Setting>> deviceSettings(const std::string& source, const std::string& renderer);

/// What "auto" does, with other profiles; errors name them by their paths.
Result<std::vector<Setting>> deviceSettingsAmong(std::span<const shipped::File> profiles,
                                                 const std::string& renderer);

}  // namespace halfshadow::measure
