// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a frame does not need goes.
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine_fixture.hpp"
#include "host_framebuffer.hpp"

namespace halfshadow::test {
namespace {

/// So many frames by default; HALFSHADOW_TEST_FRAMES for long runs.
int frames(int bounded) {
  const char* asked = std::getenv("HALFSHADOW_TEST_FRAMES");
  return asked ? std::max(std::atoi(asked), 1) : bounded;
}

class Memory : public EngineTest {
 protected:
  static constexpr const char* kScene = "box@light=0.3";
  /// As a fresh engine ends that draws this alone.
  static MemoryRecord fresh(const Configuration& configuration, const RenderDesc& desc,
                            const std::vector<scene::AreaLight>& lights) {
    SceneRenderer renderer(makeEngine());
    renderer.load(builtinScene(kScene));
    renderer.setLights(lights);
    renderer.desc() = desc;
    renderer.choose(configuration);
    stand(renderer);
    return renderer.engine().memory();
  }
  /// What only the first frame needed goes while nothing changes.
  static void stand(SceneRenderer& renderer) {
    for (int i = 0; i < 12; ++i) {
      const Outcome drawn = renderer.engine().render(renderer.desc());
      EXPECT_TRUE(drawn.ok()) << drawn.message;
    }
  }
  static void expectSame(const MemoryRecord& found, const MemoryRecord& wanted) {
    EXPECT_EQ(found.bytes, wanted.bytes);
    EXPECT_EQ(found.textures, wanted.textures);
    EXPECT_EQ(found.renderbuffers, wanted.renderbuffers);
    EXPECT_EQ(found.framebuffers, wanted.framebuffers);
    EXPECT_EQ(found.buffers, wanted.buffers);
  }
  static std::vector<scene::AreaLight> lights(int count) {
    std::vector<scene::AreaLight> several;
    for (int i = 0; i < count; ++i) {
      several.push_back(builtinScene(kScene).lights.front());
      several.back().centerWorld.x += 1.5 * i;
    }
    return several;
  }
};

TEST_F(Memory, ResizesAndTechniquesLeaveNothing) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene(kScene));
  renderer.setLights(lights(4));
  const std::vector<std::string> techniques = techniquesBut(renderer.engine(), {});
  const RenderDesc last = renderer.desc();
  const int resizes = frames(400);
  std::vector<std::uint64_t> early(techniques.size()), late(techniques.size());
  for (int i = 0; i < resizes; ++i) {
    renderer.desc().target.width = 16 + i % 97;
    renderer.desc().target.height = 16 + i % 89;
    // Each technique for a while, so that what it holds at several sizes at once is seen.
    const auto which = static_cast<std::size_t>(i) * techniques.size() / static_cast<std::size_t>(resizes);
    renderer.choose({techniques[which], {{"map_size", "64"}, {"sampled.samples", "4"}}});
    renderer.desc().output = i % 2 == 0 ? Output::shaded : Output::visibility;
    const HostFramebuffer hosts(renderer.desc().target.width, renderer.desc().target.height);
    renderer.desc().target.kind = i % 3 == 0 ? TargetDesc::Kind::host : TargetDesc::Kind::engine;
    renderer.desc().target.framebuffer = hosts.name();
    const Outcome drawn = renderer.engine().render(renderer.desc());
    ASSERT_TRUE(drawn.ok()) << techniques[which] << ": " << drawn.message;
    const auto inTechnique =
        static_cast<std::size_t>(i) * techniques.size() % static_cast<std::size_t>(resizes);
    std::uint64_t& most = inTechnique < static_cast<std::size_t>(resizes) / 2 ? early[which] : late[which];
    most = std::max(most, renderer.engine().memory().bytes);
  }
  // In the second half of its frames a technique holds no more sizes than in the first: half a megabyte is
  // what the images of five of them differ by at most, and less than those of ten more.
  for (std::size_t i = 0; i < techniques.size(); ++i)
    EXPECT_LE(late[i], early[i] + (std::uint64_t{1} << 19)) << techniques[i];
  const Configuration end{"hard", {{"map_size", "64"}}};
  renderer.desc() = last;
  renderer.choose(end);
  stand(renderer);
  expectSame(renderer.engine().memory(), fresh(end, renderer.desc(), lights(4)));
  EXPECT_GT(renderer.engine().memory().programs, 1) << "programs stay for the next switch";
  EXPECT_TRUE(renderer.engine().trim(Trim::unused).ok());
  EXPECT_EQ(renderer.engine().memory().programs, fresh(end, renderer.desc(), lights(4)).programs);
}

TEST_F(Memory, MovingLightsLeaveNothing) {
  for (const char* technique : {"shadow-width", "occlusion-textures", "pcss-mip", "wedges-blended"}) {
    SCOPED_TRACE(technique);
    const Configuration chosen{technique, {{"map_size", "64"}, {"occlusion-textures.slices", "4"}}};
    SceneRenderer renderer(makeEngine());
    renderer.load(builtinScene(kScene));
    renderer.desc().target.width = renderer.desc().target.height = 32;
    renderer.choose(chosen);
    auto light = lights(1);
    const glm::dvec3 home = light[0].centerWorld;
    std::uint64_t afterWarmUp = 0, most = 0;
    const int count = frames(std::string(technique) == "shadow-width" ? 1000 : 200);
    for (int i = 0; i < count; ++i) {
      const double angle = 0.1 * (i % 64);
      light[0].centerWorld =
          home + glm::dvec3(3.0 * std::cos(angle), std::sin(3 * angle), 3.0 * std::sin(angle));
      renderer.setLights(light);
      const Outcome drawn = renderer.engine().render(renderer.desc());
      ASSERT_TRUE(drawn.ok()) << drawn.message;
      (i < 80 ? afterWarmUp : most) = std::max(i < 80 ? afterWarmUp : most, renderer.engine().memory().bytes);
    }
    // The path repeats after 64 frames: nothing larger than in the first round comes later.
    EXPECT_LE(most, afterWarmUp);
    light[0].centerWorld = home;
    renderer.setLights(light);
    stand(renderer);
    expectSame(renderer.engine().memory(), fresh(chosen, renderer.desc(), light));
  }
}

TEST_F(Memory, ObjectsThatShowOneImageShareItsTexture) {
  const std::unique_ptr<Engine> engine = makeEngine();
  ASSERT_NE(engine, nullptr);
  const scene::SceneDescription& scene = builtinScene(kScene);
  std::vector<std::uint8_t> pixels(64 * 32 * 4);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * 37);
  ObjectDesc desc = objectDesc(scene.objects[0]);
  std::vector<ObjectId> ids;
  const auto texturesAfterAdding = [&] {
    ids.push_back(0);
    const Outcome added = engine->addObject(desc, ids.back());
    EXPECT_TRUE(added.ok()) << added.message;
    return engine->memory().textures;
  };
  const int before = texturesAfterAdding();
  desc.baseColorPixels = pixels.data(), desc.baseColorWidth = 64, desc.baseColorHeight = 32;
  EXPECT_EQ(texturesAfterAdding(), before + 1);
  const std::vector<std::uint8_t> same = pixels;
  desc.baseColorPixels = same.data();
  EXPECT_EQ(texturesAfterAdding(), before + 1) << "known by what it holds";
  desc.alphaCutoff = 0.5f;
  EXPECT_EQ(texturesAfterAdding(), before + 2) << "its alpha";
  EXPECT_EQ(texturesAfterAdding(), before + 2);
  pixels[4 * 1000] ^= 1;
  desc.baseColorPixels = pixels.data();
  EXPECT_EQ(texturesAfterAdding(), before + 4) << "another image";
  for (const ObjectId id : ids) EXPECT_TRUE(engine->removeObject(id).ok());
  EXPECT_EQ(engine->memory().textures, before) << "the last object takes them along";
}

TEST_F(Memory, StandstillFreesToo) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene(kScene));
  renderer.render(Configuration{"hard"}, Output::shaded);
  renderer.desc().target.width = 64;
  stand(renderer);
  expectSame(renderer.engine().memory(), fresh({"hard"}, renderer.desc(), lights(1)));
}

TEST_F(Memory, TrimmedOfEverythingItDrawsTheSame) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene(kScene));
  const MemoryRecord meshes = renderer.engine().memory();
  for (const std::string& technique : techniquesBut(renderer.engine(), {})) {
    SCOPED_TRACE(technique);
    const Image before = renderer.render(Configuration{technique});
    ASSERT_TRUE(renderer.engine().trim(Trim::unused).ok());
    EXPECT_EQ(renderer.render().rgba, before.rgba);
    ASSERT_TRUE(renderer.engine().trim(Trim::everything).ok());
    EXPECT_EQ(renderer.engine().outputTexture(), 0u);
    EXPECT_EQ(renderer.engine().memory().textures, 0);
    EXPECT_EQ(renderer.engine().memory().programs, 0);
    EXPECT_LE(renderer.engine().memory().bytes, meshes.bytes + 24);  // one triangle over the viewport
    EXPECT_EQ(renderer.render().rgba, before.rgba);
  }
}

TEST_F(Memory, ALimitIsKeptAndNamed) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene(kScene));
  const Image wanted = renderer.render(Configuration{"hard"});
  const std::uint64_t enough = renderer.engine().memory().bytes;
  ASSERT_TRUE(renderer.engine().trim(Trim::everything).ok());
  renderer.engine().setMemoryLimit(enough);
  for (const char* technique : {"hard", "pcss-mip", "hard", "shadow-width", "hard"}) {
    renderer.choose({technique});
    const Outcome outcome = renderer.engine().render(renderer.desc());
    EXPECT_LE(renderer.engine().memory().bytes, enough);
    if (std::string(technique) == "hard") {
      EXPECT_TRUE(outcome.ok()) << outcome.message;
    } else {
      EXPECT_EQ(outcome.code, ErrorCode::outOfMemory);
      EXPECT_NE(std::string(outcome.message).find("setMemoryLimit"), std::string::npos) << outcome.message;
    }
  }
  EXPECT_EQ(renderer.render().rgba, wanted.rgba);
  renderer.engine().setMemoryLimit(enough - 1);
  ASSERT_TRUE(renderer.engine().trim(Trim::everything).ok());
  EXPECT_EQ(renderer.engine().render(renderer.desc()).code, ErrorCode::outOfMemory);
  renderer.engine().setMemoryLimit(0);
  EXPECT_EQ(renderer.render().rgba, wanted.rgba);
}

TEST_F(Memory, EveryUploadIsReported) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene(kScene));
  renderer.choose({"hard"});
  renderer.render();
  EXPECT_GE(renderer.report().bufferBytesUploaded, 12u * 8) << "the meshes that were added before it";
  const scene::SceneObject& object = builtinScene(kScene).objects.back();
  ASSERT_TRUE(renderer.engine()
                  .setVertices(renderer.id(builtinScene(kScene).objects.size() - 1), objectDesc(object).mesh)
                  .ok());
  renderer.render();
  EXPECT_GE(renderer.report().bufferBytesUploaded, 12u * object.mesh->positions.size());
  renderer.render();
  EXPECT_EQ(renderer.report().bufferBytesUploaded, 0u);
}

}  // namespace
}  // namespace halfshadow::test
