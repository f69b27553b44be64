// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The same scene elsewhere, larger, turned, or written down in another way.
#include <cstdio>
#include <numbers>

#include "stress/stages.hpp"

namespace halfshadow::stress {
namespace {
std::vector<Variant> scales(std::uint64_t) {
  std::vector<Variant> all;
  for (const double scale : {1e-25, 1e-12, 1e-4, 37.0, 1e5, 1e14, 1e25})
    all.push_back({numberText(scale), placed(baseScene("figure"), {.scale = scale}), "figure"});
  return all;
}

std::vector<Variant> shifts(std::uint64_t seed) {
  Random random(seed);
  std::vector<Variant> all;
  for (const double distance : {1e2, 1e4, 1e6})
    all.push_back({numberText(distance),
                   placed(baseScene("figure"), {.shift = distance * random.direction()}), "figure"});
  return all;
}

std::vector<Variant> bakedShifts(std::uint64_t seed) {
  Random random(seed + 1);
  std::vector<Variant> all;
  // At 1e6 floats are a sixteenth apart: the box is another, but still one.
  for (const double distance : {1e3, 3e4, 1e6})
    all.push_back(
        {numberText(distance), baked(baseScene("box"), {.shift = distance * random.direction()}), "box"});
  return all;
}

std::vector<Variant> rotations(std::uint64_t seed) {
  Random random(seed + 2);
  std::vector<Variant> all;
  for (const char* base : {"box", "figure", "leaves"}) {
    const Placement placement{.axis = random.direction(),
                              .angle = random.between(0.3, 2.0 * std::numbers::pi - 0.3)};
    all.push_back({base, placed(baseScene(base), placement), base});
  }
  const Placement placement{.axis = random.direction(), .angle = random.between(0.3, 6.0)};
  all.push_back({"figure-baked", baked(baseScene("figure"), placement), "figure"});
  return all;
}

std::vector<Variant> mirrors(std::uint64_t) {
  return {{"box", mirroredNodes(baseScene("box")), "box"},
          {"figure", mirroredNodes(baseScene("figure")), "figure"}};
}

std::vector<Variant> orders(std::uint64_t seed) {
  Random random(seed + 3);
  std::vector<Variant> all;
  for (const char* base : {"figure", "leaves", "figure"})
    all.push_back(
        {base + std::string("-") + std::to_string(all.size()), reordered(baseScene(base), random), base});
  all.push_back({"figure-unwelded", unwelded(baseScene("figure")), "figure"});
  return all;
}

std::vector<Variant> splits(std::uint64_t) {
  return {{"box-by-side", split(baseScene("box"), SplitRule::bySide), "box"},
          {"figure-by-side", split(baseScene("figure"), SplitRule::bySide), "figure"},
          {"figure-alternating", split(baseScene("figure"), SplitRule::alternating), "figure"}};
}

std::vector<Variant> windings(std::uint64_t) {
  return {{"box", flipped(baseScene("box"), FlipRule::all), "box"},
          {"figure", flipped(baseScene("figure"), FlipRule::all), "figure"},
          {"figure-half", flipped(baseScene("figure"), FlipRule::everySecond), "figure"},
          {"leaves", flipped(baseScene("leaves"), FlipRule::all), "leaves"}};
}
}  // namespace

std::vector<Case> placementCases() {
  return {
      {"scale", "the figure from 1e-25 to 1e25 times its size", Rule::restated, scales},
      {"shift", "the figure far from the origin, by transforms", Rule::restated, shifts},
      {"baked", "the box far from the origin, by coordinates: their floats are another shape", Rule::own,
       bakedShifts},
      {"rotation", "scenes turned about random axes", Rule::restated, rotations},
      {"mirror", "meshes mirrored, and mirrored back by their transforms", Rule::restated, mirrors},
      {"order", "objects and triangles in random order; no vertex shared", Rule::restated, orders},
      {"split", "each mesh in two objects", Rule::same, splits},
      {"winding", "casters wound inside out, all or every second one", Rule::same, windings},
  };
}

}  // namespace halfshadow::stress
