// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "moving_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace halfshadow::test {
namespace {
constexpr double kHalfGround = 6.0;
constexpr std::array<std::uint32_t, 36> kIndices{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                                 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

std::array<float, 24> cornersOf(const glm::dvec3& half) {
  std::array<float, 24> corners{};
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[3 * i + axis] = static_cast<float>((i >> axis & 1u) != 0 ? half[static_cast<int>(axis)]
                                                                       : -half[static_cast<int>(axis)]);
  }
  return corners;
}

ObjectDesc descOf(const MovingBox& box) {
  ObjectDesc desc;
  desc.mesh = {.positions = box.corners.data(),
               .vertexCount = 8,
               .indices = kIndices.data(),
               .indexCount = kIndices.size()};
  std::copy_n(glm::value_ptr(box.worldFromObject), 16, desc.worldFromObject);
  return desc;
}
}  // namespace

void MovingBoxes::fillGrid(int perSide) {
  for (int i = 0; i < perSide * perSide; ++i) {
    const double spacing = 1.6 * kHalfGround / perSide;
    Box& box = boxes_.emplace_back();
    box.number = nextNumber_++;
    box.corners = cornersOf(glm::dvec3(0.2 * spacing));
    const glm::dvec3 place(spacing * (i % perSide + 0.5 - 0.5 * perSide), 0.5 + 0.1 * (i % 3),
                           spacing * (i / perSide + 0.5 - 0.5 * perSide));
    box.worldFromObject = glm::translate(glm::dmat4(1.0), place);
  }
}

void MovingBoxes::fillAtRandom(int count) {
  while (static_cast<int>(boxes_.size()) < count) add();
}

void MovingBoxes::add() {
  Box& box = boxes_.emplace_back();
  box.number = nextNumber_++;
  box.corners = cornersOf({at(0.05, 0.5), at(0.05, 0.5), at(0.05, 0.5)});
  const double reach = 0.7 * kHalfGround;
  glm::dmat4 world = glm::translate(glm::dmat4(1.0), {at(-reach, reach), at(0.3, 2.5), at(-reach, reach)});
  world = glm::rotate(world, at(0.0, 3.0), glm::normalize(glm::dvec3(at(0.1, 1), at(0, 1), at(0, 1))));
  if (at(0.0, 1.0) < 0.2) world = glm::scale(world, glm::dvec3(-1.0, 1.0, 1.0));
  box.worldFromObject = world;
}

void MovingBoxes::remove(std::size_t box) {
  boxes_.erase(boxes_.begin() + static_cast<std::ptrdiff_t>(box));
}

void MovingBoxes::move(std::size_t box, const glm::dvec3& by) {
  boxes_[box].worldFromObject = glm::translate(glm::dmat4(1.0), by) * boxes_[box].worldFromObject;
}

void MovingBoxes::edit(std::size_t box) {
  for (std::size_t i = 1; i < 24; i += 3) boxes_[box].corners[i] *= static_cast<float>(at(0.7, 1.4));
  ++boxes_[box].edits;
}

void MovingBoxes::step() {
  const int what = std::uniform_int_distribution<int>(0, 9)(random_);
  if (what == 0) add();
  if (what == 1 && boxes_.size() > 2) remove(any());
  if (what == 2) edit(any());
  if (what == 3) return add(), remove(any()), edit(any());
  const int movers = what == 4 ? 5 : what > 4 ? 1 : 0;
  for (int i = 0; i < movers; ++i) move(any(), {at(-0.3, 0.3), at(-0.1, 0.1), at(-0.3, 0.3)});
}

void MovingBoxes::Follower::follow(const MovingBoxes& boxes) {
  if (ground_ == 0) {
    MovingBox ground{.corners = cornersOf({kHalfGround, 0.05, kHalfGround})};
    ground.worldFromObject = glm::translate(glm::dmat4(1.0), {0.0, -0.05, 0.0});
    EXPECT_TRUE(engine_.addObject(descOf(ground), ground_).ok());
  }
  std::erase_if(held_, [&](const Held& held) {
    const bool gone = std::ranges::find(boxes.boxes_, held.box, &Box::number) == boxes.boxes_.end();
    if (gone) {
      EXPECT_TRUE(engine_.removeObject(held.id).ok());
    }
    return gone;
  });
  for (const Box& box : boxes.boxes_) {
    auto held = std::ranges::find(held_, box.number, &Held::box);
    if (held == held_.end()) {
      held = held_.insert(held_.end(), {box.number, box.edits, box.worldFromObject, 0});
      EXPECT_TRUE(engine_.addObject(descOf(box), held->id).ok());
    }
    if (held->edits != box.edits) {
      EXPECT_TRUE(engine_.setVertices(held->id, descOf(box).mesh).ok());
    }
    if (held->worldFromObject != box.worldFromObject) {
      EXPECT_TRUE(engine_.setTransform(held->id, glm::value_ptr(box.worldFromObject)).ok());
    }
    held->edits = box.edits;
    held->worldFromObject = box.worldFromObject;
  }
}

CameraDesc cameraOverBoxes() {
  CameraDesc camera;
  camera.eye[1] = 3.0 * kHalfGround;
  camera.eye[2] = 1.2 * kHalfGround;
  camera.target[1] = camera.target[2] = 0.0;
  camera.farDistance = 20.0 * kHalfGround;
  return camera;
}

LightDesc lightOverBoxes(double halfSize) {
  LightDesc light;
  light.center[0] = 1.0;
  light.center[1] = 9.0;
  light.halfU[0] = halfSize;
  light.halfV[2] = halfSize;  // halfU x halfV points down
  return light;
}

}  // namespace halfshadow::test
