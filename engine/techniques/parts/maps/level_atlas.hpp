// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A pyramid of square images in one texture: ES 2.0 fragment shaders cannot name a mip level, and the box
/// filter of mip chains knows no depth.
#pragma once

#include <string>
#include <vector>

#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

/// The finest level, a power of two a side, stands at the left, the others are stacked at its right.
struct LevelAtlas {
  int finestSide = 2;
  int lastLevel = 0;

  int width() const { return finestSide + finestSide / 2; }
  int height() const { return finestSide; }
  int side(int level) const { return finestSide >> level; }
  Rect rect(int level) const {
    return level == 0 ? Rect{0, 0, side(0), side(0)}
                      : Rect{finestSide, finestSide - 2 * side(level), side(level), side(level)};
  }
};

/// A square image, whole or a level of an atlas.
struct LevelImage {
  framegraph::ResourceId image;
  int imageWidth = 0, imageHeight = 0;
  Rect rect;
};

/// One level as it is drawn: `program` reads texels of `source` (sampler u_source, uniforms u_sourceRect and
/// u_sourceScale) and writes `target`.
struct LevelDraw {
  std::string fragmentFile;
  std::vector<std::string> defines;
  LevelImage source;
  Rect target;
};

/// A pass that writes all levels, in the order of `draws`.
void addLevelPass(PassPlan& plan, std::string name, framegraph::ResourceId target,
                  const std::vector<LevelDraw>& draws, std::uint64_t contentKey);

}  // namespace halfshadow::techniques
