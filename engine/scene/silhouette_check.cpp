// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/silhouette_check.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace halfshadow::scene {
namespace {
/// How often an edge is run from its smaller vertex to its larger one, less the other way.
using Chain = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

void add(Chain& chain, std::uint32_t from, std::uint32_t to, int times) {
  const auto at = chain.try_emplace(std::minmax(from, to), 0).first;
  at->second += from < to ? times : -times;
  if (at->second == 0) chain.erase(at);
}

/// Adds the boundary of the part's faces of one side: those towards the light, or the others turned round.
void addFaces(const HalfEdgeMesh& mesh, const Silhouette& silhouette, const CasterPart& part, bool away,
              Chain& chain) {
  for (std::uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
    if ((silhouette.facing[f] == 0) != away) continue;
    for (int k = 0; k < 3; ++k) {
      add(chain, mesh.faces()[f][k], mesh.faces()[f][(k + 1) % 3], away ? -1 : 1);
    }
  }
}
}  // namespace

std::string silhouetteProblem(const HalfEdgeMesh& mesh, const Silhouette& silhouette) {
  std::map<std::pair<std::uint32_t, bool>, Chain> expected;  // of part and side
  for (std::uint32_t p = 0; p < mesh.parts().size(); ++p) {
    const CasterPart& part = mesh.parts()[p];
    addFaces(mesh, silhouette, part, false, expected[{p, false}]);
    if (!part.closed) addFaces(mesh, silhouette, part, true, expected[{p, true}]);
  }
  for (const Silhouette::Part& entry : silhouette.parts) {
    Chain& chain = expected[{entry.part, entry.turnedAway}];
    for (std::uint32_t l = entry.firstLoop; l < entry.firstLoop + entry.loopCount; ++l) {
      const Silhouette::Loop& loop = silhouette.loops[l];
      if (loop.count < 3) return "loop " + std::to_string(l) + " has less than three vertices";
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        add(chain, silhouette.vertices[loop.first + i],
            silhouette.vertices[loop.first + (i + 1) % loop.count], -1);
      }
    }
  }
  for (const auto& [key, chain] : expected) {
    if (chain.empty()) continue;
    const auto& [edge, times] = *chain.begin();
    return "part " + std::to_string(key.first) + ": the edge of vertices " + std::to_string(edge.first) +
           " and " + std::to_string(edge.second) + " is off by " + std::to_string(times);
  }
  return {};
}

}  // namespace halfshadow::scene
