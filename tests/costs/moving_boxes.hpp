// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Boxes over a ground of which some move, come and go, the same in several engines.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "halfshadow/halfshadow.hpp"

namespace halfshadow::test {

struct MovingBox {
  glm::dmat4 worldFromObject{1.0};
  std::array<float, 24> corners{};
};

class MovingBoxes {
 public:
  explicit MovingBoxes(std::uint32_t seed) : random_(seed) {}

  /// Side by side over a square, each beside the others, at heights that differ.
  void fillGrid(int perSide);
  /// Of all sizes, turned, some of them inside of others, some mirrored.
  void fillAtRandom(int count);

  /// Moves, adds, removes or edits a few.
  void step();
  void move(std::size_t box, const glm::dvec3& by);
  void edit(std::size_t box);
  void add();
  void remove(std::size_t box);
  std::size_t count() const { return boxes_.size(); }

  /// Brings an engine that follows since it was made, or a new one, to the boxes as they are.
  class Follower {
   public:
    explicit Follower(Engine& engine) : engine_(engine) {}
    void follow(const MovingBoxes& boxes);

   private:
    struct Held {
      std::uint64_t box = 0, edits = 0;
      glm::dmat4 worldFromObject{1.0};
      ObjectId id = 0;
    };
    Engine& engine_;
    ObjectId ground_ = 0;
    std::vector<Held> held_;
  };

 private:
  struct Box : MovingBox {
    std::uint64_t number = 0, edits = 0;
  };
  double at(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::size_t any() { return std::uniform_int_distribution<std::size_t>(0, boxes_.size() - 1)(random_); }

  std::mt19937 random_;
  std::uint64_t nextNumber_ = 1;
  std::vector<Box> boxes_;  ///< in the order in which they were added
};

/// Looks at all of the ground from above, so that no caster is left out for what the camera sees.
CameraDesc cameraOverBoxes();
LightDesc lightOverBoxes(double halfSize);

}  // namespace halfshadow::test
