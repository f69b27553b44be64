// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/cut_by_alpha.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

#include "scene/alpha_pyramid.hpp"
#include "scene/cutout.hpp"

namespace halfshadow::scene {
namespace {
/// What may be wrong of a piece, as a share of the uncut triangle's area. Straight cuts err to the same side
/// of a round outline, which takes two dozen of them: a disc of 80 triangles then loses .7 % of its area, and
/// its shadow so much of its darkness at most.
constexpr double kMissed = 3e-4;
/// Samples along a piece's sides. One for eight texels finds what matters of a picture; a round outline
/// leaves a straight cut by a hundredth of a piece, which fewer than a hundred samples do not see.
constexpr int kFewestSamples = 13;
/// Halvings of the way between two points of which alpha keeps one: a thousandth of an edge.
constexpr int kHalvings = 10;

struct Vertex {
  CutMesh::Source source;
  glm::vec3 position{0.0f};
  glm::dvec2 texcoord{0.0};
  double colorAlpha = 1.0;
  bool kept = false;
};

struct Piece {
  std::array<std::uint32_t, 3> corner{};
  double wholeArea = 0.0;  ///< of the triangle that it is part of
  double missed = 0.0;     ///< area that straight cuts get wrong
  bool alive = true;
  bool uniform = false;  ///< all of it is kept, or none
  bool kept = false;     ///< if it is uniform
};

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// Places over a triangle, by weights of its corners, evenly spread: `side` a side.
template <typename Visit>
void forEachSample(int side, Visit&& visit) {
  for (int i = 0; i < side; ++i) {
    for (int k = 0; i + k < side; ++k) {
      const double x = (i + 1.0 / 3.0) / side, y = (k + 1.0 / 3.0) / side;
      visit(glm::dvec3(1.0 - x - y, x, y));
    }
  }
}

class Cutter {
 public:
  Cutter(const TriangleMesh& mesh, const AlphaCut& alpha, std::size_t mostTriangles)
      : mesh_(mesh),
        alpha_(alpha),
        pyramid_(alpha.mask ? *alpha.mask : Image{}),
        most_(mesh.triangleCount() + mostTriangles) {}

  CutMesh run() {
    addUncut();
    while (!worst_.empty() && count_ < most_) {
      const std::uint32_t piece = worst_.top().second;
      worst_.pop();
      if (pieces_[piece].alive) halve(piece);
    }
    while (!worst_.empty() && !pieces_[worst_.top().second].alive) worst_.pop();
    result_.coarse = !worst_.empty();
    for (const Piece& piece : pieces_)
      if (piece.alive) append(piece);
    return finish();
  }

 private:
  void addUncut() {
    vertices_.resize(mesh_.positions.size());
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
      Vertex& vertex = vertices_[i];
      vertex.source = {i, i, 0.0f};
      vertex.position = mesh_.positions[i];
      if (!mesh_.texcoords.empty()) vertex.texcoord = glm::dvec2(mesh_.texcoords[i]);
      if (!mesh_.colors.empty()) vertex.colorAlpha = mesh_.colors[i].a;
      vertex.kept = isKept(vertex.texcoord, vertex.colorAlpha);
    }
    for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
      const std::uint32_t* const corner = &mesh_.indices[std::size_t{3} * t];
      // Wound as the source has it: who reads the result mends windings again.
      const bool turned = !mesh_.turned.empty() && mesh_.turned[t] != 0;
      Piece piece{.corner = {corner[0], corner[turned ? 2 : 1], corner[turned ? 1 : 2]}};
      piece.wholeArea = area(piece);
      add(piece);
    }
  }

  bool isKept(const glm::dvec2& texcoord, double colorAlpha) const {
    const double image = alpha_.mask ? alphaAt(*alpha_.mask, alpha_.sampling, texcoord) : 1.0;
    return image * colorAlpha >= alpha_.cutoff;
  }

  double area(const Piece& piece) const {
    const auto at = [&](int k) { return glm::dvec3(vertices_[piece.corner[k]].position); };
    return 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
  }

  AlphaRange range(const Piece& piece) const {
    const Vertex &a = vertices_[piece.corner[0]], &b = vertices_[piece.corner[1]],
                 &c = vertices_[piece.corner[2]];
    const auto [low, high] = std::minmax({a.colorAlpha, b.colorAlpha, c.colorAlpha});
    AlphaRange result{static_cast<float>(low), static_cast<float>(high)};
    if (alpha_.mask && !mesh_.texcoords.empty())
      result.times(pyramid_.over(glm::min(a.texcoord, glm::min(b.texcoord, c.texcoord)),
                                 glm::max(a.texcoord, glm::max(b.texcoord, c.texcoord)), alpha_.sampling));
    return result;
  }

  /// Share of the way from one corner to the other, of which alpha keeps one, at which that ends.
  double crossing(std::uint32_t from, std::uint32_t to) const {
    const Vertex &a = vertices_[from], &b = vertices_[to];
    double low = 0.0, high = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      const bool kept =
          isKept(glm::mix(a.texcoord, b.texcoord, middle), glm::mix(a.colorAlpha, b.colorAlpha, middle));
      (kept == a.kept ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  double crossingFrom(std::uint32_t corner, std::uint32_t other) const {
    // The same for both triangles of an edge.
    return corner < other ? crossing(corner, other) : 1.0 - crossing(other, corner);
  }

  /// The corner that alone is kept or alone is not; -1: all are alike.
  int oddCorner(const Piece& piece) const {
    const auto kept = [&](int k) { return vertices_[piece.corner[k]].kept; };
    for (int k = 0; k < 3; ++k)
      if (kept(k) != kept((k + 1) % 3) && kept(k) != kept((k + 2) % 3)) return k;
    return -1;
  }

  int samplesASide(const Piece& piece) const {
    if (!alpha_.mask) return kFewestSamples;
    const glm::dvec2 size(alpha_.mask->width, alpha_.mask->height);
    double texels = 0.0;
    for (int k = 0; k < 3; ++k)
      texels = std::max(texels, glm::length((vertices_[piece.corner[k]].texcoord -
                                             vertices_[piece.corner[(k + 1) % 3]].texcoord) *
                                            size));
    return static_cast<int>(std::clamp(texels / 8.0, double{kFewestSamples}, 24.0));
  }

  /// Area of which alpha and straight cuts say different things.
  double missedBy(const Piece& piece) const {
    const int odd = oddCorner(piece);
    const Vertex* const corner[3] = {&vertices_[piece.corner[0]], &vertices_[piece.corner[1]],
                                     &vertices_[piece.corner[2]]};
    double toNext = 1.0, toLast = 1.0;
    const int next = (odd + 1) % 3, last = (odd + 2) % 3;
    if (odd >= 0) {
      toNext = std::max(crossingFrom(piece.corner[odd], piece.corner[next]), 1e-6);
      toLast = std::max(crossingFrom(piece.corner[odd], piece.corner[last]), 1e-6);
    }
    int wrong = 0, all = 0;
    forEachSample(samplesASide(piece), [&](const glm::dvec3& w) {
      const glm::dvec2 texcoord =
          w.x * corner[0]->texcoord + w.y * corner[1]->texcoord + w.z * corner[2]->texcoord;
      const double color =
          w.x * corner[0]->colorAlpha + w.y * corner[1]->colorAlpha + w.z * corner[2]->colorAlpha;
      bool said = corner[0]->kept;
      if (odd >= 0) said = corner[odd]->kept == (w[next] / toNext + w[last] / toLast < 1.0);
      wrong += isKept(texcoord, color) != said;
      ++all;
    });
    return area(piece) * wrong / all;
  }

  void add(Piece piece) {
    if (!piece.uniform) {
      const AlphaRange alpha = range(piece);
      piece.uniform = alpha.low >= alpha_.cutoff || alpha.high < alpha_.cutoff;
      piece.kept = alpha.low >= alpha_.cutoff;
      piece.missed = piece.uniform ? 0.0 : missedBy(piece);
    }
    const auto number = static_cast<std::uint32_t>(pieces_.size());
    for (int k = 0; k < 3; ++k)
      atEdge_[edgeKey(piece.corner[k], piece.corner[(k + 1) % 3])].push_back(number);
    if (piece.missed > kMissed * piece.wholeArea) worst_.push({piece.missed, number});
    pieces_.push_back(piece);
    ++count_;
  }

  void remove(std::uint32_t number) {
    Piece& piece = pieces_[number];
    piece.alive = false;
    for (int k = 0; k < 3; ++k) {
      const auto at = atEdge_.find(edgeKey(piece.corner[k], piece.corner[(k + 1) % 3]));
      std::erase(at->second, number);
      if (at->second.empty()) atEdge_.erase(at);
    }
    --count_;
  }

  std::uint32_t vertexBetween(std::uint32_t from, std::uint32_t to, double share) {
    const Vertex a = vertices_[from], b = vertices_[to];
    Vertex made;
    made.source = {from, to, static_cast<float>(share)};
    made.position = glm::mix(a.position, b.position, made.source.share);
    made.texcoord = glm::mix(a.texcoord, b.texcoord, share);
    made.colorAlpha = glm::mix(a.colorAlpha, b.colorAlpha, share);
    made.kept = isKept(made.texcoord, made.colorAlpha);
    vertices_.push_back(made);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  /// At the middle of its longest edge, and with it all that have that edge.
  void halve(std::uint32_t number) {
    const auto& corner = pieces_[number].corner;
    int longest = 0;
    float most = -1.0f;
    for (int k = 0; k < 3; ++k) {
      const float length =
          glm::length(vertices_[corner[k]].position - vertices_[corner[(k + 1) % 3]].position);
      if (length > most) most = length, longest = k;
    }
    const std::uint32_t a = corner[longest], b = corner[(longest + 1) % 3];
    const std::uint32_t middle = vertexBetween(a, b, 0.5);
    const std::vector<std::uint32_t> around = atEdge_.at(edgeKey(a, b));
    for (const std::uint32_t each : around) {
      const Piece whole = pieces_[each];
      remove(each);
      for (const std::uint32_t replaced : {a, b}) {
        Piece half = whole;
        *std::ranges::find(half.corner, replaced) = middle;
        add(half);
      }
    }
  }

  std::uint32_t crossingVertex(std::uint32_t a, std::uint32_t b) {
    const auto [at, isNew] = crossings_.try_emplace(edgeKey(a, b), 0u);
    if (isNew)
      at->second = vertexBetween(std::min(a, b), std::max(a, b), crossing(std::min(a, b), std::max(a, b)));
    return at->second;
  }

  void append(const Piece& piece) {
    const int odd = piece.uniform ? -1 : oddCorner(piece);
    const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      indices_.insert(indices_.end(), {a, b, c});
    };
    if (odd < 0) {
      if (piece.uniform ? piece.kept : vertices_[piece.corner[0]].kept)
        put(piece.corner[0], piece.corner[1], piece.corner[2]);
      return;
    }
    const std::uint32_t tip = piece.corner[odd], next = piece.corner[(odd + 1) % 3],
                        last = piece.corner[(odd + 2) % 3];
    const bool tipKept = vertices_[tip].kept;
    const std::uint32_t toNext = crossingVertex(tip, next), toLast = crossingVertex(tip, last);
    if (tipKept) {
      put(tip, toNext, toLast);
    } else {
      put(toNext, next, last);
      put(toNext, last, toLast);
    }
  }

  CutMesh finish() {
    std::vector<glm::vec3> positions;
    positions.reserve(vertices_.size());
    for (const Vertex& vertex : vertices_) {
      positions.push_back(vertex.position);
      result_.sources.push_back(vertex.source);
    }
    if (indices_.empty()) return std::move(result_);
    auto built = buildMesh({.positions = &positions.front().x,
                            .vertexCount = static_cast<std::uint32_t>(positions.size()),
                            .indices = indices_.data(),
                            .indexCount = indices_.size()});
    // What has no area left casts nothing.
    if (built) result_.mesh = std::move(*built);
    return std::move(result_);
  }

  const TriangleMesh& mesh_;
  const AlphaCut& alpha_;
  AlphaPyramid pyramid_;
  std::size_t most_, count_ = 0;
  std::vector<Vertex> vertices_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> atEdge_;
  std::priority_queue<std::pair<double, std::uint32_t>> worst_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
  std::vector<std::uint32_t> indices_;
  CutMesh result_;
};
}  // namespace

void CutMesh::follow(const TriangleMesh& uncut) {
  std::vector<glm::vec3>& positions = mesh.positions;
  if (positions.empty()) return;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Source& source = sources[i];
    positions[i] = source.from == i ? uncut.positions[i]
                                    : glm::mix(positions[source.from], positions[source.to], source.share);
  }
}

CutMesh cutByAlpha(const TriangleMesh& mesh, const AlphaCut& alpha, std::size_t mostTriangles) {
  return Cutter(mesh, alpha, mostTriangles).run();
}

}  // namespace halfshadow::scene
