// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Shadow volumes of one caster on the CPU: quads from its silhouette to infinity, and caps.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::techniques {

/// Which surfaces bound a volume.
enum class VolumeSurface {
  sides,  ///< enough to count in front of receivers, when no eye ray starts inside
  capped  ///< the same, the faces turned to the light and the far closure: a closed surface
};

/// Edges and faces of a caster whose shadow is at most `layers` thick along any ray from the light.
struct VolumeChunk {
  /// Faces of one part and the edges around what they cover.
  struct Group {
    std::uint32_t firstFace = 0, faceCount = 0;
    std::uint32_t firstEdge = 0, edgeCount = 0;  ///< in `edges`
    bool sheet = false;  ///< every face counts, turned to the light; else those that face it
    /// All of it lies within less than a right angle of one direction, so that its far closure may be any fan
    /// over its edges.
    bool withinHemisphere = true;
  };
  std::vector<Group> groups;
  std::vector<glm::uvec2> edges;  ///< counter-clockwise seen from the light around what they cover
  int layers = 0;
};

/// Splits a caster into chunks of at most `maxLayers` layers each, most often one. The bound of layers is
/// proven: a ray is covered as often as the silhouette winds around it, and that is no more than the number
/// of edges that rise through some line of sight.
std::vector<VolumeChunk> volumeChunks(const scene::HalfEdgeMesh& mesh, const scene::Silhouette& silhouette,
                                      const glm::dvec3& lightObject, int maxLayers);

/// Vertices are (x, y, z, 1), object space, or (x, y, z, 0): the direction from the light along world axes,
/// for a point at infinity. Triangles run counter-clockwise seen from outside of the volume, in object space.
struct VolumeMesh {
  struct Range {
    std::uint32_t firstVertex = 0;  ///< to which its indices are relative
    std::uint32_t firstIndex = 0, indexCount = 0;
    std::uint32_t chunk = 0;
  };
  std::vector<glm::vec4> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Range> ranges;  ///< sorted by chunk
};

/// `lightWorld` is subtracted in double; `maxVertices`: of one range, at least 16.
/// Based on: Crow, "Shadow Algorithms for Computer Graphics", 1977; Everitt, Kilgard, "Practical and Robust
/// Stenciled Shadow Volumes", 2002, sections 3 and 5 (vertices at infinity).
VolumeMesh buildVolumeMesh(const scene::HalfEdgeMesh& mesh, const scene::Silhouette& silhouette,
                           const std::vector<VolumeChunk>& chunks, const glm::dmat4& worldFromObject,
                           const glm::dvec3& lightWorld, VolumeSurface surface, std::uint32_t maxVertices);

}  // namespace halfshadow::techniques
