// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Drivers compile a program for each combination of the states that their hardware, or their compiler, knows
// only as code. Where an object had a combination of its own, a frame took as long as its compilations.
#include <gtest/gtest.h>

#include <map>

#include "counted_gl.hpp"
#include "engine_fixture.hpp"
#include "moving_boxes.hpp"

namespace halfshadow::test {
namespace {

class DrawnStates : public EngineTest {};

TEST_F(DrawnStates, AreAsManyForManyObjectsAsForFew) {
  // Of each technique, by objects a side.
  std::map<std::string, std::map<int, std::size_t>> counted;
  for (const int perSide : {4, 10}) {
    SceneRenderer renderer(makeCountedEngine());
    Engine& engine = renderer.engine();
    MovingBoxes boxes(1);
    boxes.fillGrid(perSide);
    MovingBoxes::Follower(engine).follow(boxes);
    const LightDesc light = lightOverBoxes(0.5);
    ASSERT_TRUE(engine.setLights(&light, 1).ok());
    renderer.desc().camera = cameraOverBoxes();
    renderer.desc().target.width = kWidth;
    renderer.desc().target.height = kHeight;
    for (const std::string& technique : techniquesBut(engine, {})) {
      Configuration configuration{technique};
      if (technique == "sampled") configuration.settings = {{"sampled.samples", "3"}};
      takeDrawnStates();
      renderer.render(configuration);
      counted[technique][perSide] = takeDrawnStates().size();
    }
  }
  for (const auto& [technique, states] : counted) {
    SCOPED_TRACE(technique);
    EXPECT_GT(states.at(4), 1u);
    // What stands at the edge of the view, or of another's tile, may be drawn in one way more; six times as
    // many objects are not six times as many ways.
    EXPECT_LE(states.at(10), states.at(4) + 3);
  }
}

}  // namespace
}  // namespace halfshadow::test
