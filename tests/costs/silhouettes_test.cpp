// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// How often a caster's silhouette is found, as the frame's report tells it.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

class SilhouetteCosts : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    scene_ = builtinScene("figure@light=0.3");
    renderer_ = std::make_unique<SceneRenderer>(makeEngine());
    renderer_->load(scene_);
    for (const scene::SceneObject& object : scene_.objects) casters_ += object.casts ? 1 : 0;
  }
  void TearDown() override {
    renderer_.reset();
    EngineTest::TearDown();
  }
  std::uint64_t extracted() {
    renderer_->render();
    return renderer_->engine().report().silhouettesExtracted;
  }
  scene::SceneDescription scene_;
  std::unique_ptr<SceneRenderer> renderer_;
  std::uint64_t casters_ = 0;
};

TEST_F(SilhouetteCosts, AreThoseOfWhatChanged) {
  const auto firstCaster = std::ranges::find_if(scene_.objects, &scene::SceneObject::casts);
  for (const std::string technique : {"shadow-volume", "wedges", "wedges-blended", "wedges-cells"}) {
    SCOPED_TRACE(technique);
    const std::uint64_t points = technique == "wedges-cells" ? 4 : 1;
    renderer_->choose({technique});
    EXPECT_EQ(extracted(), points * casters_);
    EXPECT_EQ(extracted(), 0u) << "unchanged";
    firstCaster->worldFromObject =
        glm::translate(glm::dmat4(1.0), glm::dvec3(0.03, 0.0, 0.0)) * firstCaster->worldFromObject;
    renderer_->setTransform(static_cast<std::size_t>(firstCaster - scene_.objects.begin()),
                            firstCaster->worldFromObject);
    EXPECT_EQ(extracted(), points) << "one caster moved";
    scene_.lights[0].centerWorld.x += 0.05;
    renderer_->setLights(scene_.lights);
    EXPECT_EQ(extracted(), points * casters_) << "the light moved";
  }
  renderer_->choose({"hard"});
  EXPECT_EQ(extracted(), 0u);
}

}  // namespace
}  // namespace halfshadow::test
