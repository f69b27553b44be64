// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/mesh_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "scene/border_repair.hpp"
#include "scene/edge_uses.hpp"

namespace halfshadow::scene {
namespace {
using Faces = std::vector<glm::uvec3>;

bool allClean(std::span<const EdgeUse> uses) {
  bool clean = true;
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) { clean = clean && isClean(edge); });
  return clean;
}

bool balanced(std::span<const glm::uvec3> faces) {
  bool balance = true;
  forEachEdge(edgeUses(faces),
              [&](std::span<const EdgeUse> edge) { balance = balance && imbalance(edge) == 0; });
  return balance;
}

double areaOf(std::span<const glm::uvec3> faces, std::span<const glm::vec3> positions) {
  double sum = 0.0;
  for (const glm::uvec3& f : faces) {
    const glm::dvec3 a(positions[f.x]), b(positions[f.y]), c(positions[f.z]);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return sum;
}

/// Positive for a closed part that is wound outward.
double signedVolume(std::span<const glm::uvec3> faces, std::span<const glm::vec3> positions) {
  const glm::dvec3 origin(positions[faces.front().x]);
  double sum = 0.0;
  for (const glm::uvec3& f : faces) {
    const glm::dvec3 a = glm::dvec3(positions[f.x]) - origin, b = glm::dvec3(positions[f.y]) - origin;
    sum += glm::dot(a, glm::cross(b, glm::dvec3(positions[f.z]) - origin)) / 6.0;
  }
  return sum;
}

void flip(glm::uvec3& face) {
  std::swap(face.y, face.z);
}

/// Of faces with the same corners and opposite windings only the first stays.
std::uint32_t dropBackToBack(std::vector<SoupFace>& faces) {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> seen;
  const std::size_t before = faces.size();
  std::erase_if(faces, [&](const SoupFace& face) {
    std::array<std::uint32_t, 3> corners{face.corners.x, face.corners.y, face.corners.z};
    std::sort(corners.begin(), corners.end());
    return seen[corners]++ > 0;
  });
  return static_cast<std::uint32_t>(before - faces.size());
}

/// Faces connected across edges of exactly two faces, wound alike.
struct Patch {
  std::vector<std::uint32_t> faces;  ///< indices
  bool orientable = true;
};

/// Flips faces so that neighbours across edges of two faces agree, each patch to what most of its faces had.
std::vector<Patch> orientPatches(Faces& faces, std::uint32_t& flipped) {
  const std::vector<EdgeUse> uses = edgeUses(faces);
  struct Neighbour {
    std::uint32_t face;
    bool disagrees;
  };
  std::vector<std::vector<Neighbour>> neighbours(faces.size());
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].face == edge[1].face) return;
    const bool disagrees = edge[0].forward == edge[1].forward;
    neighbours[edge[0].face].push_back({edge[1].face, disagrees});
    neighbours[edge[1].face].push_back({edge[0].face, disagrees});
  });
  std::vector<Patch> patches;
  enum : std::uint8_t { unseen, kept, turned };
  std::vector<std::uint8_t> state(faces.size(), unseen);
  for (std::uint32_t seed = 0; seed < faces.size(); ++seed) {
    if (state[seed] != unseen) continue;
    Patch patch{.faces = {seed}};
    state[seed] = kept;
    std::size_t turnedCount = 0;
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
      const std::uint32_t face = patch.faces[i];
      for (const Neighbour& neighbour : neighbours[face]) {
        const std::uint8_t wanted = (state[face] == turned) != neighbour.disagrees ? turned : kept;
        if (state[neighbour.face] == unseen) {
          state[neighbour.face] = wanted;
          turnedCount += wanted == turned;
          patch.faces.push_back(neighbour.face);
        } else if (state[neighbour.face] != wanted) {
          patch.orientable = false;
        }
      }
    }
    const std::uint8_t minority = 2 * turnedCount > patch.faces.size() ? kept : turned;
    if (patch.orientable) {
      for (const std::uint32_t face : patch.faces) {
        if (state[face] != minority) continue;
        flip(faces[face]);
        ++flipped;
      }
    }
    std::sort(patch.faces.begin(), patch.faces.end());
    patches.push_back(std::move(patch));
  }
  return patches;
}

Faces facesOf(const Faces& faces, const Patch& patch) {
  Faces result;
  for (const std::uint32_t f : patch.faces) result.push_back(faces[f]);
  return result;
}

/// Everything but the patches marked.
Faces without(const Faces& faces, const std::vector<Patch>& patches, const std::vector<bool>& leaveOut) {
  std::vector<bool> out(faces.size(), false);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (!leaveOut[p]) continue;
    for (const std::uint32_t f : patches[p].faces) out[f] = true;
  }
  Faces result;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!out[f]) result.push_back(faces[f]);
  }
  return result;
}

/// Takes one connected part apart and closes what can be closed.
class PartRepair {
 public:
  PartRepair(std::span<const glm::vec3> positions, std::vector<RepairedPart>& out)
      : positions_(positions), out_(out) {}

  void repair(Faces faces, std::uint32_t tJunctions) {
    facts_ = {.repairedTJunctions = tJunctions};
    if (allClean(edgeUses(faces))) {
      emit(std::move(faces), PartIssue::none);
      return;
    }
    const std::vector<Patch> patches = orientPatches(faces, facts_.flippedFaces);
    if (std::any_of(patches.begin(), patches.end(), [](const Patch& p) { return !p.orientable; })) {
      emit(std::move(faces), PartIssue::notOrientable);
      return;
    }
    fillGaps(faces);
    separate(std::move(faces));
  }

 private:
  void fillGaps(Faces& faces) {
    const double surface = areaOf(faces, positions_);
    std::vector<Filling> fillings;
    double total = 0.0;
    for (const BorderLoop& loop : borderLoops(faces)) {
      fillings.push_back(fillLoop(loop, positions_));
      total += fillings.back().area;
    }
    for (const Filling& filling : fillings) {
      // A crack a thousandth as wide as long, or openings through which next to no straight ray passes.
      const bool crack = filling.area <= 2.5e-4 * filling.perimeter * filling.perimeter;
      const bool narrow = crack && filling.area <= 1e-3 * surface;
      if (!narrow && total > 0.01 * surface) continue;
      faces.insert(faces.end(), filling.faces.begin(), filling.faces.end());
      ++facts_.filledGaps;
    }
  }

  /// Closed shells become parts; what hangs on them, sheets.
  void separate(Faces faces) {
    PartIssue ofLast = PartIssue::open;
    while (!faces.empty()) {
      const std::vector<Patch> patches = orientPatches(faces, facts_.flippedFaces);
      if (patches.size() == 1) {
        emit(std::move(faces), ofLast);
        return;
      }
      std::vector<bool> taken(patches.size(), false);
      bool any = takeIf(faces, patches, taken, [&](const Patch& p) { return balanced(facesOf(faces, p)); });
      if (!any) any = takeFins(faces, patches, taken);
      if (!any) any = takeInnerWall(faces, patches, taken);
      if (!any) {
        emit(std::move(faces), PartIssue::nonManifold);
        return;
      }
      faces = without(faces, patches, taken);
      ofLast = PartIssue::nonManifold;
    }
  }

  template <class Condition>
  bool takeIf(const Faces& faces, const std::vector<Patch>& patches, std::vector<bool>& taken,
              Condition&& condition) {
    bool any = false;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      if (!condition(patches[p])) continue;
      taken[p] = any = true;
      emit(facesOf(faces, patches[p]), PartIssue::nonManifold);
    }
    return any;
  }

  /// Patches with a free edge cannot be part of a closed shell.
  bool takeFins(const Faces& faces, const std::vector<Patch>& patches, std::vector<bool>& taken) {
    std::vector<bool> free(faces.size(), false);
    forEachEdge(edgeUses(faces), [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 1) free[edge[0].face] = true;
    });
    return takeIf(faces, patches, taken, [&](const Patch& patch) {
      return std::any_of(patch.faces.begin(), patch.faces.end(), [&](std::uint32_t f) { return free[f]; });
    });
  }

  /// A wall whose removal leaves a closed shell: the smallest such patch.
  bool takeInnerWall(const Faces& faces, const std::vector<Patch>& patches, std::vector<bool>& taken) {
    // Each try costs a pass over the part; junctions of more patches than this are rare and stay a sheet.
    constexpr std::size_t kMostPatches = 32;
    if (patches.size() > kMostPatches || balanced(faces)) return false;
    std::vector<std::pair<double, std::size_t>> bySize;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      bySize.emplace_back(areaOf(facesOf(faces, patches[p]), positions_), p);
    }
    std::sort(bySize.begin(), bySize.end());
    for (const auto& [area, p] : bySize) {
      std::vector<bool> leaveOut(patches.size(), false);
      leaveOut[p] = true;
      Faces rest = without(faces, patches, leaveOut);
      std::uint32_t flipped = 0;
      orientPatches(rest, flipped);
      if (!balanced(rest)) continue;
      taken[p] = true;
      emit(facesOf(faces, patches[p]), PartIssue::nonManifold);
      return true;
    }
    return false;
  }

  /// Adds a part: closed where each edge runs as often both ways, else a sheet because of `ifOpen`.
  void emit(Faces faces, PartIssue ifOpen) {
    RepairedPart part{.faces = std::move(faces), .facts = std::exchange(facts_, CasterPart{})};
    part.facts.closed = ifOpen != PartIssue::notOrientable && balanced(part.faces);
    part.facts.issue = part.facts.closed ? PartIssue::none : ifOpen;
    if (part.facts.closed && signedVolume(part.faces, positions_) < 0.0) {
      for (glm::uvec3& face : part.faces) flip(face);
      const auto count = static_cast<std::uint32_t>(part.faces.size());
      part.facts.inward = part.facts.flippedFaces == 0;
      part.facts.flippedFaces = count - std::min(count, part.facts.flippedFaces);
    }
    out_.push_back(std::move(part));
  }

  std::span<const glm::vec3> positions_;
  std::vector<RepairedPart>& out_;
  CasterPart facts_;  ///< counts that go to the next part emitted
};
}  // namespace

std::vector<RepairedPart> repairParts(Faces faces, std::span<const glm::vec3> positions,
                                      MeshRepairs& repairs) {
  std::vector<EdgeUse> uses = edgeUses(faces);
  std::vector<SoupFace> soup(faces.size());
  std::transform(faces.begin(), faces.end(), soup.begin(), [](const glm::uvec3& f) { return SoupFace{f}; });
  if (!allClean(uses)) {
    repairs.backToBackFaces = dropBackToBack(soup);
    repairs.mergedVertices = mergeNearBorderVertices(soup, positions);
    splitTJunctions(soup, positions);
    faces.clear();
    for (const SoupFace& face : soup) faces.push_back(face.corners);
    uses = edgeUses(faces);
  }
  DisjointSets connected(faces.size());
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge) connected.merge(use.face, edge[0].face);
  });
  std::vector<std::uint32_t> partOf;
  const std::uint32_t count = connected.number(partOf);
  std::vector<Faces> facesOfPart(count);
  std::vector<std::uint32_t> tJunctions(count, 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    facesOfPart[partOf[f]].push_back(faces[f]);
    tJunctions[partOf[f]] += soup[f].splitOff;
  }
  std::vector<RepairedPart> parts;
  PartRepair repair(positions, parts);
  for (std::uint32_t p = 0; p < count; ++p) repair.repair(std::move(facesOfPart[p]), tJunctions[p]);
  return parts;
}

}  // namespace halfshadow::scene
