// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Triangles of any kind: built, mended, and what they show to a light proven to be the boundary of their
// faces.
#include <algorithm>
#include <cmath>

#include "input_reader.hpp"
#include "scene/caster_groups.hpp"
#include "scene/convex_hull.hpp"
#include "scene/light_silhouettes.hpp"
#include "scene/place.hpp"
#include "scene/silhouette_check.hpp"
#include "scene/solidity.hpp"
#include "scene/supporting_planes.hpp"
#include "test_meshes.hpp"

namespace halfshadow::fuzz {
namespace {
constexpr std::uint32_t kMostVertices = 96;
constexpr std::size_t kMostIndices = 600;
enum Flags : std::uint8_t {
  kWrapped = 1,  ///< indices modulo the number of vertices, so that most meshes are valid
  kOnAGrid = 2,  ///< positions on a coarse grid: many of them coincide or lie in one line
  kIndexed = 4,
  kMoved = 8,     ///< positions are replaced afterwards
  kTogether = 16  ///< two objects, and borders that meet are welded
};

struct Source {
  std::uint8_t flags = 0;
  glm::dvec3 light{0.0};
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
};

Source sourceOf(Input input) {
  InputReader reader(input);
  Source source{.flags = reader.byte()};
  for (int axis = 0; axis < 3; ++axis) source.light[axis] = reader.plainNumber();
  const std::uint32_t count = std::min<std::uint32_t>(reader.byte(), kMostVertices);
  for (std::uint32_t i = 0; i < count; ++i) {
    glm::vec3 position(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = reader.raw<float>();
      const bool snaps = (source.flags & kOnAGrid) != 0 && std::abs(value) < 1e6f;
      position[axis] = snaps ? std::round(value * 4.0f) / 4.0f : value;
    }
    source.positions.push_back(position);
  }
  while (!reader.atEnd() && source.indices.size() < kMostIndices) {
    const std::uint32_t index = reader.byte();
    source.indices.push_back((source.flags & kWrapped) != 0 && count > 0 ? index % count : index);
  }
  if ((source.flags & kWrapped) != 0) source.indices.resize(source.indices.size() / 3 * 3);
  return source;
}

void checkBuilt(const scene::TriangleMesh& mesh) {
  require(!mesh.indices.empty() && mesh.indices.size() % 3 == 0, "a mesh holds no whole triangles");
  require(mesh.weldedVertex.size() == mesh.positions.size() && mesh.shellOf.size() == mesh.triangleCount(),
          "a mesh does not say of each vertex and triangle what belongs together");
  for (const std::uint32_t index : mesh.indices)
    require(index < mesh.positions.size(), "an index is out of range");
  for (const std::uint32_t shell : mesh.shellOf)
    require(shell == scene::kNoShell || shell < mesh.shellCount, "a shell that there is not");
}

void checkHalfEdges(const scene::HalfEdgeMesh& mesh) {
  const auto isFace = [&](std::uint32_t face) {
    return face == scene::kNoFace || face < mesh.faces().size();
  };
  for (const glm::uvec3& face : mesh.faces()) {
    for (int k = 0; k < 3; ++k) require(face[k] < mesh.positions().size(), "a face has a corner nowhere");
  }
  for (const scene::EdgeRecord& edge : mesh.edges()) {
    require(edge.from < mesh.positions().size() && edge.to < mesh.positions().size(), "an edge ends nowhere");
    require(edge.face != scene::kNoFace && isFace(edge.face) && isFace(edge.opposite), "an edge of no face");
  }
  std::uint32_t faces = 0;
  for (const scene::CasterPart& part : mesh.parts()) {
    require(part.firstFace == faces, "parts do not follow each other");
    faces += part.faceCount;
    require(!part.closed || part.boundaryEdges == 0, "a closed part has a border");
    (void)scene::describe(part);
  }
  require(faces == mesh.faces().size(), "a face belongs to no part");
}

void checkSilhouettes(const scene::HalfEdgeMesh& mesh, const glm::dvec3& light) {
  scene::Silhouette silhouette;
  for (const glm::dvec3& from : {light, -light, glm::dvec3(1e5, 3e5, -1e4)}) {
    scene::extractSilhouette(mesh, from, silhouette);
    require(scene::silhouetteProblem(mesh, silhouette).empty(), scene::silhouetteProblem(mesh, silhouette));
  }
}

/// As techniques ask for them.
void testLightSpace(std::span<const scene::PlacedCaster> casters, const glm::dvec3& light) {
  const scene::AreaLight source{
      .centerWorld = light + glm::dvec3(0, 6, 0), .halfU = {0.5, 0, 0}, .halfV = {0, 0, -0.5}};
  const scene::LightPlane plane(source, 12.0, 1e-6);
  scene::LightSilhouettes result;
  for (const scene::LayerSplit split : {scene::LayerSplit::none, scene::LayerSplit::alongside}) {
    scene::lightSilhouettes(casters, plane, 0.25, -0.5, 1e-4, result, split);
    for (const scene::LightSilhouettes::Loop& loop : result.loops)
      require(loop.first + loop.count <= result.points.size(), "a loop of points that there are not");
    for (const scene::LightSilhouettes::Caster& caster : result.casters)
      require(caster.firstLoop + caster.loopCount <= result.loops.size(),
              "a caster of loops that there are not");
  }
}

void testTogether(const scene::TriangleMesh& mesh, const scene::CasterGeometry& geometry,
                  const glm::dvec3& light) {
  glm::dmat4 beside(1.0);
  beside[3] = glm::dvec4(1.0, 0.0, 0.25, 1.0);
  const scene::SceneCaster casters[] = {
      {.mesh = &mesh, .geometry = &geometry, .revision = 1},
      {.mesh = &mesh, .geometry = &geometry, .worldFromObject = beside, .revision = 2}};
  scene::CasterGroups groups;
  groups.update(casters);
  require(groups.placedOf(1) < groups.placed().size(), "a caster is placed nowhere");
  for (const scene::PlacedCaster& placed : groups.placed()) checkHalfEdges(*placed.mesh);
  testLightSpace(groups.placed(), light);
}

/// Others must be scaled down, or engines refuse them.
bool isPlaceable(const scene::TriangleMesh& mesh) {
  const scene::Bounds bounds = scene::boundsOf(mesh);
  return scene::isPlace(bounds.low) && scene::isPlace(bounds.high);
}

void test(Input input) {
  Source source = sourceOf(input);
  const bool indexed = (source.flags & kIndexed) != 0;
  auto built = scene::buildMesh({.positions = source.positions.empty() ? nullptr : &source.positions[0].x,
                                 .vertexCount = static_cast<std::uint32_t>(source.positions.size()),
                                 .indices = indexed ? source.indices.data() : nullptr,
                                 .indexCount = indexed ? source.indices.size() : 0});
  if (!built) {
    require(built.error().message.size() > 10, "a refusal without a sentence");
    return;
  }
  scene::TriangleMesh& mesh = *built;
  checkBuilt(mesh);
  (void)scene::recenter(mesh);
  (void)scene::enclosingPoints(mesh);
  (void)scene::supportingPlanesOf(mesh, glm::dvec3(0.0));
  const double solid = scene::solidity(mesh);
  require(solid >= 0.0 && solid <= 1.0, "a solidity beyond [0, 1]");
  scene::CasterGeometry geometry;
  checkHalfEdges(geometry.halfEdges(mesh));
  checkSilhouettes(geometry.halfEdges(mesh), source.light);
  if (isPlaceable(mesh)) {
    const scene::PlacedCaster alone{.mesh = &geometry.halfEdges(mesh)};
    testLightSpace({&alone, 1}, source.light);
    if ((source.flags & kTogether) != 0) testTogether(mesh, geometry, source.light);
  }
  if ((source.flags & kMoved) == 0) return;
  for (glm::vec3& position : mesh.positions) position = {position.y, -position.x, position.z * 0.5f};
  (void)scene::turnShellsOutward(mesh);
  checkBuilt(mesh);
  geometry.positionsChanged();
  checkSilhouettes(geometry.halfEdges(mesh), source.light);
}

Bytes seedOf(const testing::Triangles& triangles, std::uint8_t flags) {
  InputWriter writer;
  writer.byte(flags).numbers({1.5, 4.0, -2.0}).byte(triangles.positions.size());
  for (const glm::vec3& position : triangles.positions)
    for (int axis = 0; axis < 3; ++axis) writer.raw(position[axis]);
  for (const std::uint32_t index : triangles.indices) writer.byte(index);
  return writer.bytes;
}

std::vector<Bytes> seeds() {
  testing::Triangles two = testing::cube();
  two.append(testing::cube(), {1.0f, 0.5f, 0.0f});
  testing::Triangles open = testing::cube();
  open.indices.resize(open.indices.size() - 6);
  testing::Triangles turned = testing::sphere(0);
  turned.flip(3);
  std::vector<Bytes> all;
  for (const testing::Triangles& shape :
       {testing::cube(), testing::sphere(0), testing::sphere(1), testing::sheet(4), testing::sheet(3, 0.5),
        testing::fold(), testing::moebius(), two, open, turned}) {
    if (shape.positions.size() > kMostVertices) continue;
    for (const int flags : {kIndexed | kWrapped | kMoved, kIndexed | kWrapped | kOnAGrid | kTogether})
      all.push_back(seedOf(shape, static_cast<std::uint8_t>(flags)));
  }
  all.push_back(seedOf(testing::cube(), kIndexed));
  return all;
}
}  // namespace

const Target& target() {
  static const Target made{.name = "mesh", .test = test, .seeds = seeds, .largestInput = 2048};
  return made;
}

}  // namespace halfshadow::fuzz
