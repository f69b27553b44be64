// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Pictures of an engine that the host lends threads.
#include <gtest/gtest.h>

#include "engine_fixture.hpp"
#include "threads/worker_threads.hpp"

namespace halfshadow::test {
namespace {

class LendingHost {
 public:
  std::unique_ptr<Engine> newEngine() {
    const std::vector<std::string> forced = forcedOffByEnvironment();
    std::vector<const char*> forcedOff;
    for (const std::string& name : forced) forcedOff.push_back(name.c_str());
    Outcome outcome;
    std::unique_ptr<Engine> engine(Engine::create(
        {.getProcAddress = [](const char* name, void*) { return headless()->getProcAddress(name); },
         .forcedOff = forcedOff.data(),
         .forcedOffCount = forcedOff.size(),
         .parallelFor = parallelFor,
         .parallelForUser = this},
        outcome));
    EXPECT_TRUE(outcome.ok()) << outcome.message;
    return engine;
  }
  std::size_t pieces = 0;

 private:
  static void parallelFor(std::size_t count, void (*work)(std::size_t, void*), void* job, void* user) {
    auto& host = *static_cast<LendingHost*>(user);
    host.pieces += count;
    WorkerThreads::parallelFor(count, work, job, &host.threads_);
  }
  WorkerThreads threads_{4};
};

class CellsThreads : public EngineTest {};

TEST_F(CellsThreads, ThePictureIsThatOfOneThread) {
  LendingHost host;
  SceneRenderer alone(makeEngine()), helped(host.newEngine());
  for (const char* scene : {"leaves@light=0.5", "figure@light=1", "spheres27@light=0.3"}) {
    scene::SceneDescription description = builtinScene(scene);
    alone.load(description);
    helped.load(description);
    for (const char* technique : {"wedges-cells", "wedges-blended"}) {
      SCOPED_TRACE(std::string(scene) + " " + technique);
      alone.choose({technique});
      helped.choose({technique});
      host.pieces = 0;
      for (int frame = 0; frame < 3; ++frame) {
        EXPECT_EQ(helped.render().rgba, alone.render().rgba) << frame;
        EXPECT_EQ(helped.engine().report().memoryBytes, alone.engine().report().memoryBytes);
        description.lights[0].centerWorld.x += 0.05;
        alone.setLights(description.lights);
        helped.setLights(description.lights);
      }
      EXPECT_GT(host.pieces, 0u);
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
