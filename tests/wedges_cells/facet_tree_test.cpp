// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Trees of dense surfaces' facets: their shape, what fragments meet in them against rays, and what of them
// stands in records.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "near_surface_rig.hpp"
#include "outlines/near_surface.hpp"
#include "scene/half_edge_mesh.hpp"
#include "techniques/parts/lists/facet_tree_texels.hpp"
#include "techniques/parts/lists/list_codes.hpp"

namespace halfshadow::test {
namespace {
using outlines::FacetTree;

/// A caster with a light over it, and its surface in (t, i).
struct Subject {
  Subject(const scene::TriangleMesh& shape, const glm::dvec3& lightAt, double lightHalf)
      : mesh(*scene::buildMesh({.positions = &shape.positions.front().x,
                                .vertexCount = static_cast<std::uint32_t>(shape.positions.size()),
                                .indices = shape.indices.data(),
                                .indexCount = shape.indices.size()})),
        halfEdges(scene::HalfEdgeMesh::build(mesh)),
        plane(*scene::areaLightFromVectors(lightAt, {lightHalf, 0, 0}, {0, 0, lightHalf}), 8.0, 1e-4),
        space(plane),
        surface(outlines::nearSurface({.mesh = &halfEdges}, 0, space, 1e-3)) {}
  scene::TriangleMesh mesh;
  scene::HalfEdgeMesh halfEdges;
  scene::LightPlane plane;
  outlines::ListSpace space;
  outlines::NearSurface surface;
};

/// Twice the signed area of the loops of a node, seen from far behind all of it: along i.
double areaOf(const FacetTree& tree, const FacetTree::Node& node) {
  double area = 0.0;
  for (std::uint32_t l = 0; l < node.loopCount; ++l) {
    const FacetTree::Loop& loop = tree.loops[node.firstLoop + l];
    for (std::uint32_t k = 0; k < loop.count; ++k) {
      const glm::dvec2 a(tree.points[loop.first + k]), b(tree.points[loop.first + (k + 1) % loop.count]);
      area += a.x * b.y - a.y * b.x;
    }
  }
  return area;
}

struct Counted {
  std::size_t facets = 0, leaves = 0, contours = 0, vertices = 0;
};

/// Boxes hold what is in them, ends follow each other, contours enclose what the facets of their leaves do.
Counted check(const FacetTree& tree) {
  Counted counted;
  EXPECT_EQ(tree.nodes.front().end, tree.nodes.size());
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const FacetTree::Node& node = tree.nodes[n];
    EXPECT_GT(node.end, n);
    double inside = 0.0, absolute = 0.0;
    std::size_t facets = 0;
    for (std::size_t m = n; m < node.end; ++m) {
      const FacetTree::Node& part = tree.nodes[m];
      EXPECT_LE(part.end, node.end) << "node " << m << " reaches beyond node " << n;
      EXPECT_TRUE(glm::all(glm::lessThanEqual(node.low, part.low)) &&
                  glm::all(glm::lessThanEqual(part.high, node.high)));
      if (!part.isLeaf) continue;
      facets += part.loopCount;
      inside += areaOf(tree, part);
      absolute += std::abs(areaOf(tree, part));
      for (std::uint32_t l = part.firstLoop; l < part.firstLoop + part.loopCount; ++l) {
        for (std::uint32_t k = 0; k < tree.loops[l].count; ++k) {
          const glm::vec3& point = tree.points[tree.loops[l].first + k];
          EXPECT_TRUE(glm::all(glm::lessThanEqual(node.low, point)) &&
                      glm::all(glm::lessThanEqual(point, node.high)));
        }
      }
    }
    if (node.isLeaf) {
      ++counted.leaves, counted.facets += facets, counted.vertices += 3 * facets;
      continue;
    }
    if (node.loopCount == 0) continue;
    ++counted.contours;
    for (std::uint32_t l = 0; l < node.loopCount; ++l)
      counted.vertices += tree.loops[node.firstLoop + l].count;
    // Sums of products of floats in doubles.
    EXPECT_NEAR(areaOf(tree, node), inside, 1e-9 * absolute + 1e-12) << "node " << n;
  }
  return counted;
}

TEST(FacetTrees, BoxesHoldTheirFacetsAndContoursEncloseThem) {
  const struct {
    const char* name;
    scene::TriangleMesh shape;
    double lightHalf;
  } kSubjects[] = {{"ball", bumpyBall(90, 60), 0.2},
                   {"ball, large light", bumpyBall(64, 40), 2.0},
                   {"sheet", bentSheet(60), 0.3},
                   {"one facet", bentSheet(1), 0.3}};
  for (const auto& [name, shape, half] : kSubjects) {
    SCOPED_TRACE(name);
    const Subject subject(shape, {1.0, 5.0, 0.5}, half);
    const outlines::FacetTrees trees = outlines::facetTrees(subject.surface);
    Counted all;
    for (const auto* side : {&trees.towards, &trees.away}) {
      for (const FacetTree& tree : *side) {
        const Counted counted = check(tree);
        EXPECT_LE(counted.facets, outlines::kMostTreeFacets);
        all.facets += counted.facets, all.leaves += counted.leaves;
        all.contours += counted.contours, all.vertices += counted.vertices;
      }
    }
    // Each facet that some of the light lies before stands in one tree, and on a sheet those behind likewise.
    std::size_t expected = 0;
    for (const outlines::NearSurface::Facet& facet : subject.surface.facets) {
      const int side = outlines::lightSideOf(facet, outlines::kWholeLight);
      expected += (side >= 0 ? 1 : 0) + (side <= 0 && !subject.surface.closed ? 1 : 0);
    }
    EXPECT_EQ(all.facets, expected);
    std::printf("%s: %zu facets, %zu leaves, %zu contours, %zu vertices\n", name, all.facets, all.leaves,
                all.contours, all.vertices);
    if (shape.indices.size() > 300) {
      EXPECT_GT(all.contours, 10u);
    }
  }
}

/// A ribbon wound closely: of every box its contour is nearly all edges.
scene::TriangleMesh coil(int turns, int perTurn) {
  scene::TriangleMesh mesh;
  for (int k = 0; k <= turns * perTurn; ++k) {
    const float angle = 6.2831853f * static_cast<float>(k) / static_cast<float>(perTurn);
    const float radius = 0.2f + 0.8f * static_cast<float>(k) / static_cast<float>(turns * perTurn);
    for (const float r : {radius, radius + 0.5f / static_cast<float>(turns)})
      mesh.positions.emplace_back(r * std::cos(angle), 0.1f * std::sin(5.0f * r), r * std::sin(angle));
    if (k == 0) continue;
    const auto a = static_cast<std::uint32_t>(2 * (k - 1));
    mesh.indices.insert(mesh.indices.end(), {a, a + 2, a + 1, a + 1, a + 2, a + 3});
  }
  return mesh;
}

TEST(FacetTrees, WhatLeadsOverATreeFitsItsRecord) {
  for (const auto& shape : {coil(40, 60), bumpyBall(120, 80), bentSheet(100)}) {
    const Subject subject(shape, {1.0, 5.0, 0.5}, 0.01);
    const outlines::FacetTrees trees = outlines::facetTrees(subject.surface);
    ASSERT_FALSE(trees.towards.empty());
    for (const auto* side : {&trees.towards, &trees.away}) {
      for (const FacetTree& tree : *side) {
        check(tree);
        // What leads to a contour has 16 bits, what leads over a box 14.
        EXPECT_LT(techniques::encodedTree(tree).size() / techniques::kRecordBytes - 2, 16384u);
      }
    }
  }
}

TEST(FacetTrees, WhatFragmentsMeetIsWhatRaysDoNotPass) {
  // As lists of all facets do, see near_surface_test.cpp: noise of 256 samples (.01 at half coverage), and
  // layers that overlap within a cell.
  const struct {
    scene::TriangleMesh shape;
    Surface surface;
    double lightHalf;
  } kSubjects[] = {{bumpyBall(24, 16), Surface::closed, 0.3},
                   {bumpyBall(24, 16), Surface::closed, 2.0},
                   {bentSheet(18), Surface::open, 1.0}};
  for (const auto& [shape, surface, half] : kSubjects) {
    const Deviation found = deviation(shape, half, 11, Origin::caster, surface, 0);
    const double rmse = std::sqrt(found.square / std::max(found.receivers, 1));
    std::printf(
        "half size %.1f: %d receivers, %d in penumbra, rmse %.4f, largest %.3f, %zu trees, %zu records\n",
        half, found.receivers, found.penumbra, rmse, found.largest, found.trees, found.longest);
    EXPECT_GT(found.trees, 0u);
    EXPECT_LE(found.longest, found.trees) << "a record for each tree";
    EXPECT_GT(found.receivers, 200);
    EXPECT_GT(found.penumbra, 20);
    EXPECT_LE(rmse, 0.012) << half;
    EXPECT_LE(found.largest, 0.09) << half;
  }
}

/// Places as fragments read them (list_vertices.glsl, facet_tree.glsl).
class Records {
 public:
  explicit Records(const FacetTree& tree) : bytes_(techniques::encodedTree(tree)) {
    const std::uint8_t* first = at(0);
    step = glm::vec3(std::exp2(first[6] - 128.0f), 0.0f, std::exp2(first[7] - 128.0f));
    step.y = step.x;
    for (int k = 0; k < 3; ++k) center[k] = 256.0f * number(0, 2 * k, 32768) * step[k];
  }
  const std::uint8_t* at(std::size_t record) const { return &bytes_[record * techniques::kRecordBytes]; }
  /// Of two bytes, high first.
  float number(std::size_t record, int byte, int zero = 0) const {
    return static_cast<float>(256 * at(record)[byte] + at(record)[byte + 1] - zero);
  }
  glm::vec3 vertex(std::size_t record) const {
    const glm::vec3 codes(number(record, 0, 32768), number(record, 2, 32768), number(record, 4, 32768));
    return center + codes * step;
  }
  glm::vec3 corner(std::size_t record, int byte) const {
    const std::uint8_t* codes = at(record) + byte;
    return center + 256.0f * step * (glm::vec3(codes[0], codes[1], codes[2]) - 128.0f);
  }
  std::size_t count() const { return bytes_.size() / techniques::kRecordBytes; }
  glm::vec3 center{0.0f}, step{0.0f};

 private:
  std::vector<std::uint8_t> bytes_;
};

bool isVertex(const Records& records, const glm::vec3& stored, const glm::vec3& point) {
  // Half a step, and what is lost where single precision counts from the centre.
  return glm::all(
      glm::lessThanEqual(glm::abs(stored - point), 0.5f * records.step + 2e-7f * glm::abs(records.center)));
}
void expectVertex(const Records& records, std::size_t at, const glm::vec3& point) {
  EXPECT_TRUE(isVertex(records, records.vertex(at), point));
}

/// The record after the facets of a leaf, the first of which stands in record `at`; how many records they
/// take is added to `vertices`.
std::size_t checkFacets(const Records& records, std::size_t at, const FacetTree& tree,
                        const FacetTree::Node& node, std::size_t& vertices) {
  // As fragments walk strips.
  std::array<glm::vec3, 3> last{};
  std::vector<bool> met(node.loopCount, false);
  for (bool ends = false; !ends; ++at, ++vertices) {
    const int tag = records.at(at)[6], way = records.at(at)[7] - 1;
    EXPECT_LE(tag, 3);
    ends = (tag & 1) != 0;
    last = {(tag & 2) != 0 ? last[0] : last[1], last[2], records.vertex(at)};
    if (way == 0) continue;
    EXPECT_EQ(std::abs(way), 1);
    const std::array<glm::vec3, 3> facet = way > 0 ? last : std::array{last[1], last[0], last[2]};
    std::uint32_t found = 0;
    for (; found < node.loopCount; ++found) {
      const FacetTree::Loop& loop = tree.loops[node.firstLoop + found];
      EXPECT_EQ(loop.count, 3u);
      const auto same = [&](std::size_t turn) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (!isVertex(records, facet[k], tree.points[loop.first + (k + turn) % 3])) return false;
        }
        return true;
      };
      if (!met[found] && (same(0) || same(1) || same(2))) break;
    }
    EXPECT_LT(found, node.loopCount) << "a facet that the leaf has not, or twice, or turned round";
    if (found < node.loopCount) met[found] = true;
  }
  EXPECT_EQ(std::ranges::count(met, true), std::ptrdiff_t(node.loopCount));
  return at;
}

/// The same of a contour's loops.
std::size_t checkContour(const Records& records, std::size_t at, const FacetTree& tree,
                         const FacetTree::Node& node) {
  for (std::uint32_t l = node.firstLoop; l < node.firstLoop + node.loopCount; ++l) {
    const FacetTree::Loop& loop = tree.loops[l];
    for (std::uint32_t k = 0; k <= loop.count; ++k, ++at) {
      expectVertex(records, at, tree.points[loop.first + k % loop.count]);
      const bool ends = k == loop.count && l + 1 == node.firstLoop + node.loopCount;
      EXPECT_EQ(records.at(at)[6], k == 0 ? 32 : ends ? 1 : 0);
    }
  }
  return at;
}

TEST(FacetTrees, RecordsSayWhatTreesHold) {
  for (const auto& shape : {bumpyBall(60, 40), bentSheet(40), coil(40, 60)}) {
    std::size_t facets = 0, stripVertices = 0;
    const Subject subject(shape, {1.0, 5.0, 0.5}, 0.5);
    const outlines::FacetTrees trees = outlines::facetTrees(subject.surface);
    ASSERT_FALSE(trees.towards.empty());
    for (const FacetTree& tree : trees.towards) {
      const Records records(tree);
      const FacetTree::Node& root = tree.nodes.front();
      // Fine enough: 16,000 steps and more across the tree, if the centre allows.
      EXPECT_TRUE(glm::all(glm::lessThanEqual(
          records.step, glm::max((root.high - root.low) / 16000.0f, glm::abs(records.center) / 4e6f))));
      std::vector<std::size_t> first, end;  // records of each node, and after all that is in it
      std::vector<std::pair<const FacetTree::Node*, std::size_t>> contours;
      std::size_t at = 1;
      for (const FacetTree::Node& node : tree.nodes) {
        first.push_back(at);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(records.corner(at, 0), node.low)) &&
                    glm::all(glm::lessThanEqual(node.high, records.corner(at, 3))))
            << "boxes are rounded outward";
        const auto codes = static_cast<std::size_t>(records.number(at, 6));
        const bool contour = !node.isLeaf && node.loopCount > 0;
        EXPECT_EQ((codes & 32768) != 0, node.isLeaf);
        EXPECT_EQ((codes & 16384) != 0, contour);
        end.push_back(at + (codes & 16383));
        ++at;
        if (node.isLeaf) at = checkFacets(records, at, tree, node, stripVertices), facets += node.loopCount;
        if (contour) contours.push_back({&node, static_cast<std::size_t>(records.number(at++, 0))});
      }
      first.push_back(at);
      for (std::size_t n = 0; n < tree.nodes.size(); ++n) EXPECT_EQ(end[n], first[tree.nodes[n].end]);
      for (std::size_t k = 0; k < techniques::kRecordBytes; ++k) EXPECT_EQ(records.at(at)[k], 0);
      ++at;
      for (const auto& [node, place] : contours) {
        ASSERT_EQ(place, at) << "contours follow each other";
        at = checkContour(records, at, tree, *node);
      }
      EXPECT_EQ(at, records.count());
    }
    // Of a leaf's two to four facets, where two hang together, they take two vertices each in place of three.
    EXPECT_LE(2 * stripVertices, 5 * facets);
  }
}

}  // namespace
}  // namespace halfshadow::test
