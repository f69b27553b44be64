// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/windings.hpp"

#include <algorithm>
#include <utility>

namespace halfshadow::scene {
namespace {
constexpr std::uint32_t kNone = ~0u;

struct Neighbour {
  std::uint32_t face = kNone;
  bool disagrees = false;  ///< both run along their edge in the same direction
};

/// The triangle across each of the three edges, where exactly two triangles share the edge. Edge k of a face
/// runs from its corner k to the next.
std::vector<Neighbour> neighboursOf(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  std::vector<Neighbour> across(mesh.indices.size());
  const auto edgeOf = [&](const EdgeUse& use) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.weldedVertex[mesh.indices[3 * std::size_t{use.face} + k]] == use.from()) {
        const std::size_t next = 3 * std::size_t{use.face} + (k + 1) % 3;
        if (mesh.weldedVertex[mesh.indices[next]] == use.to()) return 3 * std::size_t{use.face} + k;
      }
    }
    return 3 * std::size_t{use.face};
  };
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].face == edge[1].face) return;
    const bool disagrees = edge[0].forward == edge[1].forward;
    across[edgeOf(edge[0])] = {edge[1].face, disagrees};
    across[edgeOf(edge[1])] = {edge[0].face, disagrees};
  });
  return across;
}

/// Connected triangles: their patch, and whether each has to be turned to agree with the patch's first.
struct Patches {
  std::vector<std::uint32_t> patchOf;
  std::vector<std::uint8_t> turned;
  std::vector<std::uint8_t> closed;  ///< per patch: can be wound alike and has no border
};

Patches patchesOf(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  const std::vector<Neighbour> across = neighboursOf(mesh, uses);
  Patches patches{std::vector<std::uint32_t>(mesh.triangleCount(), kNone),
                  std::vector<std::uint8_t>(mesh.triangleCount(), 0),
                  {}};
  std::vector<std::uint32_t> pending;
  for (std::uint32_t seed = 0; seed < mesh.triangleCount(); ++seed) {
    if (patches.patchOf[seed] != kNone) continue;
    const auto patch = static_cast<std::uint32_t>(patches.closed.size());
    bool orientable = true;
    patches.patchOf[seed] = patch;
    pending.assign(1, seed);
    while (!pending.empty()) {
      const std::uint32_t face = pending.back();
      pending.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Neighbour& next = across[3 * std::size_t{face} + k];
        if (next.face == kNone) continue;
        const auto wanted = static_cast<std::uint8_t>(patches.turned[face] ^ (next.disagrees ? 1 : 0));
        if (patches.patchOf[next.face] == kNone) {
          patches.patchOf[next.face] = patch;
          patches.turned[next.face] = wanted;
          pending.push_back(next.face);
        } else if (patches.turned[next.face] != wanted) {
          orientable = false;
        }
      }
    }
    patches.closed.push_back(orientable);
  }
  // Shells may touch along an edge: each must run along it as often one way as the other.
  std::vector<std::pair<std::uint32_t, int>> balance;
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    balance.clear();
    for (const EdgeUse& use : edge) {
      const std::uint32_t patch = patches.patchOf[use.face];
      const int step = use.forward != (patches.turned[use.face] != 0) ? 1 : -1;
      const auto known = std::ranges::find(balance, patch, &std::pair<std::uint32_t, int>::first);
      if (known == balance.end()) {
        balance.emplace_back(patch, step);
      } else {
        known->second += step;
      }
    }
    for (const auto& [patch, sum] : balance) {
      if (sum != 0) patches.closed[patch] = 0;
    }
  });
  return patches;
}

void turn(TriangleMesh& mesh, std::size_t triangle) {
  std::swap(mesh.indices[3 * triangle + 1], mesh.indices[3 * triangle + 2]);
  if (mesh.turned.empty()) mesh.turned.assign(mesh.triangleCount(), 0);
  mesh.turned[triangle] ^= 1;
}

/// Of each shell, six times.
std::vector<double> shellVolumes(const TriangleMesh& mesh) {
  std::vector<double> volumes(mesh.shellCount, 0.0);
  std::vector<std::uint32_t> first(mesh.shellCount, kNone);
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const std::uint32_t shell = mesh.shellOf[t];
    if (shell == kNoShell) continue;
    const std::uint32_t* corners = &mesh.indices[3 * t];
    // Relative to a vertex of the shell itself: far from the origin the terms would cancel.
    if (first[shell] == kNone) first[shell] = corners[0];
    const glm::dvec3 origin(mesh.positions[first[shell]]);
    const glm::dvec3 a = glm::dvec3(mesh.positions[corners[0]]) - origin,
                     b = glm::dvec3(mesh.positions[corners[1]]) - origin,
                     c = glm::dvec3(mesh.positions[corners[2]]) - origin;
    volumes[shell] += glm::dot(a, glm::cross(b, c));
  }
  return volumes;
}
}  // namespace

void mendWindings(TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  const Patches patches = patchesOf(mesh, uses);
  std::vector<std::uint32_t> shellOfPatch(patches.closed.size(), kNoShell);
  mesh.shellCount = 0;
  for (std::size_t p = 0; p < patches.closed.size(); ++p) {
    if (patches.closed[p]) shellOfPatch[p] = mesh.shellCount++;
  }
  mesh.shellOf.assign(mesh.triangleCount(), kNoShell);
  mesh.turned.clear();
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    mesh.shellOf[t] = shellOfPatch[patches.patchOf[t]];
    if (mesh.shellOf[t] != kNoShell && patches.turned[t]) turn(mesh, t);
  }
  turnShellsOutward(mesh);
}

bool turnShellsOutward(TriangleMesh& mesh) {
  if (mesh.shellCount == 0) return false;
  const std::vector<double> volumes = shellVolumes(mesh);
  bool any = false;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    // A shell without a volume (a triangle and its back) has no outside and stays.
    if (mesh.shellOf[t] == kNoShell || !(volumes[mesh.shellOf[t]] < 0.0)) continue;
    turn(mesh, t);
    any = true;
  }
  return any;
}

}  // namespace halfshadow::scene
