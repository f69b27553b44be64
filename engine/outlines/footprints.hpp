// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The parts of a receiver's surface that pieces of silhouettes can shadow, with the pieces as seen from
/// there. CPU only; nothing depends on the camera.
#pragma once

#include "outlines/wedge_bounds.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::outlines {

/// Least height of receivers above all vertices of a piece, in units of its caster's size, for which nothing
/// is clipped: HS_WEDGE_ALL_NEAR.
inline constexpr double kAllVerticesNear = 1e-3;

/// A vertex P of a footprint with the vertices E of its piece projected from it onto the light's plane:
/// (x, y, w) = (hP·E.ab - hE·P.ab, hP - hE) / size, of which x / w and y / w are the place on the light.
/// Linear in P. Short pieces repeat their last vertex.
struct FootprintVertex {
  glm::vec3 positionObject{0.0f};
  float inverseSize = 1.0f;  ///< of the piece's caster, see WedgePiece::size()
  std::array<float, kPieceVertices> x{}, y{}, w{};
  glm::vec4 facet{0.0f};  ///< the triangle's plane: dot(xyz, (a, b, h - 1)) = w
};

/// Triangles, three vertices each, wound like the receiver's.
struct Footprints {
  std::vector<FootprintVertex> beside;  ///< some of the piece may be farther from the light
  std::vector<FootprintVertex> beyond;  ///< all of the piece is nearer to the light
  std::size_t vertices() const { return beside.size() + beyond.size(); }
};

/// A receiver's surface in the coordinates of a light.
struct ReceiverTriangles {
  ReceiverTriangles(const scene::TriangleMesh& mesh, const glm::dmat4& worldFromObject,
                    const scene::LightPlane& plane);
  const scene::TriangleMesh& mesh;
  std::vector<glm::dvec3> placed;  ///< (a, b, h) of each of the mesh's positions
  LightBox bounds;
};

/// Appends the receiver's triangles, cut to the volume of the piece. Neighbouring triangles are cut at the
/// same points of the edge that they share.
void addFootprints(const ReceiverTriangles& receiver, const WedgePieces& pieces, const WedgePiece& piece,
                   Footprints& result);

}  // namespace halfshadow::outlines
