// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Objects that were added with the same mesh share it; nobody can see that.
#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {
constexpr int kCrates = 12;

/// A crate or, with `apart`, the same crate with a vertex that no triangle uses: another mesh that looks the
/// same.
struct Crate {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;

  explicit Crate(int apart) {
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 3; ++axis) positions.push_back((corner >> axis & 1) != 0 ? 0.3f : -0.3f);
    }
    indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
               2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    if (apart > 0) positions.insert(positions.end(), {0.01f * static_cast<float>(apart), 0.0f, 0.0f});
  }
  MeshDesc mesh() const {
    return {.positions = positions.data(),
            .vertexCount = static_cast<std::uint32_t>(positions.size() / 3),
            .indices = indices.data(),
            .indexCount = indices.size()};
  }
};

ObjectDesc crateDesc(const Crate& crate, int place) {
  ObjectDesc desc{.mesh = crate.mesh()};
  glm::dmat4 world =
      glm::translate(glm::dmat4(1.0), {1.1 * (place % 4) - 1.6, 0.5 + 0.1 * place, 1.1 * (place / 4) - 1.0});
  world = glm::rotate(world, 0.3 * place, glm::dvec3(0.2, 1.0, 0.1));
  if (place % 5 == 4) world = glm::scale(world, glm::dvec3(-1.0, 1.2, 0.8));
  std::memcpy(desc.worldFromObject, glm::value_ptr(world), sizeof desc.worldFromObject);
  return desc;
}

/// Crates over a ground, each with a mesh of its own or all with one.
class Crates {
 public:
  explicit Crates(bool apart) : apart_(apart), renderer_(makeEngine()) {
    scene::SceneDescription ground = builtinScene("figure@light=0.5");
    std::erase_if(ground.objects, [](const scene::SceneObject& object) { return object.casts; });
    renderer_.load(ground);
    for (int i = 0; i < kCrates; ++i) {
      ids_.push_back(0);
      const Outcome added = engine().addObject(crateDesc(crate(i), i), ids_.back());
      EXPECT_TRUE(added.ok()) << added.message;
    }
  }
  Engine& engine() { return renderer_.engine(); }
  SceneRenderer& renderer() { return renderer_; }
  ObjectId id(std::size_t place) const { return ids_[place]; }
  Crate crate(int place) const { return Crate(apart_ ? place + 1 : 0); }
  std::uint64_t memoryBytes() {
    renderer_.render();
    return engine().report().memoryBytes;
  }

 private:
  bool apart_;
  SceneRenderer renderer_;
  std::vector<ObjectId> ids_;
};

class Instances : public EngineTest {};

TEST_F(Instances, LookLikeObjectsWithMeshesOfTheirOwn) {
  Crates together(false), apart(true);
  for (const std::string& technique : techniquesBut(together.engine(), {})) {
    SCOPED_TRACE(technique);
    EXPECT_EQ(together.renderer().render(Configuration{technique}).rgba,
              apart.renderer().render(Configuration{technique}).rgba);
  }
}

TEST_F(Instances, HoldOneMeshOnTheGpu) {
  Crates together(false), apart(true);
  together.renderer().choose({"none"});
  apart.renderer().choose({"none"});
  const std::uint64_t shared = together.memoryBytes(), own = apart.memoryBytes();
  // Positions and indices at least; a facet stream may add to it.
  const std::uint64_t least = 8 * 12 + 36 * 2;
  EXPECT_GE(own, shared + (kCrates - 1) * least);
  for (int i = 1; i < kCrates; ++i) EXPECT_TRUE(together.engine().removeObject(together.id(i)).ok());
  EXPECT_EQ(together.memoryBytes(), shared) << "the last one holds it";
}

TEST_F(Instances, OneThatChangesItsVerticesLeavesTheOthersAsTheyWere) {
  Crates together(false), apart(true);
  for (Crates* crates : {&together, &apart}) {
    // Twice: the first time it takes a mesh of its own, the second time it has one.
    for (const float factor : {1.5f, 0.7f}) {
      Crate changed = crates->crate(3);
      for (std::size_t i = 1; i < 24; i += 3) changed.positions[i] *= factor;
      const Outcome set = crates->engine().setVertices(crates->id(3), changed.mesh());
      EXPECT_TRUE(set.ok()) << set.message;
    }
    // The same crate as at first: not the one that has changed.
    ObjectId again = 0;
    EXPECT_TRUE(crates->engine().addObject(crateDesc(crates->crate(3), 17), again).ok());
  }
  for (const std::string technique : {"hard", "shadow-volume", "wedges-cells"}) {
    SCOPED_TRACE(technique);
    EXPECT_EQ(together.renderer().render(Configuration{technique}).rgba,
              apart.renderer().render(Configuration{technique}).rgba);
  }
}

TEST_F(Instances, AreToldApartByEveryValue) {
  Crate plain(0);
  std::vector<float> normals(24, 0.0f), texcoords(16, 0.0f);
  for (std::size_t i = 1; i < 24; i += 3) normals[i] = 1.0f;
  SceneRenderer renderer(makeEngine());
  scene::SceneDescription ground = builtinScene("figure@light=0.5");
  std::erase_if(ground.objects, [](const scene::SceneObject& object) { return object.casts; });
  renderer.load(ground);
  renderer.choose({"none"});
  const auto memoryWith = [&](const MeshDesc& mesh) {
    ObjectDesc desc = crateDesc(plain, 0);
    desc.mesh = mesh;
    ObjectId id = 0;
    EXPECT_TRUE(renderer.engine().addObject(desc, id).ok());
    renderer.render();
    return renderer.engine().report().memoryBytes;
  };
  MeshDesc mesh = plain.mesh();
  std::uint64_t before = memoryWith(mesh);
  EXPECT_EQ(memoryWith(mesh), before);
  const auto addsMemory = [&](const char* what) {
    const std::uint64_t now = memoryWith(mesh);
    EXPECT_GT(now, before) << what;
    before = now;
    EXPECT_EQ(memoryWith(mesh), before) << what;
  };
  mesh.normals = normals.data();
  addsMemory("normals");
  mesh.texcoords = texcoords.data();
  addsMemory("texture coordinates");
  texcoords[5] = 0.5f;
  addsMemory("one texture coordinate");
  normals[1] = -1.0f;
  addsMemory("one normal");
  std::swap(plain.indices[0], plain.indices[33]);
  addsMemory("the order of corners");
  plain.positions[7] += 0.125f;
  addsMemory("one position");
  mesh.indexCount -= 3;
  addsMemory("a triangle less");
  // The same values, further apart.
  std::vector<float> spread;
  for (std::size_t i = 0; i < plain.positions.size(); ++i) {
    spread.push_back(plain.positions[i]);
    if (i % 3 == 2) spread.push_back(static_cast<float>(i));
  }
  mesh.positions = spread.data();
  mesh.positionStrideBytes = 16;
  EXPECT_EQ(memoryWith(mesh), before);
}

}  // namespace
}  // namespace halfshadow::test
