// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A host that does everything at once, for long. HALFSHADOW_TEST_FRAMES=10000 for the long run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <random>
#include <thread>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

int frames(int bounded) {
  const char* asked = std::getenv("HALFSHADOW_TEST_FRAMES");
  return asked ? std::max(std::atoi(asked), 1) : bounded;
}

/// What a host did last, so that a fresh engine can be brought to the same.
struct HostScene {
  const scene::SceneDescription& description;
  std::vector<glm::dmat4> transforms;
  std::vector<bool> present;
  std::vector<scene::AreaLight> lights;
  std::string technique;
  int width = 64, height = 48;
};

/// One engine with the scene, whose objects come and go.
class Host {
 public:
  explicit Host(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
  Engine& engine() { return *engine_; }
  /// The objects, first come first. Another engine that gets them in this order draws them in this order.
  const std::vector<std::size_t>& order() const { return order_; }
  void bring(const HostScene& scene, const std::vector<std::size_t>& order) {
    ids_.resize(scene.present.size(), 0);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (scene.present[i] || ids_[i] == 0) continue;
      EXPECT_TRUE(engine_->removeObject(ids_[i]).ok());
      ids_[i] = 0;
      std::erase(order_, i);
    }
    for (const std::size_t i : order) {
      ObjectDesc object = objectDesc(scene.description.objects[i]);
      std::copy_n(&scene.transforms[i][0][0], 16, object.worldFromObject);
      if (scene.present[i] && ids_[i] == 0) {
        EXPECT_TRUE(engine_->addObject(object, ids_[i]).ok());
        order_.push_back(i);
      }
      if (ids_[i] != 0) {
        EXPECT_TRUE(engine_->setTransform(ids_[i], object.worldFromObject).ok());
      }
    }
    std::vector<LightDesc> lights;
    for (const scene::AreaLight& light : scene.lights) lights.push_back(lightDesc(light));
    EXPECT_TRUE(engine_->setLights(lights.data(), lights.size()).ok());
    EXPECT_TRUE(engine_->setTechnique(scene.technique.c_str()).ok());
    desc_ = {};
    desc_.camera = cameraDesc(scene.description.camera.value());
    desc_.target.width = scene.width;
    desc_.target.height = scene.height;
    desc_.output = scene.lights.size() % 2 == 0 ? Output::visibility : Output::shaded;
  }
  void bring(const HostScene& scene) {
    std::vector<std::size_t> order(scene.present.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    bring(scene, order);
  }
  std::vector<std::uint8_t> draw() {
    const Outcome drawn = engine_->render(desc_);
    EXPECT_TRUE(drawn.ok()) << drawn.message;
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(desc_.target.width * desc_.target.height * 4));
    EXPECT_TRUE(engine_->readOutput(rgba.data(), rgba.size()).ok());
    return rgba;
  }
  void setSmall() {
    EXPECT_TRUE(engine_->set("map_size", "64").ok());
    EXPECT_TRUE(engine_->set("sampled.samples", "2").ok());
  }

 private:
  std::unique_ptr<Engine> engine_;
  std::vector<ObjectId> ids_;
  std::vector<std::size_t> order_;
  RenderDesc desc_;
};

std::string kindsOf(const Engine& engine) {
  const MemoryRecord memory = engine.memory();
  return std::to_string(memory.textures) + " textures, " + std::to_string(memory.renderbuffers) +
         " renderbuffers, " + std::to_string(memory.framebuffers) + " framebuffers, " +
         std::to_string(memory.buffers) + " buffers, " + std::to_string(memory.programs) + " programs";
}

/// Draws as an engine that has seen no other frame, and holds no more than that one.
void expectFresh(Host& host, const HostScene& scene, std::unique_ptr<Engine> engine) {
  Host fresh(std::move(engine));
  fresh.setSmall();
  fresh.bring(scene, host.order());
  EXPECT_EQ(host.draw(), fresh.draw());
  for (int i = 0; i < 12; ++i) EXPECT_EQ(host.draw(), fresh.draw());
  EXPECT_TRUE(host.engine().trim(Trim::unused).ok());
  EXPECT_TRUE(fresh.engine().trim(Trim::unused).ok());
  // A last frame that moved little needed fewer images than a first one.
  EXPECT_LE(host.engine().memory().bytes, fresh.engine().memory().bytes);
  EXPECT_LE(host.engine().liveObjectCount(), fresh.engine().liveObjectCount())
      << kindsOf(host.engine()) << " of " << scene.technique << "; fresh: " << kindsOf(fresh.engine());
}

HostScene startScene() {
  const scene::SceneDescription& description = builtinScene("box@light=0.3");
  HostScene scene{.description = description, .lights = description.lights, .technique = "hard"};
  for (const scene::SceneObject& object : description.objects) {
    scene.transforms.push_back(object.worldFromObject);
    scene.present.push_back(true);
  }
  return scene;
}

void change(HostScene& scene, const std::vector<std::string>& techniques, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return random() % count; };
  const std::size_t object = below(scene.present.size());
  if (below(3) != 0) scene.transforms[object][3].x += 0.25 * (static_cast<double>(below(9)) - 4.0);
  if (below(11) == 0) scene.present[object] = !scene.present[object];
  if (below(5) == 0) scene.lights.front().centerWorld.z += 0.25 * (static_cast<double>(below(9)) - 4.0);
  if (below(40) == 0) {
    scene.lights.resize(1);
    for (std::size_t i = below(3); i > 0; --i) {
      scene.lights.push_back(scene.lights.front());
      scene.lights.back().centerWorld.x += 2.0 * static_cast<double>(i);
    }
  }
  if (below(13) == 0) {
    scene.width = 24 + static_cast<int>(below(48));
    scene.height = 24 + static_cast<int>(below(48));
  }
  if (below(10) == 0) scene.technique = techniques[below(techniques.size())];
}

class Load : public EngineTest {};

TEST_F(Load, TwoEnginesOnOneContextDrawWhatFreshOnesDraw) {
  Host first(makeEngine()), second(makeEngine({}, HostState::leaveDirty));
  first.setSmall();
  second.setSmall();
  const auto techniques = techniquesBut(first.engine(), {});
  HostScene scene = startScene(), other = startScene();
  std::mt19937 random(20261);
  const int count = frames(240), compareEach = std::max(count / 12, 1);
  for (int i = 0; i < count; ++i) {
    change(scene, techniques, random);
    change(other, techniques, random);
    first.bring(scene);
    second.bring(other);
    first.draw();
    second.draw();
    ASSERT_EQ(hostGl().getError(), static_cast<GLenum>(GL_NO_ERROR)) << "frame " << i;
    if (i % compareEach != compareEach - 1) continue;
    SCOPED_TRACE("frame " + std::to_string(i) + ", " + scene.technique + ", " + other.technique);
    expectFresh(first, scene, makeEngine());
    expectFresh(second, other, makeEngine());
  }
}

TEST_F(Load, TwoContextsOnTwoThreads) {
  const auto run = [](int seed, int count) {
    auto context = createHeadless({.driver = "llvmpipe"});
    ASSERT_TRUE(context.ok()) << context.error().message;
    const auto makeEngineHere = [&] {
      Outcome outcome;
      std::unique_ptr<Engine> engine(
          Engine::create({.getProcAddress =
                              [](const char* name, void* user) {
                                return static_cast<HeadlessContext*>(user)->getProcAddress(name);
                              },
                          .getProcAddressUser = context->get()},
                         outcome));
      EXPECT_TRUE(outcome.ok()) << outcome.message;
      return engine;
    };
    Host host(makeEngineHere());
    host.setSmall();
    const auto techniques = techniquesBut(host.engine(), {});
    HostScene scene = startScene();
    std::mt19937 random(static_cast<unsigned>(seed));
    for (int i = 0; i < count; ++i) {
      change(scene, techniques, random);
      host.bring(scene);
      host.draw();
    }
    expectFresh(host, scene, makeEngineHere());
    const auto getError =
        reinterpret_cast<decltype(&::glGetError)>(context.value()->getProcAddress("glGetError"));
    EXPECT_EQ(getError(), static_cast<GLenum>(GL_NO_ERROR));
  };
  (void)builtinScene("box@light=0.3");
  std::thread other([&] { run(7, frames(60)); });
  other.join();
  std::thread left([&] { run(1, frames(60)); }), right([&] { run(2, frames(60)); });
  left.join();
  right.join();
}

}  // namespace
}  // namespace halfshadow::test
