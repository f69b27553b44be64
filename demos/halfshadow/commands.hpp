// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The commands. Each adds its subcommand, whose callback leaves the exit status in `status`.
#pragma once

#include <CLI/CLI.hpp>

#include "output.hpp"

namespace halfshadow::cli {

void addInfoCommand(CLI::App& app, ExitStatus& status);
void addTechniquesCommand(CLI::App& app, ExitStatus& status);
void addScenesCommand(CLI::App& app, ExitStatus& status);
void addRenderCommand(CLI::App& app, ExitStatus& status);
void addReferenceCommand(CLI::App& app, ExitStatus& status);
void addMeasureCommand(CLI::App& app, ExitStatus& status);
void addReportCommand(CLI::App& app, ExitStatus& status);
void addProfileCommand(CLI::App& app, ExitStatus& status);
void addCompareCommand(CLI::App& app, ExitStatus& status);
void addStressCommand(CLI::App& app, ExitStatus& status);
void addValidateCommand(CLI::App& app, ExitStatus& status);

}  // namespace halfshadow::cli
