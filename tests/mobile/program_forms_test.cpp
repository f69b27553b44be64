// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Programs of other forms, for devices that have no room for the usual ones, draw the same pictures.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analytic_scenes.hpp"
#include "program_layer.hpp"
#include "scenes/shapes.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

class ProgramForms : public EngineTest {
 protected:
  static int apart(const Image& a, const Image& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
      most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return most;
  }
};

TEST_F(ProgramForms, DrawTheSamePictures) {
  const struct {
    const char* technique;
    std::vector<Setting> settings;
    const char* size;
    const char* define;  ///< that tells the other form
  } kForms[] = {
      {"wedges", {{"wedges.route", "screen"}}, "short", "WEDGE_CHAIN"},
      {"wedges", {{"wedges.route", "receivers"}}, "short", "WEDGE_CHAIN"},
      {"wedges-blended", {{"wedges-blended.cog", "off"}}, "parts", "HALF"},
      {"wedges-blended", {{"wedges-blended.cog", "on"}}, "parts", "HALF"},
      {"occlusion-textures", {{"sub_lights", "1"}}, "parts", "TEXTURES"},
  };
  ProgramLayer layer;
  SceneRenderer renderer(layer.makeEngine());
  for (const auto& [technique, settings, size, define] : kForms) {
    bool used = false;
    for (const char* scene : {"figure@light=1", "sheets", "room"}) {
      renderer.load(builtinScene(scene));
      Configuration form{technique, settings};
      const Image usual = renderer.render(form);
      form.settings.push_back({"program_size", size});
      SCOPED_TRACE(form.text() + ", " + scene);
      (void)layer.takeDrawn();
      const Image other = renderer.render(form);
      for (const DrawnProgram& program : layer.takeDrawn())
        used = used || program.defines().find(define) != std::string::npos;
      // A part is rounded for itself.
      EXPECT_LE(apart(usual, other), 1);
    }
    EXPECT_TRUE(used) << technique << " " << define;
  }
}

// Forms for devices without highp, which have few registers, are other arithmetic over other places: truth
// judges them by the forms that take tap by tap, whose depths have more bits.
TEST_F(ProgramForms, ForFewRegistersAreAsNearToTheTruth) {
  for (const char* scene : {"bars@light=1", "box@light=0.3"}) {
    const Truth& truth = truthOf(scene);
    const std::vector<std::uint8_t> penumbra = truth.penumbraOnGround();
    const auto errors = [&](const EngineDesc& desc) {
      ProgramLayer layer;
      SceneRenderer renderer(layer.makeEngine(desc));
      renderer.load(builtinScene(scene));
      std::vector<double> found;
      for (const char* technique : {"pcss", "pcss-mip", "pcf-quantized"}) {
        const std::vector<float> seen =
            renderer.render(Configuration{technique, {{"sub_lights", "1"}, {"program_size", "short"}}})
                .visibility();
        double sum = 0.0, count = 0.0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
          if (penumbra[i] == 0) continue;
          sum += std::pow(seen[i] - truth.visibility[i], 2);
          count += 1.0;
        }
        found.push_back(std::sqrt(sum / count));
      }
      bool used = false;
      for (const DrawnProgram& program : layer.takeDrawn()) {
        if (program.defines().find("SHORT") == std::string::npos) continue;
        used = true;
        EXPECT_EQ(program.defines().find("NO_HIGHP") != std::string::npos, desc.forcedOffCount > 0);
      }
      EXPECT_TRUE(used) << scene;
      return found;
    };
    const char* const off[] = {"highp"};
    const std::vector<double> tapByTap = errors({});
    const std::vector<double> few = errors({.forcedOff = off, .forcedOffCount = 1});
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_LE(few[i], 1.1 * tapByTap[i]) << scene << " " << i;
  }
}

// Where lists hold more than fragments can walk another technique takes the light; what its own programs fall
// back to holds for that light as for any other.
TEST_F(ProgramForms, OfWhatTakesARefusedLightAreItsOwnFallbacks) {
  ProgramLayer layer;
  layer.drop([](const DrawnProgram& program) {
    return program.file() == "map/pcss_mip.frag" && program.defines().find("SHORT") == std::string::npos;
  });
  const char* const off[] = {"highp"};
  SceneRenderer renderer(layer.makeEngine({.forcedOff = off, .forcedOffCount = 1}));
  scenes::Shape field;
  for (int i = 0; i < 60 * 60; ++i)
    field.append(scenes::boxShape({0.1 * (i % 60) - 3.0, 2.0, 0.1 * (i / 60) - 3.0}, glm::dvec3(0.02)));
  scene::SceneDescription scene;
  scene.objects = {scenes::casterOf("field", field), groundPlane(8.0)};
  scene.lights = {lightAbove({0, 8, 0}, 1.0, 1.0)};
  scene.camera = scene::Camera{.eyeWorld = {4, 6, 7}, .targetWorld = {0, 0, 0}, .verticalFovRadians = 0.8};
  renderer.load(scene);
  renderer.desc().target.width = 48;
  renderer.desc().target.height = 36;
  renderer.choose({"wedges-cells", {{"wedges-cells.tiles", "1"}}});
  const Image image = renderer.render();
  EXPECT_TRUE(renderer.report().hasSkip("light 0 wedges-cells", "pcss-mip takes the light"));
  EXPECT_TRUE(renderer.report().hasSkip("light 0 pcss-mip", "short programs"));
  bool drawn = false;
  for (const DrawnProgram& program : layer.takeDrawn())
    drawn = drawn || program.defines().find("SHORT") != std::string::npos;
  EXPECT_TRUE(drawn);
  const std::vector<float> seen = image.visibility();
  EXPECT_LT(*std::ranges::min_element(seen), 0.9f) << "it shadows the ground";
}

}  // namespace
}  // namespace halfshadow::test
