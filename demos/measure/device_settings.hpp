// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Measured choices for a device, read from a device profile: what `halfshadow profile` writes as
/// device.json, and what profiles/devices/ keeps.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "measure/engine_session.hpp"

namespace halfshadow::measure {

/// Settings of the profile `source`: a file; "auto": the one of profiles/devices/ whose `match.renderer`, a
/// text or one of a list, is part of `renderer`, nothing when none is; "none": nothing. Errors: fileNotFound,
/// fileMalformed (naming the file).
Result<std::vector<Setting>> deviceSettings(const std::string& source, const std::string& renderer);

/// What "auto" does, with the profiles of another folder.
Result<std::vector<Setting>> deviceSettingsIn(const std::string& folder, const std::string& renderer);

}  // namespace halfshadow::measure
