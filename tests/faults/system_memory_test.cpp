// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A system without memory: each allocation of a call fails once.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "device/uniforms.hpp"
#include "engine_fixture.hpp"
#include "faulty_gl.hpp"

namespace {
// Fails at the allocation that brings it to 0; below 0 none fails.
thread_local long allocationsLeft = -1;
thread_local long allocations = 0;
thread_local bool counting = false;

/// The driver's own failures are the driver's.
void* allocate(std::size_t bytes) {
  const bool counts = counting && halfshadow::test::faultyDriver().inside == 0;
  allocations += counts;
  if (counts && allocationsLeft >= 0 && allocationsLeft-- == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}

void* allocatedOrNull(std::size_t bytes) noexcept {
  try {
    return allocate(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
}  // namespace

void* operator new(std::size_t bytes) {
  return allocate(bytes);
}
void* operator new[](std::size_t bytes) {
  return allocate(bytes);
}
// Sanitizers have those of their own, which do not go with what is freed below.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocatedOrNull(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocatedOrNull(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace halfshadow::test {
namespace {

class SystemMemory : public EngineTest {
 protected:
  /// Outcome of a call at whose allocation number `at` memory is out.
  template <typename Call>
  static Outcome failing(long at, Call call) {
    allocationsLeft = at;
    counting = true;
    const Outcome outcome = call();
    counting = false;
    allocationsLeft = -1;
    return outcome;
  }
  template <typename Call>
  static long allocationsOf(Call call) {
    const long before = allocations;
    counting = true;
    call();
    counting = false;
    return allocations - before;
  }
};

TEST_F(SystemMemory, FramesFailAndTheNextIsRight) {
  SceneRenderer renderer(makeFaultyEngine());
  renderer.load(builtinScene("box@light=0.3"));
  renderer.desc().target.width = 48;
  renderer.desc().target.height = 36;
  long failed = 0;
  for (const std::string& technique : faultedTechniques(renderer.engine())) {
    SCOPED_TRACE(technique);
    const Image wanted =
        renderer.render(Configuration{technique, {{"map_size", "64"}, {"sampled.samples", "2"}}});
    ASSERT_TRUE(renderer.engine().trim(Trim::everything).ok());
    const long count = allocationsOf([&] { EXPECT_TRUE(renderer.engine().render(renderer.desc()).ok()); });
    for (long at = 0; at < count; at += static_cast<long>(faultStride(std::max(count / 8, 1l)))) {
      ASSERT_TRUE(renderer.engine().trim(Trim::everything).ok());
      const Outcome outcome = failing(at, [&] { return renderer.engine().render(renderer.desc()); });
      EXPECT_TRUE(outcome.ok() || outcome.code == ErrorCode::outOfMemory ||
                  outcome.code == ErrorCode::shaderFailed)
          << at << ": " << outcome.message;
      failed += !outcome.ok();
      EXPECT_EQ(renderer.render().rgba, wanted.rgba) << "after allocation " << at;
    }
  }
  EXPECT_GT(failed, 50);
  std::printf("%ld frames failed\n", failed);
}

/// Of every kind of value, each copied at some allocation.
TEST_F(SystemMemory, CopiesOfUniformsFailWhole) {
  device::UniformList uniforms;
  uniforms.set("u_number", 1.0f);
  uniforms.set("u_pairs", std::vector<glm::vec2>(5, glm::vec2(2.0f)));
  uniforms.set("u_matrix", glm::mat4(3.0f));
  uniforms.set("u_quads", std::vector<glm::vec4>(7, glm::vec4(4.0f)));
  long failed = 0;
  for (bool copied = false; !copied; ++failed) {
    ASSERT_LT(failed, 100);
    const Outcome outcome = failing(failed, [&]() -> Outcome {
      try {
        const device::UniformList copy = uniforms;
        copied = copy.entries().size() == 4;
        return {};
      } catch (const std::bad_alloc&) {
        return {ErrorCode::outOfMemory, "as it should be"};
      }
    });
    EXPECT_EQ(outcome.ok(), copied);
  }
  EXPECT_GE(failed, 4) << "the list and its two arrays, and one copy that succeeded";
}

TEST_F(SystemMemory, ObjectsLightsAndSettingsFailWhole) {
  SceneRenderer renderer(makeFaultyEngine());
  const scene::SceneDescription& scene = builtinScene("box@light=0.3");
  renderer.load(scene);
  renderer.choose({"pcss"});
  const Image wanted = renderer.render();
  const ObjectDesc object = objectDesc(scene.objects.back());
  const MeshDesc mesh = object.mesh;
  const LightDesc light = lightDesc(scene.lights.front());
  Engine& engine = renderer.engine();
  const ObjectId last = renderer.id(scene.objects.size() - 1);
  ObjectId id = 0;
  const std::function<Outcome()> calls[] = {
      [&] { return engine.addObject(object, id); },
      [&] { return engine.setVertices(last, mesh); },
      [&] { return engine.setTransform(last, object.worldFromObject); },
      [&] { return engine.setLights(&light, 1); },
      [&] { return engine.setTechnique("pcss"); },
      [&] { return engine.set("pcf.size", "a rather long text that is no number at all"); },
      [&] { return engine.trim(Trim::unused); },
  };
  for (std::size_t which = 0; which < std::size(calls); ++which) {
    for (long at = 0;; ++at) {
      id = 0;
      const long before = allocations;
      const Outcome outcome = failing(at, calls[which]);
      const bool reached = allocations - before > at;
      if (id != 0) {
        EXPECT_TRUE(engine.removeObject(id).ok());
      }
      if (!reached) break;
      EXPECT_EQ(outcome.code, ErrorCode::outOfMemory) << which << " at " << at << ": " << outcome.message;
      EXPECT_EQ(id, 0u);
    }
    EXPECT_EQ(renderer.render().rgba, wanted.rgba) << which;
  }
  Outcome outcome;
  for (long at = 0; at < 4000; at += 333) {
    std::unique_ptr<Engine> made;
    (void)failing(at, [&] {
      made.reset(Engine::create(faultyDesc(), outcome));
      return outcome;
    });
    if (!made) {
      EXPECT_NE(outcome.code, ErrorCode::ok);
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
