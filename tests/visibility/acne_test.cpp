// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Acne (a surface that shadows itself) and peter-panning (a shadow that starts away from its caster), the two
// faults that depth bias trades.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

/// Pixels of casters that see the whole light and are not shown at 255. Left out are pixels at outlines,
/// where rasteriser and ray tracer may show different surfaces, and facets below whose plane a sliver of the
/// light lies: the truth starts its rays a little above the facet and sees that sliver.
struct FalseShadow {
  int pixels = 0, darkest = 255;
};
/// `allowed`: steps of the image below lit that are none.
FalseShadow falseShadow(const Truth& truth, const Image& image, int allowed = 0) {
  FalseShadow found;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (truth.kind[i] != reference::kCasterReceiver || !truth.interior[i] || !truth.facesWholeLight[i] ||
        truth.visibility[i] < 1.0f || image.byte(i) >= 255 - allowed)
      continue;
    ++found.pixels;
    found.darkest = std::min<int>(found.darkest, image.byte(i));
  }
  return found;
}

std::vector<Configuration> configurations(Engine& engine) {
  std::vector<Configuration> all;
  for (const int size : {2, 3, 4, 5, 7, 9, 13, 17}) {
    all.push_back({"pcf", {{"pcf.size", std::to_string(size)}}});
    all.push_back({"pcf-masked", {{"pcf-masked.size", std::to_string(size)}}});
  }
  for (const std::string& id : techniquesBut(engine, {{"none", "it has no shadow"}})) all.push_back({id});
  return all;
}

class Acne : public SharedEngineTest, public testing::WithParamInterface<std::string> {};

TEST_P(Acne, NoLitCasterPixelIsShadowedAtBiasOne) {
  renderer().load(builtinScene(GetParam()));
  const Truth& truth = truthOf(GetParam());
  for (const Configuration& configuration : configurations(renderer().engine())) {
    const Image image = renderer().render(configuration);
    // Occlusion textures sum up shares that are stored in 8 bits: they may be one step off.
    const FalseShadow wrong =
        falseShadow(truth, image, configuration.technique == "occlusion-textures" ? 1 : 0);
    EXPECT_EQ(wrong.pixels, 0) << configuration.text() << ": the darkest is " << wrong.darkest << " of 255";
    if (wrong.pixels > 0) {
      std::printf("%s\n",
                  saveComparison("acne_" + GetParam() + "_" + configuration.text(), truth, image.visibility())
                      .c_str());
    }
  }
}

TEST_P(Acne, ShowsWithoutBias) {
  renderer().load(builtinScene(GetParam()));
  const Image image = renderer().render(Configuration{"hard", {{"bias", "0"}}});
  // Flat faces are interpolated almost exactly, so the box shows between 4 and 1,300 pixels by rung: only the
  // sphere's facets, seen at every angle, are sure to need the bias.
  if (GetParam().starts_with("box")) GTEST_SKIP() << "a box needs next to no bias";
  EXPECT_GE(falseShadow(truthOf(GetParam()), image).pixels, 20) << "the test above cannot fail";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Acne, testing::ValuesIn(kAcneScenes), [](const auto& tested) {
  std::string name = tested.param;
  std::ranges::replace_if(
      name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// A wall that stands on the ground, lit at 45 degrees: its shadow begins where it stands.
TEST_F(Acne, HardShadowOfAThinWallStartsWithinTwoTexels) {
  const StandingWall wall;
  renderer().load(wall.scene());
  const Image image =
      renderer().render(Configuration{"hard", {{"map_size", std::to_string(StandingWall::kMapSize)}}});
  const double gap = wall.gapWorld(image);
  std::printf("contact gap %.5f world units, %.2f texels\n", gap, gap / wall.texelWorld());
  // One texel is the map's own rounding, one the bias at 45 degrees; a pixel is what the picture resolves.
  EXPECT_LE(gap, 2.0 * wall.texelWorld() + wall.pixelWorld());
  EXPECT_LT(wall.pixelWorld(), 0.25 * wall.texelWorld()) << "the picture must resolve the gap";
}

}  // namespace
}  // namespace halfshadow::test
