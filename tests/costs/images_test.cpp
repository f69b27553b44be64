// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The images of a frame, listed for hosts that want to look inside.
#include <gtest/gtest.h>

#include <set>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

class Images : public EngineTest {};

std::vector<ImageRecord> imagesOf(const Engine& engine) {
  std::vector<ImageRecord> images(engine.images(nullptr, 0));
  engine.images(images.data(), images.size());
  return images;
}

TEST_F(Images, AreNoneBeforeAFrame) {
  const auto engine = makeEngine();
  EXPECT_EQ(engine->images(nullptr, 0), 0u);
}

TEST_F(Images, OfEveryTechniqueAreTexturesWithNames) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene("figure@light=0.3"));
  for (const std::string& technique : techniquesBut(renderer.engine(), {})) {
    SCOPED_TRACE(technique);
    renderer.render(Configuration{technique});
    std::set<std::uint32_t> textures;
    bool hasOutput = false;
    for (const ImageRecord& image : imagesOf(renderer.engine())) {
      SCOPED_TRACE(image.name);
      EXPECT_TRUE(hostGl().isTexture(image.texture));
      EXPECT_TRUE(textures.insert(image.texture).second) << "listed twice";
      EXPECT_NE(std::string(image.name), "");
      EXPECT_NE(std::string(image.format), "");
      EXPECT_GT(image.width, 0);
      EXPECT_GT(image.height, 0);
      if (image.texture != renderer.engine().outputTexture()) continue;
      hasOutput = true;
      EXPECT_EQ(image.width, kWidth);
      EXPECT_EQ(image.height, kHeight);
    }
    EXPECT_TRUE(hasOutput);
    const std::size_t least = technique == "none" ? 1 : technique == "hard" || technique == "pcf" ? 2 : 1;
    EXPECT_GE(textures.size(), least) << "a shadow map is an image";
    ImageRecord first, untouched;
    EXPECT_EQ(renderer.engine().images(&first, 1), renderer.engine().images(nullptr, 0)) << "writes only one";
    EXPECT_NE(first.texture, untouched.texture);
  }
}

}  // namespace
}  // namespace halfshadow::test
