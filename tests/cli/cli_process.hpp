// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Runs the built binary as its users do: as a process of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace halfshadow::cli_tests {

struct ProcessResult {
  int status = -1;  ///< exit status; 128 + signal for a crash
  std::string output, errors;
};

/// Runs `halfshadow ARGUMENTS…` without a shell.
ProcessResult run(const std::vector<std::string>& arguments);

/// A test with a folder of its own, removed at its end.
class CliTest : public testing::Test {
 protected:
  CliTest();
  ~CliTest() override;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Names of all entries, sorted: what a command left behind.
  std::vector<std::string> files() const;
  /// Runs with `--json -` added. Throws, which fails the test, unless the status is 0 and all output is JSON.
  static nlohmann::json runJson(std::vector<std::string> arguments);

  std::filesystem::path folder_;
};

/// Expects this exit status, a message on standard error that contains all `words`, and no crash.
void expectFailure(const std::vector<std::string>& arguments, int status,
                   const std::vector<std::string>& words);

}  // namespace halfshadow::cli_tests
