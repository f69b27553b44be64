// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// CPU time of the silhouette lists that fragments walk, with all that planning them takes, for a light that
/// moves each frame: of built-in scenes, and of glTF files named on the command line.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "plan_rig.hpp"
#include "scenes/builtin_scenes.hpp"
#include "scenes/gltf_loader.hpp"
#include "scenes/scene_source.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow::test {
namespace {

Result<scene::SceneDescription> sceneOf(const std::string& source) {
  auto scene = source.ends_with(".glb") || source.ends_with(".gltf") ? scenes::loadGltf(source, {})
                                                                     : scenes::makeBuiltinScene(source);
  if (scene) {
    if (const Status status = scenes::completeScene(*scene, {}); !status) return status.error();
  }
  return scene;
}

void moveLight(benchmark::State& state, const std::string& source, const std::string& id) {
  const auto scene = sceneOf(source);
  if (!scene) return state.SkipWithError(scene.error().message.c_str());
  for (const auto& technique : techniques::makeAllTechniques()) {
    if (technique->info().id != id) continue;
    std::vector<techniques::SettingInfo> settings = techniques::commonSettings();
    for (techniques::SettingInfo& info : technique->settings()) settings.push_back(std::move(info));
    PlanRig rig(*scene, capabilitiesWithout({}), std::move(settings));
    const auto planner = technique->newPlanner();
    std::size_t bytes = 0;
    for (auto unused : state) {
      state.PauseTiming();
      rig.moveLight();
      const techniques::LightScene& light = rig.prepare(0);
      Planned planned;
      state.ResumeTiming();
      planned.status = planner->plan(light, planned.plan);
      state.PauseTiming();
      if (!planned.status) state.SkipWithError(planned.status.error().message.c_str());
      bytes = 0;
      for (const techniques::PlannedTexture& texture : planned.plan.textures)
        bytes += 4u * static_cast<std::size_t>(texture.desc.width * texture.desc.height);
      planned = {};
      state.ResumeTiming();
    }
    state.counters["texture_bytes"] = static_cast<double>(bytes);
  }
}

}  // namespace
}  // namespace halfshadow::test

int main(int count, char** arguments) {
  std::vector<std::string> sources{"spheres27", "mannequin"};
  benchmark::Initialize(&count, arguments);
  for (int k = 1; k < count; ++k) sources.emplace_back(arguments[k]);
  for (const std::string& source : sources) {
    for (const std::string id : {"wedges-cells", "wedges-blended"}) {
      benchmark::RegisterBenchmark((id + "/" + source).c_str(), [=](benchmark::State& state) {
        halfshadow::test::moveLight(state, source, id);
      })->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
}
