// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// CPU time, allocations and OpenGL ES calls of the engine per frame, by technique, number of boxes, and what
/// changes. The target and the maps are tiny and nothing is drawn: the draw calls that the engine gets end
/// here, once it has probed its context. What remains is planning, uploading and encoding, with the driver's
/// share of all other calls.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "counted_memory.hpp"
#include "egl/headless.hpp"
#include "gl_calls.hpp"
#include "halfshadow/halfshadow.hpp"

namespace halfshadow {
namespace {

constexpr int kWidth = 32, kHeight = 24;
constexpr double kSpacing = 1.0, kHalfSize = 0.2;
constexpr int kWarmUpFrames = 6;  // programs are linked, and whatever moves counts as moving

enum class Change { nothing, camera, oneMover, light };

void* loadEntryPoint(const char* name, void* user) {
  return benchmarks::countedEntryPoint(name, static_cast<HeadlessContext*>(user)->getProcAddress(name));
}

constexpr std::array<std::uint32_t, 36> kBoxIndices{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

std::array<float, 24> boxCorners(double halfX, double halfY, double halfZ) {
  std::array<float, 24> corners{};
  for (std::size_t i = 0; i < 8; ++i) {
    corners[3 * i] = static_cast<float>((i & 1u) != 0 ? halfX : -halfX);
    corners[3 * i + 1] = static_cast<float>((i & 2u) != 0 ? halfY : -halfY);
    corners[3 * i + 2] = static_cast<float>((i & 4u) != 0 ? halfZ : -halfZ);
  }
  return corners;
}

/// A square of hills, so that it casts, with about so many triangles.
struct Hills {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
};
Hills hills(double halfSide, int triangles) {
  const auto cells = static_cast<std::uint32_t>(std::sqrt(0.5 * triangles));
  Hills mesh;
  for (std::uint32_t i = 0; i <= cells; ++i) {
    for (std::uint32_t k = 0; k <= cells; ++k) {
      const double x = halfSide * (2.0 * i / cells - 1.0), z = halfSide * (2.0 * k / cells - 1.0);
      const double y = 0.1 * halfSide * (std::sin(3.0 * x) * std::cos(2.0 * z) - 1.0);
      for (const double coordinate : {x, y, z}) mesh.positions.push_back(static_cast<float>(coordinate));
      if (i == cells || k == cells) continue;
      const std::uint32_t a = i * (cells + 1) + k, b = a + cells + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  }
  return mesh;
}

/// An engine with a square of boxes over a ground, all in view of the camera.
class BoxField {
 public:
  /// `levelTriangles`: of hills in place of the flat ground; 0 = none.
  static std::unique_ptr<BoxField> make(int boxes, int levelTriangles, std::string& error) {
    auto context = createHeadless({});
    if (!context) {
      error = context.error().message;
      return nullptr;
    }
    std::unique_ptr<BoxField> field(new BoxField);
    field->context_ = std::move(context).value();
    Outcome outcome;
    benchmarks::glDraws = true;
    field->engine_.reset(Engine::create({.getProcAddress = loadEntryPoint,
                                         .getProcAddressUser = field->context_.get(),
                                         .hostState = HostState::leaveDirty},
                                        outcome));
    benchmarks::glDraws = false;
    if (outcome.ok()) outcome = field->fill(boxes, levelTriangles);
    if (outcome.ok()) return field;
    error = outcome.message;
    return nullptr;
  }

  /// Errors are those of the engine, as text; empty when there is none.
  std::string choose(const char* technique, Output output) {
    desc_.output = output;
    if (const Outcome small = engine_->set("map_size", "64"); !small.ok()) return small.message;
    const Outcome outcome = engine_->setTechnique(technique);
    return outcome.ok() ? "" : outcome.message;
  }

  std::string renderNext(Change change) {
    ++frame_;
    const double step = 0.1 * std::sin(0.3 * frame_);
    if (change == Change::camera) desc_.camera.eye[0] = step;
    if (change == Change::oneMover) moveFirstBox(step);
    if (change == Change::light) setLight(step);
    const Outcome outcome = engine_->render(desc_);
    return outcome.ok() ? "" : outcome.message;
  }

  void finish() { engine_->finish(); }

 private:
  BoxField() = default;

  Outcome fill(int boxes, int levelTriangles) {
    const int side = static_cast<int>(std::ceil(std::sqrt(boxes)));
    extent_ = 0.5 * kSpacing * side;
    ObjectId id = 0;
    if (const Outcome added = addGround(levelTriangles); !added.ok()) return added;
    const auto corners = boxCorners(kHalfSize, kHalfSize, kHalfSize);
    for (int i = 0; i < boxes; ++i) {
      const double x = kSpacing * (i % side) - extent_, z = kSpacing * (i / side) - extent_;
      if (const Outcome added = add(corners, x, 0.5, z, id); !added.ok()) return added;
      if (i == 0) mover_ = id, moverX_ = x, moverZ_ = z;
    }
    desc_.camera.eye[1] = 3.0 * extent_ + 2.0;
    desc_.camera.eye[2] = 2.0 * extent_ + 2.0;
    desc_.camera.farDistance = 20.0 * extent_ + 20.0;
    desc_.target.width = kWidth;
    desc_.target.height = kHeight;
    return setLight(0.0);
  }

  Outcome addGround(int levelTriangles) {
    ObjectId id = 0;
    if (levelTriangles == 0) return add(boxCorners(1.5 * extent_, 0.05, 1.5 * extent_), 0.0, -0.05, 0.0, id);
    const Hills level = hills(1.5 * extent_, levelTriangles);
    ObjectDesc object;
    object.mesh.positions = level.positions.data();
    object.mesh.vertexCount = static_cast<std::uint32_t>(level.positions.size() / 3);
    object.mesh.indices = level.indices.data();
    object.mesh.indexCount = level.indices.size();
    return engine_->addObject(object, id);
  }

  Outcome add(const std::array<float, 24>& corners, double x, double y, double z, ObjectId& id) {
    ObjectDesc object;
    object.mesh.positions = corners.data();
    object.mesh.vertexCount = 8;
    object.mesh.indices = kBoxIndices.data();
    object.mesh.indexCount = kBoxIndices.size();
    object.worldFromObject[12] = x;
    object.worldFromObject[13] = y;
    object.worldFromObject[14] = z;
    return engine_->addObject(object, id);
  }

  void moveFirstBox(double step) {
    const double worldFromObject[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, moverX_ + step, 0.5, moverZ_, 1};
    engine_->setTransform(mover_, worldFromObject);
  }

  Outcome setLight(double step) {
    LightDesc light;
    light.center[0] = step;
    light.center[1] = 3.0 * extent_;
    light.halfU[0] = 0.1 * extent_;
    light.halfV[2] = 0.1 * extent_;  // halfU x halfV points down
    return engine_->setLights(&light, 1);
  }

  std::unique_ptr<HeadlessContext> context_;
  std::unique_ptr<Engine> engine_;
  RenderDesc desc_;
  double extent_ = 1.0, moverX_ = 0.0, moverZ_ = 0.0;
  ObjectId mover_ = 0;
  int frame_ = 0;
};

enum class Ground { flat, level };
constexpr int kBoxesOnLevel = 20;

/// The benchmark's argument is the number of boxes, or of the level's triangles.
void frame(benchmark::State& state, const char* technique, Change change, Ground ground, Output output) {
  std::string error;
  const auto size = static_cast<int>(state.range(0));
  const auto field =
      ground == Ground::flat ? BoxField::make(size, 0, error) : BoxField::make(kBoxesOnLevel, size, error);
  if (field) error = field->choose(technique, output);
  for (int i = 0; error.empty() && i < kWarmUpFrames; ++i) error = field->renderNext(change);
  if (!error.empty()) {
    state.SkipWithError(error.c_str());
    return;
  }
  std::uint64_t allocated = 0, calls = 0;
  for (auto unused : state) {
    const std::uint64_t before = test::allocationCount(), callsBefore = benchmarks::glCalls;
    error = field->renderNext(change);
    allocated += test::allocationCount() - before;
    calls += benchmarks::glCalls - callsBefore;
    state.PauseTiming();  // what the driver still does must not run into the next frame's time
    field->finish();
    state.ResumeTiming();
    if (!error.empty()) break;
  }
  if (!error.empty()) state.SkipWithError(error.c_str());
  const auto frames = static_cast<double>(std::max<std::int64_t>(1, state.iterations()));
  state.counters["allocations"] = static_cast<double>(allocated) / frames;
  state.counters["gl_calls"] = static_cast<double>(calls) / frames;
}

struct Named {
  const char* name;
  Change change;
};

void registerAll() {
  for (const char* technique :
       {"none", "hard", "pcss-mip", "shadow-width", "wedges-blended", "wedges-cells"}) {
    for (const Named& what : {Named{"unchanged", Change::nothing},
                              {"camera", Change::camera},
                              {"mover", Change::oneMover},
                              {"light", Change::light}}) {
      const std::string name = std::string(technique) + "/" + what.name;
      benchmark::RegisterBenchmark(name.c_str(), frame, technique, what.change, Ground::flat,
                                   Output::visibility)
          ->Arg(20)
          ->Arg(200)
          ->Arg(2000)
          ->Unit(benchmark::kMicrosecond)
          ->UseRealTime();
    }
  }
  // Hosts that draw receivers themselves: what is left is the maps, and what moves in them.
  for (const char* technique : {"hard", "pcss-mip", "shadow-width"}) {
    for (const Named& what : {Named{"camera", Change::camera}, {"mover", Change::oneMover}}) {
      const std::string name = std::string(technique) + "/lights-only-" + what.name;
      benchmark::RegisterBenchmark(name.c_str(), frame, technique, what.change, Ground::flat,
                                   Output::lightsOnly)
          ->Arg(20)
          ->Arg(200)
          ->Arg(2000)
          ->Unit(benchmark::kMicrosecond)
          ->UseRealTime();
    }
  }
  for (const Named& what : {Named{"mover", Change::oneMover}, {"light", Change::light}}) {
    const std::string name = std::string("hard/level-") + what.name;
    benchmark::RegisterBenchmark(name.c_str(), frame, "hard", what.change, Ground::level, Output::visibility)
        ->Arg(1000)
        ->Arg(100000)
        ->Unit(benchmark::kMicrosecond)
        ->UseRealTime();
  }
}

}  // namespace
}  // namespace halfshadow

int main(int argc, char** argv) {
  halfshadow::registerAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
