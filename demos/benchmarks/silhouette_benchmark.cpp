// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes of all casters of a built-in scene from one point of its light: extracted anew, and with one
/// caster that moves.
#include <benchmark/benchmark.h>

#include <map>

#include "scene/light_silhouettes.hpp"
#include "scenes/builtin_scenes.hpp"

namespace halfshadow {
namespace {
struct Casters {
  scene::SceneDescription description;
  std::map<const scene::TriangleMesh*, scene::HalfEdgeMesh> meshes;
  std::vector<scene::PlacedCaster> placed;
  std::uint64_t triangles = 0;
  scene::LightPlane plane;
};

std::unique_ptr<Casters> castersOf(const char* name) {
  auto casters = std::make_unique<Casters>();
  casters->description = scenes::makeBuiltinScene(name).value();
  for (const scene::SceneObject& object : casters->description.objects) {
    if (!object.casts) continue;
    const auto [mesh, added] = casters->meshes.try_emplace(object.mesh.get());
    if (added) mesh->second = scene::HalfEdgeMesh::build(*object.mesh);
    const auto number = static_cast<std::uint32_t>(casters->placed.size());
    casters->placed.push_back({&mesh->second, object.worldFromObject, number, number + 1u});
    casters->triangles += object.mesh->triangleCount();
  }
  casters->plane = scene::LightPlane(casters->description.lights[0], 12.0, 1e-4);
  return casters;
}

void extractAll(benchmark::State& state, const char* name, scene::LayerSplit split) {
  const auto casters = castersOf(name);
  scene::LightSilhouettes result;
  double source = -0.5;
  for (auto unused : state) {
    scene::lightSilhouettes(casters->placed, casters->plane, source, 0.5, 1e-3, result, split);
    benchmark::DoNotOptimize(result.points.data());
    source = -source;
  }
  state.counters["triangles"] = static_cast<double>(casters->triangles);
  state.counters["tested"] = static_cast<double>(result.counters.facesTested);
  state.counters["points"] = static_cast<double>(result.points.size());
}

void moveOne(benchmark::State& state, const char* name) {
  const auto casters = castersOf(name);
  scene::CasterSilhouettes extracted;
  scene::LightSilhouetteCache cache;
  for (auto unused : state) {
    casters->placed[0].revision += casters->placed.size();
    benchmark::DoNotOptimize(&cache.update(extracted, casters->placed, casters->plane, 0.5, 0.5, 1e-3));
  }
  state.counters["reused"] = cache.counters().reused;
}

/// Adjacency of a scene's largest mesh, repairs included.
void build(benchmark::State& state, const char* name) {
  const scene::SceneDescription description = scenes::makeBuiltinScene(name).value();
  const scene::TriangleMesh* largest = description.objects[0].mesh.get();
  for (const scene::SceneObject& object : description.objects) {
    if (object.mesh->triangleCount() > largest->triangleCount()) largest = object.mesh.get();
  }
  for (auto unused : state) benchmark::DoNotOptimize(scene::HalfEdgeMesh::build(*largest));
  state.counters["triangles"] = largest->triangleCount();
}

BENCHMARK_CAPTURE(build, mannequin, "mannequin")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, terrain, "terrain")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, mannequin, "mannequin", scene::LayerSplit::none)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, mannequin_layers, "mannequin", scene::LayerSplit::layers)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, spheres_cube_layers, "spheres-cube", scene::LayerSplit::layers)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, terrain, "terrain", scene::LayerSplit::none)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, spheres_cube, "spheres-cube", scene::LayerSplit::none)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(moveOne, spheres_cube, "spheres-cube")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, spheres27, "spheres27", scene::LayerSplit::none)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, figure, "figure", scene::LayerSplit::none)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extractAll, leaves, "leaves", scene::LayerSplit::none)->Unit(benchmark::kMillisecond);
}  // namespace
}  // namespace halfshadow
