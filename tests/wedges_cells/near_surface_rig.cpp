// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "near_surface_rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <random>

#include "coverage/trapezoid.hpp"
#include "scene/half_edge_mesh.hpp"

namespace halfshadow::test {

/// A closed surface around the origin with hollows as deep as half its radius.
scene::TriangleMesh bumpyBall(int slices, int stacks) {
  scene::TriangleMesh mesh;
  const double pi = 3.14159265358979323846;
  const auto add = [&](double polar, double around) {
    const glm::dvec3 d(std::sin(polar) * std::cos(around), std::cos(polar),
                       std::sin(polar) * std::sin(around));
    const double radius = 1.0 + 0.35 * std::sin(3.0 * around) * std::sin(polar) * std::cos(2.0 * polar);
    mesh.positions.emplace_back(glm::vec3(radius * d));
  };
  add(0.0, 0.0);
  for (int s = 1; s < stacks; ++s) {
    for (int k = 0; k < slices; ++k) add(pi * s / stacks, 2.0 * pi * k / slices);
  }
  add(pi, 0.0);
  const auto at = [&](int s, int k) { return static_cast<std::uint32_t>(1 + (s - 1) * slices + k % slices); };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int k = 0; k < slices; ++k) {
    triangle(0, at(1, k + 1), at(1, k));
    triangle(last, at(stacks - 1, k), at(stacks - 1, k + 1));
    for (int s = 1; s + 1 < stacks; ++s) {
      triangle(at(s, k), at(s, k + 1), at(s + 1, k));
      triangle(at(s, k + 1), at(s + 1, k + 1), at(s + 1, k));
    }
  }
  return mesh;
}

/// An open sheet with folds.
scene::TriangleMesh bentSheet(int side) {
  scene::TriangleMesh mesh;
  for (int z = 0; z <= side; ++z) {
    for (int x = 0; x <= side; ++x) {
      const float a = 2.0f * static_cast<float>(x) / static_cast<float>(side) - 1.0f;
      const float b = 2.0f * static_cast<float>(z) / static_cast<float>(side) - 1.0f;
      mesh.positions.emplace_back(a, 0.5f * std::sin(4.0f * a + b) + 0.2f * std::cos(5.0f * b), b);
    }
  }
  const auto at = [&](int x, int z) { return static_cast<std::uint32_t>(z * (side + 1) + x); };
  for (int z = 0; z < side; ++z) {
    for (int x = 0; x < side; ++x) {
      mesh.indices.insert(mesh.indices.end(), {at(x, z), at(x, z + 1), at(x + 1, z)});
      mesh.indices.insert(mesh.indices.end(), {at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
    }
  }
  return mesh;
}

/// How often the segment leaves the closed surface through one of its triangles, or meets one of the open.
int exits(const scene::TriangleMesh& mesh, Surface surface, const glm::dvec3& from, const glm::dvec3& to) {
  int count = 0;
  const glm::dvec3 d = to - from;
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[f]]),
        e1 = glm::dvec3(mesh.positions[mesh.indices[f + 1]]) - a,
        e2 = glm::dvec3(mesh.positions[mesh.indices[f + 2]]) - a;
    const glm::dvec3 p = glm::cross(d, e2);
    const double det = glm::dot(e1, p);
    // Along the outward normal; det is its negated dot with d.
    if (surface == Surface::closed ? det > -1e-15 : std::abs(det) < 1e-15) continue;
    const glm::dvec3 s = from - a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, t = glm::dot(e2, q) / det;
    count += u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 1.0;
  }
  return count;
}

namespace {
/// Whether nothing of the box hides any of the light's part from the receiver.
bool misses(const outlines::FacetTree::Node& node, const outlines::SubLight& light,
            const glm::dvec3& receiver) {
  const glm::dvec3 low = glm::dvec3(node.low) - receiver, high = glm::dvec3(node.high) - receiver;
  if (high.z <= 0.0) return true;
  const double nearest = std::max(low.z, 0.0);
  for (int k = 0; k < 2; ++k) {
    const double least = light.center[k] - light.half, most = light.center[k] + light.half;
    if (high[k] < std::min(least * nearest, least * high.z)) return true;
    if (low[k] > std::max(most * nearest, most * high.z)) return true;
  }
  return false;
}

/// Appends what a fragment meets in a tree, as records.
void walkTree(const outlines::FacetTree& tree, const outlines::ListRecord& from,
              const outlines::SubLight& light, const glm::dvec3& receiver,
              std::vector<outlines::ListRecord>& met) {
  for (std::uint32_t n = 0; n < tree.nodes.size();) {
    const outlines::FacetTree::Node& node = tree.nodes[n];
    const bool missed = misses(node, light, receiver);
    const bool byContour = !node.isLeaf && node.loopCount > 0 && node.low.z > receiver.z;
    for (std::uint32_t l = 0; !missed && (node.isLeaf || byContour) && l < node.loopCount; ++l) {
      const outlines::FacetTree::Loop& loop = tree.loops[node.firstLoop + l];
      for (std::uint32_t k = 0; k <= loop.count; ++k) {
        met.push_back({.ti = tree.points[loop.first + k % loop.count],
                       .subLight = from.subLight,
                       .startsLoop = k == 0,
                       .closesLoop = k == loop.count,
                       .oneSided = node.isLeaf});
      }
    }
    n = missed || byContour ? node.end : n + 1;
  }
}

/// The list as if what is met in trees, with which it begins, stood in it.
std::vector<outlines::ListRecord> withTrees(std::span<const outlines::ListRecord> list,
                                            std::span<const outlines::FacetTree* const> trees,
                                            std::span<const outlines::SubLight> lights,
                                            const glm::dvec3& receiver) {
  const auto others = std::ranges::find_if(list, [](const outlines::ListRecord& record) {
    return record.behindFacet != outlines::ListRecord::kTree;
  });
  std::vector<outlines::ListRecord> met;
  for (std::uint8_t s = 0; s < lights.size(); ++s) {
    for (outlines::ListRecord record : std::span(list.begin(), others)) {
      if ((record.treeFor >> s & 1) == 0) continue;
      record.subLight = s;
      walkTree(*trees[record.tree], record, lights[s], receiver, met);
      if (record.end == outlines::ListRecord::End::none) continue;
      // A loop without an inside, to end the caster with.
      for (int k = 0; k < 2; ++k) met.push_back({.subLight = s, .startsLoop = k == 0, .closesLoop = k == 1});
      met.back().end = record.end;
      met.back().firstSide = record.firstSide;
    }
  }
  met.insert(met.end(), others, list.end());
  return met;
}

using CoveredCells = std::array<double, 4>;

/// What a fragment at `receiver` (t, i) makes of its list: layers that cover each of the four cells of each
/// sub-light.
std::array<CoveredCells, 4> walk(std::span<const outlines::ListRecord> list,
                                 std::span<const outlines::SubLight> lights, const glm::dvec3& receiver) {
  std::array<CoveredCells, 4> covered{};
  CoveredCells caster{}, firstSide{};
  std::vector<coverage::Projected<double>> loop;
  std::vector<coverage::FlatPoint<double>> flat;
  for (const outlines::ListRecord& record : list) {
    if (record.startsLoop) loop.clear();
    const outlines::SubLight& light = lights[record.subLight];
    const glm::dvec3 q = glm::dvec3(record.ti) - receiver;
    if (!record.closesLoop) {
      loop.push_back(
          {(q.x - light.center.x * q.z) / light.half, (q.y - light.center.y * q.z) / light.half, q.z});
      continue;
    }
    coverage::clipNear<double>(loop, 1e-9, flat);
    for (std::size_t cell = 0; cell < 4; ++cell) {
      const double share =
          coverage::loopCoverage<double>(flat, {cell % 2 == 0 ? -1.0 : 0.0, cell < 2 ? -1.0 : 0.0, 1.0, 1.0});
      caster[cell] += record.oneSided ? std::max(share, 0.0) : share;
    }
    if (record.end == outlines::ListRecord::End::none) continue;
    for (std::size_t cell = 0; cell < 4; ++cell) {
      if (!record.firstSide) covered[record.subLight][cell] += std::max(caster[cell], firstSide[cell]);
    }
    firstSide = record.firstSide ? caster : CoveredCells{};
    caster = {};
  }
  return covered;
}

/// Corner 0, 1 or 2, counter-clockwise, of a triangle over the light's square that holds of it what lies
/// behind the receiver's facet.
glm::dvec2 behindCorner(const scene::LightPlane& plane, const glm::dvec3& normal, const glm::dvec3& receiver,
                        int corner) {
  const auto height = [&](double a, double b) {
    return glm::dot(normal, plane.toWorld({a, b, 0.0}) - receiver);
  };
  const double middle = height(0, 0);
  const glm::dvec2 gradient(height(1, 0) - middle, height(0, 1) - middle);
  const double length = glm::length(gradient);
  const glm::dvec2 inward = -gradient / length;
  // Beyond the square, how far the facet's plane passes makes no difference.
  const glm::dvec2 foot = inward * std::clamp(middle / length, -4.0, 4.0);
  constexpr double kReach = 50.0;
  const glm::dvec2 along(inward.y, -inward.x);
  return foot + kReach * (corner == 0 ? along : corner == 1 ? inward : -along);
}

/// Of four sub-lights' cells: those that are covered wholly have no records.
double coveredShare(const outlines::TileList& list, std::span<const outlines::ListRecord> records,
                    const std::array<CoveredCells, 4>& covered) {
  std::array<bool, 4> listed{};
  for (const outlines::ListRecord& record : records) {
    if (record.behindFacet != outlines::ListRecord::kTree) listed[record.subLight] = true;
  }
  double share = 4 - std::popcount(list.litSubLights) - std::count(listed.begin(), listed.end(), true);
  for (const auto& cells : covered) {
    for (const double cell : cells) share += 0.25 * std::clamp(cell, 0.0, 1.0);
  }
  return 0.25 * share;
}

void count(Deviation& result, double expected, double actual) {
  ++result.receivers;
  result.penumbra += expected > 0.01 && expected < 0.99;
  result.largest = std::max(result.largest, std::abs(actual - expected));
  result.square += (actual - expected) * (actual - expected);
}

/// A surface's lists for its own tiles, and all that they refer to.
struct OwnLists {
  scene::TriangleMesh mesh;
  scene::HalfEdgeMesh halfEdges;
  scene::PlacedCaster caster;
  scene::AreaLight area;
  scene::LightPlane plane;
  outlines::ListSpace space;
  std::vector<outlines::SubLightLoops> loops;
  outlines::NearSurfaces surfaces;
  outlines::ReceiverTiles tiles;
  outlines::TileLists lists;
};

std::unique_ptr<OwnLists> ownLists(const scene::TriangleMesh& shape, double lightHalf,
                                   std::span<const outlines::SubLight> lights, Origin origin, Surface surface,
                                   std::size_t mostOwnFacets, const Workers& workers = {},
                                   double tilt = 0.0) {
  auto own = std::make_unique<OwnLists>();
  const auto built = scene::buildMesh({.positions = &shape.positions.front().x,
                                       .vertexCount = static_cast<std::uint32_t>(shape.positions.size()),
                                       .indices = shape.indices.data(),
                                       .indexCount = shape.indices.size()});
  EXPECT_TRUE(built.ok());
  own->mesh = *built;
  own->halfEdges = scene::HalfEdgeMesh::build(own->mesh);
  own->caster = {.mesh = &own->halfEdges};
  const glm::dvec3 halfU(lightHalf * std::cos(tilt), -lightHalf * std::sin(tilt), 0.0);
  const auto area = scene::areaLightFromVectors({1.0, 5.0, 0.5}, halfU, {0, 0, lightHalf});
  EXPECT_TRUE(area.ok());
  own->area = *area;
  own->plane = scene::LightPlane(own->area, 8.0, 1e-4);
  own->space = outlines::ListSpace(own->plane);
  if (origin == Origin::caster) {
    const glm::dvec3 middle = own->plane.fromWorld(glm::dvec3(0.0));
    own->space.originT = glm::dvec2(middle) / middle.z;
    own->space.originI = 1.0 / middle.z;
  }
  const std::span<const scene::PlacedCaster> casters(&own->caster, 1);
  for (const outlines::SubLight& light : lights) {
    scene::LightSilhouettes silhouettes;
    scene::lightSilhouettes(casters, own->plane, light.center.x, light.center.y, 1e-3, silhouettes,
                            scene::LayerSplit::alongside);
    own->loops.push_back(outlines::loopsOf(silhouettes, casters, light, own->space));
  }
  own->surfaces = outlines::NearSurfaces(casters, own->space, 1e-3);
  own->tiles = receiverTiles({.mesh = &own->mesh, .closed = surface == Surface::closed, .withPatches = true},
                             own->space, shadowedTangents(own->loops, -10.0), 0.05, 64, 1e-3);
  own->lists =
      tileLists(own->loops, own->surfaces, own->tiles, {.ownObject = 0, .mostOwnFacets = mostOwnFacets},
                outlines::ListedEdges::all, ~std::size_t{0}, workers);
  return own;
}
}  // namespace

ListCost ownListCost(const scene::TriangleMesh& shape, double lightHalf,
                     std::span<const outlines::SubLight> lights) {
  const std::unique_ptr<OwnLists> own =
      ownLists(shape, lightHalf, lights, Origin::caster, Surface::closed, ~std::size_t{0});
  return {.facetTests = own->lists.facetTests,
          .tiles = own->lists.partialTiles,
          .facets = own->mesh.indices.size() / 3,
          .records = own->lists.records.size()};
}

std::vector<double> ownListNumbers(const scene::TriangleMesh& shape, double lightHalf, Surface surface,
                                   std::size_t mostOwnFacets, const Workers& workers) {
  static constexpr auto kQuarters = outlines::subLights();
  const std::unique_ptr<OwnLists> own =
      ownLists(shape, lightHalf, kQuarters, Origin::caster, surface, mostOwnFacets, workers);
  const outlines::TileLists& lists = own->lists;
  std::vector<double> numbers{double(lists.longestList),    double(lists.partialTiles),
                              double(lists.facetTests),     double(lists.oneSided),
                              double(lists.sides),          double(lists.behindFacets),
                              double(lists.amongReceivers), double(lists.cutShort)};
  for (const outlines::TileList& tile : lists.tiles) {
    for (const double number :
         {double(tile.first), double(tile.count), double(tile.casters), double(tile.litSubLights),
          double(tile.leadsIntoTrees), double(tile.apart), double(tile.amongReceivers)})
      numbers.push_back(number);
  }
  for (const outlines::ListRecord& record : lists.records) {
    for (const double number : {double(record.ti.x), double(record.ti.y), double(record.ti.z),
                                double(record.subLight), double(record.startsLoop), double(record.closesLoop),
                                double(record.oneSided), double(record.behindFacet), double(record.tree),
                                double(record.treeFor), double(record.end), double(record.firstSide)})
      numbers.push_back(number);
  }
  for (const outlines::FacetTree* tree : lists.trees) {
    numbers.push_back(double(tree->nodes.size()));
    for (const glm::vec3& point : tree->points) numbers.insert(numbers.end(), {point.x, point.y, point.z});
  }
  return numbers;
}

Deviation deviation(const scene::TriangleMesh& shape, double lightHalf, unsigned seed, Origin origin,
                    Surface surface, std::size_t mostOwnFacets) {
  static constexpr auto kQuarters = outlines::subLights();
  const std::unique_ptr<OwnLists> own = ownLists(shape, lightHalf, kQuarters, origin, surface, mostOwnFacets);
  const auto& [mesh, halfEdges, caster, area, plane, space, loops, surfaces, tiles, lists] = *own;
  Deviation result{.trees = lists.trees.size(), .longest = lists.longestList};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[f]]), b(mesh.positions[mesh.indices[f + 1]]),
        c(mesh.positions[mesh.indices[f + 2]]);
    glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    double s = unit(random), t = unit(random);
    if (s + t > 1.0) s = 1.0 - s, t = 1.0 - t;
    const glm::dvec3 place = a + s * (b - a) + t * (c - a);
    const double height = glm::dot(normal, area.centerWorld - place);
    if (surface == Surface::open && height < 0.0) normal = -normal;
    if (surface == Surface::closed && height <= 0.0) continue;
    const glm::dvec3 onSurface = space.tangentPoint(plane.fromWorld(place));
    const glm::ivec2 tile(glm::floor((glm::dvec2(onSurface) - tiles.low) / tiles.tileSize));
    if (tile.x < 0 || tile.y < 0 || tile.x >= tiles.columns || tile.y >= tiles.rows) continue;
    const outlines::TileList& list = lists.tiles[static_cast<std::size_t>(tile.y * tiles.columns + tile.x)];
    // Off its facet by what fragments are.
    const glm::dvec4 facet = space.planeThrough(normal, place - plane.centerWorld);
    const glm::dvec3 lifted = onSurface + outlines::kPlaceRounding * glm::abs(onSurface) *
                                              glm::sign(glm::dvec3(facet.x, facet.y, facet.w));
    const glm::dvec3 receiver = plane.toWorld(space.lightPoint(lifted));
    std::vector<outlines::ListRecord> records(lists.records.begin() + list.first,
                                              lists.records.begin() + list.first + list.count);
    for (outlines::ListRecord& record : records) {
      if (record.behindFacet == outlines::ListRecord::kVertex ||
          record.behindFacet == outlines::ListRecord::kTree)
        continue;
      const glm::dvec2 corner = behindCorner(plane, normal, receiver, record.behindFacet);
      const glm::dvec3 cornerWorld = plane.toWorld({corner.x, corner.y, 0.0});
      record.ti = glm::vec3(space.tangentPoint(plane.fromWorld(0.5 * (receiver + cornerWorld))));
    }
    const std::vector<outlines::ListRecord> met = withTrees(records, lists.trees, kQuarters, lifted);
    const auto covered = walk(met, kQuarters, lifted);
    double expected = 0.0;
    constexpr int kSide = 16;
    for (int k = 0; k < kSide * kSide; ++k) {
      const double x = 2.0 * (k % kSide + unit(random)) / kSide - 1.0;
      const double y = 2.0 * (k / kSide + unit(random)) / kSide - 1.0;
      // Layers that cover the same point of the light count once, as the fragment's clamp has it per cell.
      expected += std::min(exits(mesh, surface, receiver, plane.toWorld({x, y, 0.0})), 1);
    }
    expected /= kSide * kSide;
    const double actual = coveredShare(list, records, covered);
    count(result, expected, actual);
  }
  return result;
}

scene::TriangleMesh angleIron(float turn) {
  scene::TriangleMesh mesh;
  constexpr std::array<glm::vec2, 6> kOutline{
      {{-0.6f, -0.6f}, {0.6f, -0.6f}, {0.6f, -0.2f}, {-0.2f, -0.2f}, {-0.2f, 0.6f}, {-0.6f, 0.6f}}};
  for (const float y : {0.0f, 1.2f}) {
    for (const glm::vec2& p : kOutline) {
      mesh.positions.emplace_back(std::cos(turn) * p.x - std::sin(turn) * p.y, y,
                                  std::sin(turn) * p.x + std::cos(turn) * p.y);
    }
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    mesh.indices.insert(mesh.indices.end(), {k, k + 6, next, next, k + 6, next + 6});
  }
  for (const auto& [a, b, c] : {std::array{0u, 1u, 2u}, {0u, 2u, 3u}, {0u, 3u, 4u}, {0u, 4u, 5u}}) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a + 6, c + 6, b + 6});
  }
  return mesh;
}

Deviation deviationAtFoot(const scene::TriangleMesh& shape, double lightHalf, unsigned seed,
                          std::span<const outlines::SubLight> lights) {
  constexpr float kGap = 0.002f;
  // Tilted, so that no receiver lies behind all of the caster.
  constexpr double kTilt = 0.5;
  const auto own =
      ownLists(shape, lightHalf, lights, Origin::caster, Surface::closed, ~std::size_t{0}, {}, kTilt);
  const auto& [mesh, halfEdges, caster, area, plane, space, loops, surfaces, none, unused] = *own;
  scene::TriangleMesh ground;
  for (const float x : {-3.0f, 3.0f}) {
    for (const float z : {-3.0f, 3.0f}) ground.positions.emplace_back(x, -kGap, z);
  }
  ground.indices = {0, 1, 2, 1, 3, 2};
  const outlines::ReceiverTiles tiles =
      receiverTiles({.mesh = &ground}, space, shadowedTangents(loops, -10.0), 0.05, 64, 1e-3);
  const outlines::TileLists lists = tileLists(loops, own->surfaces, tiles, {}, outlines::ListedEdges::all);
  Deviation result{.longest = lists.longestList};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 1500; ++trial) {
    // Near its walls, and on either side of them.
    const std::size_t corner = static_cast<std::size_t>(trial % 6);
    const glm::dvec3 from(mesh.positions[corner]), to(mesh.positions[(corner + 1) % 6]);
    const glm::dvec3 along = glm::normalize(to - from);
    const double away = 0.2 * std::pow(10.0, -3.0 * unit(random));
    const glm::dvec3 world = glm::mix(from, to, unit(random)) + away * glm::dvec3(along.z, 0.0, -along.x) -
                             glm::dvec3(0.0, kGap, 0.0);
    const glm::dvec3 receiver = space.tangentPoint(plane.fromWorld(world));
    const glm::ivec2 tile(glm::floor((glm::dvec2(receiver) - tiles.low) / tiles.tileSize));
    if (tile.x < 0 || tile.y < 0 || tile.x >= tiles.columns || tile.y >= tiles.rows) continue;
    const outlines::TileList& list = lists.tiles[static_cast<std::size_t>(tile.y * tiles.columns + tile.x)];
    // Behind all of it its outline from the middle of each part of the light stands for it.
    if (!list.amongReceivers) continue;
    const auto records = std::span(lists.records).subspan(list.first, list.count);
    // Layers that cover the same point of the light are summed up within a cell, and no more than cover it.
    std::array<double, 16> cells{};
    constexpr int kSide = 24, kPerCell = kSide / 4;
    for (int k = 0; k < kSide * kSide; ++k) {
      const int column = k % kSide, row = k / kSide;
      const double x = 2.0 * (column + unit(random)) / kSide - 1.0,
                   y = 2.0 * (row + unit(random)) / kSide - 1.0;
      cells[static_cast<std::size_t>(row / kPerCell * 4 + column / kPerCell)] +=
          exits(mesh, Surface::closed, world, plane.toWorld({x, y, 0.0})) / double(kPerCell * kPerCell);
    }
    double expected = 0.0;
    for (const double cell : cells) expected += std::min(cell, 1.0) / 16.0;
    const double actual = coveredShare(list, records, walk(records, lights, receiver));
    count(result, expected, actual);
  }
  return result;
}

}  // namespace halfshadow::test
