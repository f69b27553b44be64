// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Programs of other forms, for devices that have no room for the usual ones, draw the same pictures.
#include <algorithm>
#include <cstdlib>

#include "engine_fixture.hpp"
#include "program_layer.hpp"

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

}  // namespace
}  // namespace halfshadow::test
