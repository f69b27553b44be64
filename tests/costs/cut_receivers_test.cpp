// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Receivers so wide that they are cut to the view keep their parts, in whatever order they are drawn.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

constexpr float kFar = 1e6f;

/// A board from one depth to another, as wide as far.
ObjectDesc board(const float (&positions)[12], const std::uint32_t (&indices)[6], bool green) {
  ObjectDesc desc;
  desc.mesh = {.positions = positions, .vertexCount = 4, .indices = indices, .indexCount = 6};
  desc.casts = false;
  desc.baseColor[0] = green ? 0.0f : 0.8f;
  desc.baseColor[1] = green ? 0.8f : 0.0f;
  desc.baseColor[2] = 0.0f;
  return desc;
}

class CutReceivers : public EngineTest {};

TEST_F(CutReceivers, AreAllDrawnWhicheverIsNearer) {
  const float beyond[12] = {-kFar, 0, -kFar, kFar, 0, -kFar, kFar, 0, -5, -kFar, 0, -5};
  const float before[12] = {-kFar, 0, -5, kFar, 0, -5, kFar, 0, kFar, -kFar, 0, kFar};
  const std::uint32_t indices[6] = {0, 2, 1, 0, 3, 2};
  const LightDesc light{.center = {0, 20, 0}, .halfU = {0.1, 0, 0}, .halfV = {0, 0, 0.1}};
  for (const bool nearFirst : {false, true}) {
    const auto engine = makeEngine();
    ASSERT_TRUE(engine->setTechnique("hard").ok());
    ASSERT_TRUE(engine->setLights(&light, 1).ok());
    ObjectId id = 0;
    ASSERT_TRUE(engine->addObject(board(nearFirst ? before : beyond, indices, nearFirst), id).ok());
    ASSERT_TRUE(engine->addObject(board(nearFirst ? beyond : before, indices, !nearFirst), id).ok());
    RenderDesc desc;
    desc.camera = {.eye = {0, 3, 5}, .target = {0, 0, -5}};
    desc.target.width = kWidth;
    desc.target.height = kHeight;
    for (int frame = 0; frame < 3; ++frame) {
      desc.camera.eye[0] = 0.1 * frame;
      ASSERT_TRUE(engine->render(desc).ok());
      Image image{kWidth, kHeight, std::vector<std::uint8_t>(4u * kWidth * kHeight)};
      ASSERT_TRUE(engine->readOutput(image.rgba.data(), image.rgba.size()).ok());
      const auto share = [&](int more, int less) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < image.pixels(); ++i)
          count += image.byte(i, more) > image.byte(i, less) + 40;
        return static_cast<double>(count) / static_cast<double>(image.pixels());
      };
      // The border between them passes through the middle of the picture, and the horizon is above it.
      EXPECT_GT(share(1, 0), 0.3) << "the near one, frame " << frame;
      EXPECT_GT(share(0, 1), 0.1) << "the far one, frame " << frame;
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
