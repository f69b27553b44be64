// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// All techniques, in the order of tables and reports.
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::vector<std::unique_ptr<Technique>> makeAllTechniques();

/// Settings that hold for every technique, then each technique's own.
std::vector<SettingInfo> allSettings(const std::vector<std::unique_ptr<Technique>>& techniques);

/// All shader variants that may be asked for.
std::vector<ShaderFamily> allShaderFamilies(const std::vector<std::unique_ptr<Technique>>& techniques);

}  // namespace halfshadow::techniques
