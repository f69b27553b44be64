// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "cli_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace halfshadow::cli_tests {
namespace {
std::filesystem::path freshFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "halfshadow-cli-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) ADD_FAILURE() << "cannot make a temporary folder";
  return name;
}

std::string contentOf(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}
}  // namespace

ProcessResult run(const std::vector<std::string>& arguments) {
  const std::filesystem::path folder = freshFolder();
  const std::string output = folder / "out", errors = folder / "err";
  std::vector<std::string> words{HALFSHADOW_CLI};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t child = 0;
  ProcessResult result;
  int state = 0;
  if (posix_spawn(&child, HALFSHADOW_CLI, &actions, nullptr, argv.data(), environ) == 0 &&
      waitpid(child, &state, 0) == child) {
    result.status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
  }
  posix_spawn_file_actions_destroy(&actions);
  result.output = contentOf(output);
  result.errors = contentOf(errors);
  std::filesystem::remove_all(folder);
  return result;
}

CliTest::CliTest() : folder_(freshFolder()) {}
CliTest::~CliTest() {
  std::filesystem::remove_all(folder_);
}

std::vector<std::string> CliTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    names.push_back(std::filesystem::relative(entry.path(), folder_).string());
  }
  std::ranges::sort(names);
  return names;
}

nlohmann::json CliTest::runJson(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const ProcessResult result = run(arguments);
  if (result.status != 0)
    throw std::runtime_error("exit status " + std::to_string(result.status) + ": " + result.errors);
  nlohmann::json json = nlohmann::json::parse(result.output, nullptr, false);
  if (json.is_discarded()) throw std::runtime_error("standard output holds more than JSON: " + result.output);
  return json;
}

void expectFailure(const std::vector<std::string>& arguments, int status,
                   const std::vector<std::string>& words) {
  std::string line = "halfshadow";
  for (const std::string& argument : arguments) line += " '" + argument + "'";
  SCOPED_TRACE(line);
  const ProcessResult result = run(arguments);
  EXPECT_EQ(result.status, status) << result.errors;
  EXPECT_TRUE(result.errors.find("halfshadow: ") != std::string::npos) << result.errors;
  EXPECT_EQ(result.output, "");
  for (const std::string& word : words) {
    EXPECT_NE(result.errors.find(word), std::string::npos) << "no \"" << word << "\" in: " << result.errors;
  }
}

}  // namespace halfshadow::cli_tests
