// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A target without libFuzzer: its seeds, then mutations of them that are the same in every run.
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "mutation.hpp"

extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace halfshadow::fuzz {
namespace {
namespace fs = std::filesystem;
constexpr unsigned kHangSeconds = 60;  ///< a sanitized build on a busy machine stays far below

Input running;  ///< what is being tested
char failurePath[256] = "";

/// Keeps what failed. Only calls that a signal handler may make.
void keepRunning() {
  const int file = open(failurePath, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return;
  std::size_t written = 0;
  while (written < running.size()) {
    const ssize_t step = write(file, running.data() + written, running.size() - written);
    if (step <= 0) break;
    written += static_cast<std::size_t>(step);
  }
  close(file);
  for (const char* const text : {"the input is kept in ", static_cast<const char*>(failurePath), "\n"}) {
    if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
  }
}

void onSignal(int signal) {
  keepRunning();
  if (signal == SIGALRM) {
    constexpr char kText[] = "it takes longer than a minute: a hang\n";
    if (write(STDERR_FILENO, kText, sizeof kText - 1) < 0) _exit(1);
  }
  std::signal(signal, SIG_DFL);
  raise(signal);
}

void watch(const char* name) {
  std::snprintf(failurePath, sizeof failurePath, "failed-%s", name);
  if (__sanitizer_set_death_callback) {
    __sanitizer_set_death_callback(keepRunning);
    for (const int signal : {SIGABRT, SIGALRM}) std::signal(signal, onSignal);
  } else {
    for (const int signal : {SIGABRT, SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
      std::signal(signal, onSignal);
  }
}

void testOne(Input input) {
  // A copy of its own, so that a read behind the end is one behind a block of memory.
  const Bytes exact(input.begin(), input.end());
  running = exact;
  alarm(kHangSeconds);
  target().test(exact);
  alarm(0);
  running = {};
}

struct Arguments {
  std::uint64_t mutations = 20000;
  double seconds = 1e9;
  unsigned seed = 1;
  bool mutates = true;
  std::string seedFolder;
  std::vector<std::string> files;
};

int usage() {
  std::printf(
      "usage: fuzz_%s [--mutations N] [--seconds S] [--seed K] [--write-seeds DIR] [FILE|DIR...]\n"
      "Tests the seeds and N (20000) mutations of them, or until S seconds (no limit) are over; K (1)\n"
      "chooses which. With FILE tests these alone. --write-seeds writes the seeds and tests nothing.\n",
      target().name);
  return 2;
}

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("--")) {
      arguments.files.push_back(word);
      arguments.mutates = false;
      continue;
    }
    if (i + 1 == argc) return false;
    const char* value = argv[++i];
    if (word == "--mutations") {
      arguments.mutations = std::strtoull(value, nullptr, 10);
    } else if (word == "--seconds") {
      arguments.seconds = std::atof(value);
    } else if (word == "--seed") {
      arguments.seed = static_cast<unsigned>(std::strtoul(value, nullptr, 10));
    } else if (word == "--write-seeds") {
      arguments.seedFolder = value;
    } else {
      return false;
    }
  }
  return true;
}

Bytes readFile(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
}

int writeSeeds(const std::string& folder) {
  fs::create_directories(folder);
  int number = 0;
  for (const Bytes& seed : target().seeds()) {
    std::ofstream stream(fs::path(folder) / ("seed-" + std::to_string(number++)), std::ios::binary);
    stream.write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
    if (!stream.flush()) {
      std::fprintf(stderr, "cannot write to %s; choose a folder that you may write to\n", folder.c_str());
      return 1;
    }
  }
  std::printf("%d seeds in %s\n", number, folder.c_str());
  return 0;
}

std::uint64_t replay(const std::vector<std::string>& files) {
  std::uint64_t count = 0;
  for (const std::string& file : files) {
    if (!fs::is_directory(file)) {
      testOne(readFile(file));
      ++count;
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(file)) {
      if (!entry.is_regular_file()) continue;
      testOne(readFile(entry.path()));
      ++count;
    }
  }
  return count;
}

int run(const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  watch(target().name);
  std::uint64_t executions = replay(arguments.files);
  std::vector<Bytes> seeds;
  if (arguments.mutates) {
    seeds = target().seeds();
    require(!seeds.empty(), "it has no seeds");
    for (const Bytes& seed : seeds) {
      require(seed.size() <= target().largestInput, "a seed is larger than its largest input");
      testOne(seed);
      ++executions;
    }
    const Mutator mutator(target());
    Random random(arguments.seed);
    double told = 0.0;
    for (std::uint64_t i = 0; i < arguments.mutations && elapsed() < arguments.seconds; ++i) {
      Bytes input = seeds[random() % seeds.size()];
      mutator.mutate(input, seeds, random);
      testOne(input);
      ++executions;
      if (elapsed() - told < 10.0) continue;
      told = elapsed();
      std::fprintf(stderr, "%s: %llu executions, %.0f s\n", target().name,
                   static_cast<unsigned long long>(executions), told);
    }
  }
  std::printf("{\"target\": \"%s\", \"seeds\": %zu, \"executions\": %llu, \"seconds\": %.2f}\n",
              target().name, seeds.size(), static_cast<unsigned long long>(executions), elapsed());
  return 0;
}

}  // namespace
}  // namespace halfshadow::fuzz

int main(int argc, char** argv) {
  using namespace halfshadow::fuzz;
  Arguments arguments;
  if (!parse(argc, argv, arguments)) return usage();
  return arguments.seedFolder.empty() ? run(arguments) : writeSeeds(arguments.seedFolder);
}
