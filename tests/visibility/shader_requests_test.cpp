// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// No technique asks for a shader variant that it did not declare, whatever its settings and the device: the
// engine refuses those, and what is declared passes the reference compiler (tests/architecture).
#include <algorithm>
#include <random>
#include <sstream>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

/// What a setting is tried at.
std::vector<std::string> valuesOf(const SettingRecord& setting, bool highp) {
  const std::string key = setting.key, type = setting.type, allowed = setting.allowed;
  // Without highp llvmpipe compiles a summed-area filter for half a minute, and more for more slices.
  if (!highp && (key == "occlusion-textures.filter" || key == "occlusion_prefilter")) return {"nbuffer"};
  if (!highp && key == "occlusion-textures.slices") return {setting.defaultValue};
  if (key == "map_size") return {"128", "2048"};
  // How much of a map is drawn again asks for no other shader.
  if (type == "real" || key.ends_with(".tiles") || key == "map_updates") return {setting.defaultValue};
  std::vector<std::string> values;
  if (type == "integer") {
    std::istringstream range(allowed);
    std::string low, to, high;
    range >> low >> to >> high;
    // A thousand maps a frame ask for no other shader than one.
    if (key == "sampled.samples") return {low};
    return {setting.defaultValue, low, high};
  }
  std::istringstream stream(allowed);
  for (std::string value; std::getline(stream >> std::ws, value, ',');) values.push_back(value);
  return values;
}

/// Settings of a technique and those of all, mixed anew from one to the next: each value comes in its turn.
std::vector<Configuration> mixed(Engine& engine, const std::string& technique, std::size_t count,
                                 bool highp) {
  std::mt19937 random(7);
  std::vector<Configuration> configurations(count, Configuration{technique});
  for (std::size_t s = 0; s < engine.settingCount(); ++s) {
    const SettingRecord setting = engine.setting(s);
    const std::string key = setting.key;
    if (key.find('.') != std::string::npos && !key.starts_with(technique + ".")) continue;
    std::vector<std::string> values = valuesOf(setting, highp);
    for (std::size_t i = 0; i < count; ++i) {
      if (i % values.size() == 0) std::shuffle(values.begin(), values.end(), random);
      configurations[i].settings.push_back({key, values[i % values.size()]});
    }
  }
  return configurations;
}

void expectDeclared(const Outcome& outcome, const Configuration& configuration, const char* what) {
  EXPECT_TRUE(outcome.code != ErrorCode::internal && outcome.code != ErrorCode::shaderFailed)
      << configuration.text() << ", " << what << ": " << outcome.message;
}

class ShaderRequests : public EngineTest, public testing::WithParamInterface<const char*> {};

TEST_P(ShaderRequests, AreAllDeclared) {
  SceneRenderer renderer(makeEngine({GetParam()}));
  Engine& engine = renderer.engine();
  // Casters that overlap, open ones, one alone that is convex.
  const char* const scenes[] = {"figure", "sheets", "convex"};
  constexpr std::size_t kEach = 2;
  const bool highp = std::string("highp") != GetParam();
  int frames = 0;
  for (std::size_t s = 0; s < std::size(scenes); ++s) {
    renderer.load(builtinScene(scenes[s]));
    renderer.desc().target.width = 32;
    renderer.desc().target.height = 24;
    for (const std::string& technique : techniquesBut(engine, {})) {
      const auto configurations = mixed(engine, technique, kEach * std::size(scenes), highp);
      for (std::size_t c = kEach * s; c < kEach * (s + 1); ++c) {
        renderer.choose(configurations[c]);
        for (const Output output : {Output::visibility, Output::visibility16, Output::taps, Output::shaded}) {
          FrameReport report;
          renderer.desc().output = output;
          const Outcome outcome = engine.render(renderer.desc(), report);
          expectDeclared(outcome, configurations[c], "a frame");
          frames += outcome.ok();
        }
        ForwardRecord forward;
        expectDeclared(engine.forwardSource(0, forward), configurations[c], "forward");
      }
    }
  }
  EXPECT_GT(frames, 200);
}

INSTANTIATE_TEST_SUITE_P(Without, ShaderRequests,
                         testing::Values("timer-query", "depth-texture", "highp", "derivatives",
                                         "framebuffer-fetch"),
                         [](const auto& without) {
                           std::string name = without.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace halfshadow::test
