// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Device profiles and suites of measurements: JSON that users write.
#include "fuzz_target.hpp"
#include "measure/device_settings.hpp"
#include "profile/suite.hpp"
#include "shipped/profiles.hpp"
#include "techniques/registry/registry.hpp"
#include "temporary_file.hpp"

namespace halfshadow::fuzz {
namespace {
template <typename T>
void requireSentence(const Result<T>& result, const std::string& path) {
  if (result) return;
  require(result.error().code == ErrorCode::fileMalformed,
          "an error of another kind: " + result.error().message);
  require(result.error().message.starts_with(path), "an error that does not name the file");
}

void testDevice(const TemporaryFile& file, Input input) {
  const auto given = measure::deviceSettings(file.path(), "llvmpipe");
  const shipped::File among[] = {{file.path(), {reinterpret_cast<const char*>(input.data()), input.size()}}};
  const auto found = measure::deviceSettingsAmong(among, "llvmpipe (LLVM 15.0.6, 256 bits)");
  requireSentence(given, file.path()), requireSentence(found, file.path());
  if (given && found)
    require(found->empty() || found->size() == given->size(), "the same profile gives other settings");
  if (!given) return;
  static const std::vector<techniques::SettingInfo> declared =
      techniques::allSettings(techniques::makeAllTechniques());
  techniques::Settings settings(declared);
  for (const measure::Setting& setting : *given) (void)settings.set(setting.key, setting.value).ok();
}

void testSuite(const TemporaryFile& file) {
  const auto suite = profile::readSuite(file.path());
  requireSentence(suite, file.path());
  if (!suite) return;
  require(suite->width >= 1 && suite->height >= 1 && suite->samples >= 1 && suite->repetitions >= 1,
          "a suite that measures nothing");
  require(!suite->scenes.empty() && !suite->configurations.empty(), "a suite of nothing");
}

void test(Input input) {
  static const TemporaryFile file("input.json");
  file.write(input);
  testDevice(file, input);
  testSuite(file);
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  for (const char* folder : {"devices", "benchmarks"}) {
    for (const shipped::File& file : shipped::profiles(folder))
      if (file.text.size() <= target().largestInput) all.push_back(bytesOf(file.text));
  }
  all.push_back(
      bytesOf(R"({"match":{"renderer":"llvmpipe"},"settings":[{"key":"filter_skip","value":"loop"}]})"));
  all.push_back(bytesOf(
      R"({"name":"n","description":"d","size":[4,3],"samples":1,"repetitions":1,"scenes":["builtin:box",)"
      R"({"label":"b","source":"builtin:box","camera":"eye=0,0,5 target=0,0,0"}],"configurations":[)"
      R"({"technique":"pcf","label":"p","settings":{"pcf.size":"7"}},{"technique":"hard"}],)"
      R"("ratios":[{"of":"p","to":"hard"}],"scene_ratios":[{"configuration":"p","above":"hard",)"
      R"("of":"b","to":"builtin:box"}]})"));
  return all;
}

std::vector<std::string> dictionary() {
  return {"\"match\":",
          "\"renderer\":",
          "\"settings\":",
          "\"key\":",
          "\"value\":",
          "\"size\":",
          "\"samples\":",
          "\"repetitions\":",
          "\"scenes\":",
          "\"configurations\":",
          "\"technique\":",
          "\"ratios\":",
          "\"label\":",
          "\"llvmpipe\"",
          "null",
          "true",
          "[",
          "]",
          "{",
          "}",
          ",",
          "\"",
          "{}",
          "[]",
          "1.5",
          "-1",
          "1e300"};
}
}  // namespace

const Target& target() {
  static const Target made{
      .name = "profiles", .test = test, .seeds = seeds, .dictionary = dictionary, .largestInput = 1 << 14};
  return made;
}

}  // namespace halfshadow::fuzz
