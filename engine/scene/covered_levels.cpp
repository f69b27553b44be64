// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/covered_levels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace halfshadow::scene {
namespace {
constexpr std::uint32_t kNone = ~0u;
/// Vertices are moved apart by so much of the whole, far less than positions are known: then every crossing
/// is a proper one, though edges lie along each other in most scenes.
constexpr double kJitter = 1e-10;

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}
}  // namespace

std::size_t CoveredLevels::PlaceHash::operator()(const std::array<double, 3>& place) const {
  std::uint64_t hash = 0x9e3779b97f4a7c15ull;
  for (const double coordinate : place)
    hash = std::rotl((hash ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9fb21c651e98df25ull, 31);
  return hash ^ hash >> 29;
}

void CoveredLevels::start(const glm::dvec2& source) {
  source_ = source;
  surfaces_ = 0;
  vertices_.clear();
  vertexOf_.clear();
  added_.clear();
}

std::uint32_t CoveredLevels::vertexAt(const glm::dvec3& place) {
  const auto [found, isNew] = vertexOf_.try_emplace({place.x + 0.0, place.y + 0.0, place.z + 0.0},
                                                    static_cast<std::uint32_t>(vertices_.size()));
  if (isNew) vertices_.push_back({.place = place, .flat = (glm::dvec2(place) - source_) / place.z});
  return found->second;
}

void CoveredLevels::addLoop(std::span<const glm::dvec3> points, std::uint32_t surface, Side side) {
  surfaces_ = std::max(surfaces_, surface + 1);
  if (points.empty()) return;
  std::uint32_t from = vertexAt(points.back());
  for (const glm::dvec3& point : points) {
    const std::uint32_t to = vertexAt(point);
    if (from != to)
      added_.push_back({.low = std::min(from, to),
                        .high = std::max(from, to),
                        .surface = surface,
                        .turns = from < to ? 1 : -1,
                        .side = side});
    from = to;
  }
}

void CoveredLevels::makeStrands() {
  glm::dvec2 low(1e300), high(-1e300);
  for (const Vertex& vertex : vertices_) {
    low = glm::min(low, vertex.flat);
    high = glm::max(high, vertex.flat);
  }
  const double step = kJitter * (high.x - low.x + high.y - low.y);
  std::uint32_t state = 1;
  const auto jitter = [&] {
    state = state * 1664525u + 1013904223u;
    return step * (static_cast<double>(state >> 8) / (1u << 24) - 0.5);
  };
  for (Vertex& vertex : vertices_) {
    const double x = jitter(), y = jitter();
    vertex.flat += glm::dvec2(x, y);
  }
  std::ranges::sort(added_, {}, [](const AddedEdge& e) { return std::array{e.low, e.high, e.surface}; });
  strands_.clear();
  jumps_.clear();
  for (std::size_t i = 0; i < added_.size();) {
    Strand strand{
        .from = added_[i].low, .to = added_[i].high, .firstJump = static_cast<std::uint32_t>(jumps_.size())};
    for (; i < added_.size() && added_[i].low == strand.from && added_[i].high == strand.to;) {
      Jump jump{.surface = added_[i].surface};
      for (; i < added_.size() && added_[i].low == strand.from && added_[i].high == strand.to &&
             added_[i].surface == jump.surface;
           ++i)
        jump.sides[static_cast<std::size_t>(added_[i].side)] += added_[i].turns;
      if (jump.sides != std::array{0, 0}) jumps_.push_back(jump);
    }
    strand.jumpCount = static_cast<std::uint32_t>(jumps_.size()) - strand.firstJump;
    if (strand.jumpCount == 0) continue;
    ++vertices_[strand.from].strands;
    ++vertices_[strand.to].strands;
    strands_.push_back(strand);
  }
}

/// All pairs of strands whose projections cross, by sweeping over x in each row; a pair that shares several
/// rows is tried in the first.
void CoveredLevels::findCrossings() {
  crossings_.clear();
  nodes_ = static_cast<std::uint32_t>(vertices_.size());
  const auto x = [&](std::uint32_t vertex) { return vertices_[vertex].flat.x; };
  const auto low = [&](std::uint32_t s) { return std::min(x(strands_[s].from), x(strands_[s].to)); };
  const auto high = [&](std::uint32_t s) { return std::max(x(strands_[s].from), x(strands_[s].to)); };
  order_.resize(strands_.size());
  for (std::uint32_t s = 0; s < order_.size(); ++s) order_[s] = s;
  std::ranges::sort(order_, {}, low);
  sortIntoRows();
  for (std::size_t row = 0; row < rows_; ++row) {
    active_.clear();
    for (std::uint32_t k = firstInRow_[row]; k < firstInRow_[row + 1]; ++k) {
      const std::uint32_t s = strandsInRow_[k];
      const double begins = low(s);
      std::erase_if(active_, [&](std::uint32_t other) { return high(other) < begins; });
      for (const std::uint32_t other : active_) {
        if (std::max(rowsOf(strands_[s]).first, rowsOf(strands_[other]).first) == row) cross(s, other);
      }
      active_.push_back(s);
    }
  }
  std::ranges::sort(crossings_, [](const Crossing& a, const Crossing& b) {
    return a.on != b.on ? a.on < b.on : a.t < b.t;
  });
  for (Strand& strand : strands_) strand.crossingCount = 0;
  for (const Crossing& crossing : crossings_) ++strands_[crossing.on].crossingCount;
  std::uint32_t first = 0;
  for (Strand& strand : strands_) {
    strand.firstCrossing = first;
    first += strand.crossingCount;
  }
}

void CoveredLevels::cross(std::uint32_t s, std::uint32_t o) {
  const Strand &a = strands_[s], &b = strands_[o];
  // Edges that share a vertex meet nowhere else.
  if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return;
  const glm::dvec2 &af = vertices_[a.from].flat, &at = vertices_[a.to].flat, &bf = vertices_[b.from].flat,
                   &bt = vertices_[b.to].flat;
  if (std::max(af.y, at.y) < std::min(bf.y, bt.y) || std::max(bf.y, bt.y) < std::min(af.y, at.y)) return;
  const glm::dvec2 da = at - af, db = bt - bf;
  const double a0 = cross2(db, af - bf), a1 = cross2(db, at - bf);
  const double b0 = cross2(da, bf - af), b1 = cross2(da, bt - af);
  if ((a0 > 0) == (a1 > 0) || (b0 > 0) == (b1 > 0)) return;
  crossings_.push_back({s, o, nodes_, a0 / (a0 - a1)});
  crossings_.push_back({o, s, nodes_, b0 / (b0 - b1)});
  ++nodes_;
}

/// The point of the strand whose projection is at `t` of its projection.
glm::dvec3 CoveredLevels::pointAt(const Strand& strand, double t) const {
  const glm::dvec3 &from = vertices_[strand.from].place, &to = vertices_[strand.to].place;
  if (t <= 0.0 || t >= 1.0) return t <= 0.0 ? from : to;
  return glm::mix(from, to, t * from.z / (t * from.z + (1.0 - t) * to.z));
}

glm::dvec2 CoveredLevels::flatAt(const Strand& strand, double t) const {
  return glm::mix(vertices_[strand.from].flat, vertices_[strand.to].flat, t);
}

void CoveredLevels::addJumps(const Strand& strand, int times) {
  for (std::uint32_t k = strand.firstJump; k < strand.firstJump + strand.jumpCount; ++k) {
    auto& [towards, away] = counts_[jumps_[k].surface];
    level_ -= std::max({0, towards, away});
    towards += times * jumps_[k].sides[0];
    away += times * jumps_[k].sides[1];
    level_ += std::max({0, towards, away});
  }
}

std::size_t CoveredLevels::rowOf(double y) const {
  const double row = (y - lowestRow_) * rowsPerUnit_;
  return row > 0.0 ? std::min(static_cast<std::size_t>(row), rows_ - 1) : 0;
}

std::pair<std::size_t, std::size_t> CoveredLevels::rowsOf(const Strand& strand) const {
  const double from = vertices_[strand.from].flat.y, to = vertices_[strand.to].flat.y;
  return {rowOf(std::min(from, to)), rowOf(std::max(from, to))};
}

void CoveredLevels::sortIntoRows() {
  // Many strands are short: a row holds few more than cross it.
  constexpr std::size_t kStrandsPerRow = 4, kMostRows = 4096;
  double low = 1e300, high = -1e300;
  for (const Vertex& vertex : vertices_) {
    low = std::min(low, vertex.flat.y);
    high = std::max(high, vertex.flat.y);
  }
  rows_ = std::clamp<std::size_t>(strands_.size() / kStrandsPerRow, 1, kMostRows);
  lowestRow_ = low;
  rowsPerUnit_ = high > low ? static_cast<double>(rows_) / (high - low) : 0.0;
  firstInRow_.assign(rows_ + 1, 0);
  for (const Strand& strand : strands_) {
    const auto [first, last] = rowsOf(strand);
    for (std::size_t row = first; row <= last; ++row) ++firstInRow_[row + 1];
  }
  for (std::size_t row = 0; row < rows_; ++row) firstInRow_[row + 1] += firstInRow_[row];
  strandsInRow_.resize(firstInRow_.back());
  std::vector<std::uint32_t> filled(firstInRow_.begin(), firstInRow_.end() - 1);
  for (const std::uint32_t s : order_) {
    const auto [first, last] = rowsOf(strands_[s]);
    for (std::size_t row = first; row <= last; ++row) strandsInRow_[filled[row]++] = s;
  }
}

void CoveredLevels::countFrom(std::uint32_t s) {
  counts_.assign(surfaces_, {});
  level_ = 0;
  const Strand& own = strands_[s];
  const double t = own.crossingCount > 0 ? 0.5 * crossings_[own.firstCrossing].t : 0.5;
  const glm::dvec2 at = flatAt(own, t);
  // Along a ray to the right: what rises has its left on this side of it.
  const std::size_t row = rowOf(at.y);
  for (std::uint32_t k = firstInRow_[row]; k < firstInRow_[row + 1]; ++k) {
    const Strand& strand = strands_[strandsInRow_[k]];
    const glm::dvec2 p = vertices_[strand.from].flat - at, q = vertices_[strand.to].flat - at;
    if ((p.y > 0) == (q.y > 0) || &strand == &own) continue;
    const double side = cross2(p, q);
    if (q.y > 0 ? side > 0 : side < 0) addJumps(strand, q.y > 0 ? 1 : -1);
  }
  // Of one that falls the left is where the ray goes.
  if (vertices_[own.to].flat.y <= vertices_[own.from].flat.y) addJumps(own, -1);
}

void CoveredLevels::walk(std::uint32_t s) {
  countFrom(s);
  bool forward = true;
  // counts_ is of the strand's right at the end where the walk comes in, seen in the strand's direction.
  while (!walked_[s]) {
    walked_[s] = true;
    const Strand& strand = strands_[s];
    const glm::dvec2 along = flatAt(strand, 1.0) - flatAt(strand, 0.0);
    std::uint32_t node = forward ? strand.from : strand.to;
    double t = forward ? 0.0 : 1.0;
    for (std::uint32_t k = 0; k <= strand.crossingCount; ++k) {
      const bool last = k == strand.crossingCount;
      const Crossing* crossing =
          last ? nullptr : &crossings_[strand.firstCrossing + (forward ? k : strand.crossingCount - 1 - k)];
      const double next = last ? (forward ? 1.0 : 0.0) : crossing->t;
      const std::uint32_t nextNode = last ? (forward ? strand.to : strand.from) : crossing->node;
      const int right = level_;
      addJumps(strand, 1);
      const int left = level_;
      addJumps(strand, -1);
      if (left != right) {
        Piece piece{.strand = s, .left = left, .right = right};
        piece.fromNode = forward ? node : nextNode, piece.toNode = forward ? nextNode : node;
        piece.t0 = forward ? t : next, piece.t1 = forward ? next : t;
        pieces_.push_back(piece);
      }
      node = nextNode, t = next;
      if (last) break;
      const Strand& other = strands_[crossing->other];
      const bool toLeft = (cross2(flatAt(other, 1.0) - flatAt(other, 0.0), along) > 0.0) == forward;
      addJumps(other, toLeft ? 1 : -1);
    }
    if (vertices_[node].strands != 2) return;
    const std::uint32_t next =
        strandsAt_[firstAt_[node]] == s ? strandsAt_[firstAt_[node] + 1] : strandsAt_[firstAt_[node]];
    const bool nextForward = strands_[next].from == node;
    // The right of one is the left of the other where they run against each other.
    if (nextForward != forward) addJumps(strand, 1);
    forward = nextForward;
    s = next;
  }
}

void CoveredLevels::findStrandsAt() {
  firstAt_.assign(vertices_.size() + 1, 0);
  for (const Strand& strand : strands_) ++firstAt_[strand.from + 1], ++firstAt_[strand.to + 1];
  for (std::size_t v = 0; v < vertices_.size(); ++v) firstAt_[v + 1] += firstAt_[v];
  strandsAt_.resize(2 * strands_.size());
  std::vector<std::uint32_t> filled(firstAt_.begin(), firstAt_.end() - 1);
  for (std::uint32_t s = 0; s < strands_.size(); ++s) {
    strandsAt_[filled[strands_[s].from]++] = s;
    strandsAt_[filled[strands_[s].to]++] = s;
  }
}

void CoveredLevels::findPieces() {
  pieces_.clear();
  walked_.assign(strands_.size(), false);
  // First from where more than two strands meet: there walks end.
  for (const bool branching : {true, false}) {
    for (std::uint32_t s = 0; s < strands_.size(); ++s) {
      if (!walked_[s] && (!branching || vertices_[strands_[s].from].strands != 2)) walk(s);
    }
  }
}

bool CoveredLevels::traceLevel(int level, Level& result) {
  firstOut_.assign(nodes_, kNone);
  nextOut_.assign(pieces_.size(), kNone);
  chosen_.clear();
  const auto isForward = [&](const Piece& piece) { return piece.left >= level; };
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    const Piece& piece = pieces_[p];
    if ((piece.left >= level) == (piece.right >= level)) continue;
    std::uint32_t& first = firstOut_[isForward(piece) ? piece.fromNode : piece.toNode];
    nextOut_[p] = first;
    first = p;
    chosen_.push_back(p);
  }
  const auto heading = [&](const Piece& piece) {
    const glm::dvec2 along = flatAt(strands_[piece.strand], 1.0) - flatAt(strands_[piece.strand], 0.0);
    return isForward(piece) ? along : -along;
  };
  /// Takes out the piece that goes on from a node, of several the one farthest to the left.
  const auto take = [&](std::uint32_t node, const Piece* before) {
    std::uint32_t best = firstOut_[node], bestBefore = kNone;
    double bestTurn = -1e300;
    for (std::uint32_t p = firstOut_[node], previous = kNone; p != kNone; previous = p, p = nextOut_[p]) {
      if (before == nullptr || nextOut_[firstOut_[node]] == kNone) break;
      const glm::dvec2 from = heading(*before), to = heading(pieces_[p]);
      const double turn = std::atan2(cross2(from, to), glm::dot(from, to));
      if (turn > bestTurn) bestTurn = turn, best = p, bestBefore = previous;
    }
    if (best == kNone) return best;
    (bestBefore == kNone ? firstOut_[node] : nextOut_[bestBefore]) = nextOut_[best];
    return best;
  };
  for (const std::uint32_t start : chosen_) {
    const std::uint32_t startNode =
        isForward(pieces_[start]) ? pieces_[start].fromNode : pieces_[start].toNode;
    while (firstOut_[startNode] != kNone) {
      Loop loop;
      std::uint32_t p = take(startNode, nullptr);
      glm::dvec2 origin(0.0), last(0.0);
      const Piece* before = nullptr;
      const auto add = [&](const glm::dvec3& point, const glm::dvec2& flat) {
        if (loop.points.empty())
          origin = flat;
        else
          loop.area += 0.5 * cross2(last - origin, flat - origin);
        last = flat;
        loop.points.push_back(point);
      };
      for (;;) {
        const Piece& piece = pieces_[p];
        const Strand& strand = strands_[piece.strand];
        const bool forward = isForward(piece);
        const double t0 = forward ? piece.t0 : piece.t1, t1 = forward ? piece.t1 : piece.t0;
        // Along one strand a crossing changes nothing.
        if (before == nullptr || before->strand != piece.strand) add(pointAt(strand, t0), flatAt(strand, t0));
        const std::uint32_t node = forward ? piece.toNode : piece.fromNode;
        if (node == startNode) {
          if (node >= vertices_.size()) add(pointAt(strand, t1), flatAt(strand, t1));
          break;
        }
        before = &piece;
        p = take(node, before);
        if (p == kNone) return false;
        if (node >= vertices_.size() && pieces_[p].strand != piece.strand)
          add(pointAt(strand, t1), flatAt(strand, t1));
      }
      if (loop.points.size() >= 3) result.push_back(std::move(loop));
    }
  }
  return true;
}

bool CoveredLevels::find(std::vector<Level>& levels, int most) {
  levels.clear();
  makeStrands();
  findCrossings();
  findStrandsAt();
  findPieces();
  int highest = 0;
  for (const Piece& piece : pieces_) highest = std::max({highest, piece.left, piece.right});
  for (int level = 1; level <= std::min(most, highest); ++level) {
    if (!traceLevel(level, levels.emplace_back())) return false;
  }
  return true;
}

}  // namespace halfshadow::scene
