// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The same picture wherever and however large the world is, and still edges while something else moves.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analytic_scenes.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

class Stability : public SharedEngineTest {};

TEST_F(Stability, TinyAndFarAwayWorldsGiveTheSameImage) {
  const Truth& truth = truthOf("figure@light=1");
  for (const std::string& technique :
       techniquesBut(renderer().engine(), {{"none", "its picture is lit whatever the world"}})) {
    renderer().load(builtinScene("figure@light=1"));
    const Image reference = renderer().render(Configuration{technique});
    for (const char* name : {"tiny", "large-world"}) {
      renderer().load(builtinScene(name));
      const Image image = renderer().render(Configuration{technique});
      double sum = 0.0;
      int differing = 0, judged = 0;
      for (std::size_t i = 0; i < image.pixels(); ++i) {
        if (!truth.interior[i]) continue;
        const int difference = std::abs(image.byte(i) - reference.byte(i));
        ++judged, sum += difference / 255.0, differing += difference > 2;
      }
      std::printf("%-20s %-11s mean difference %.5f, %d of %d pixels differ by more than 2/255\n",
                  technique.c_str(), name, sum / judged, differing, judged);
      // Matrices are made in double relative to camera and light, so only the last bit of their float images
      // differs. Where an edge runs within that of a texel's border its pixel flips: 1 in 200, and never a
      // region.
      // Distances are rounded to sixteenths of an octave, which a scale of 1/1000 is not: depths of few bits
      // (averaged in 8 by the pyramid, widths in 8, stored in 16 without highp) then round elsewhere, by
      // little but in 1 pixel of 40.
      const bool fewBits = technique == "pcss-mip" || technique == "pcf-quantized" ||
                           technique == "shadow-width" || isForcedOff("highp");
      // Widths in 8 bits of depths in 16: both.
      const bool fewestBits = technique == "shadow-width" && isForcedOff("highp");
      const int allowed =
          judged / (name == std::string("large-world") ? 200 : (fewestBits ? 20 : (fewBits ? 40 : 200)));
      EXPECT_LE(differing, allowed) << technique << " " << name;
      EXPECT_LE(sum / judged, 0.002) << technique << " " << name;
      if (differing > allowed || sum / judged > 0.002) {
        std::printf("%s\n", saveComparison(std::string("stability_") + name + "_" + technique, kWidth,
                                           kHeight, reference.visibility(), image.visibility())
                                .c_str());
      }
    }
  }
}

// A box moves beside a still one. Texel snapping keeps the still one's edge where it is unless the view has
// to grow.
TEST_F(Stability, EdgeOfAStillCasterDoesNotCrawl) {
  scene::SceneDescription scene;
  scene.objects = {boxObject({-1.5, 2, 0}, {0.6, 0.1, 0.6}), boxObject({1.5, 2, 0}, {0.4, 0.1, 0.4}),
                   groundPlane(20.0)};
  const scene::AreaLight light = lightAbove({0, 12, 0}, 0.0, 0.0);
  scene.lights = {light};
  scene.camera = cameraAbove(-1.5, 0.0, 1.2);
  renderer().load(scene);
  Image before = renderer().render(Configuration{"hard"});
  int framesWithChanges = 0, worstFrame = 0, shadowed = 0;
  constexpr int kFrames = 24;
  for (int frame = 1; frame <= kFrames; ++frame) {
    glm::dmat4 moved(1.0);
    moved[3] = glm::dvec4(0.013 * frame, 0.0, 0.007 * frame, 1.0);
    renderer().setTransform(1, moved);
    const Image image = renderer().render();
    int changed = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      changed += image.byte(i) != before.byte(i);
      shadowed += frame == 1 && image.byte(i) == 0;
    }
    framesWithChanges += changed > 0;
    worstFrame = std::max(worstFrame, changed);
    before = image;
  }
  std::printf("still edge: %d of %d frames change, at most %d pixels (%d are shadowed)\n", framesWithChanges,
              kFrames, worstFrame, shadowed);
  ASSERT_GE(shadowed, 2000);
  // .3 of a view 4.5 wide is a step or two of 1/16 octave (4.4 %); the origin moves by whole texels.
  EXPECT_LE(framesWithChanges, 3);
  // The outline is 400 pixels long; a step of the texel grid moves it by less than a texel (.005), a third of
  // a pixel.
  EXPECT_LE(worstFrame, 200);
}

TEST_F(Stability, SixteenBitOutputAgreesWithEight) {
  renderer().load(builtinScene("spheres27@light=1"));
  for (const char* technique : {"hard", "pcf", "pcss", "pcss-mip", "sampled"}) {
    const Image eight = renderer().render(Configuration{technique});
    const Image sixteen = renderer().render(Output::visibility16);
    int differing = 0;
    for (std::size_t i = 0; i < eight.pixels(); ++i) {
      const double fine = (256.0 * sixteen.byte(i, 0) + sixteen.byte(i, 1)) / 65280.0;
      ASSERT_LE(fine, 1.0 + 1.0 / 255.0);
      // Half a step of 8 bits, and of fp16 where a driver computes in it.
      differing += std::abs(fine - eight.byte(i) / 255.0) > 0.5 / 255.0 + 1.0 / 2048.0;
    }
    // Background is cleared to 1 in every channel: 65535 / 65280, that is within the allowance above.
    EXPECT_EQ(differing, 0) << technique;
  }
}

}  // namespace
}  // namespace halfshadow::test
