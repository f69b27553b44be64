// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Adjacency of a mesh and its silhouettes seen from a point: what shadow volumes and penumbra wedges are
/// made from.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/bounds.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::scene {

inline constexpr std::uint32_t kNoFace = ~0u;

/// A welded edge: `face` runs from -> to, `opposite` to -> from. Where no face runs the other way (a
/// boundary) `opposite` is kNoFace. An edge of k faces becomes several records: by linearity their
/// contributions add up to the same boundary.
struct EdgeRecord {
  std::uint32_t from = 0, to = 0;  ///< welded vertices
  std::uint32_t face = kNoFace, opposite = kNoFace;
};

/// Cosine of the turn between faces from which on an edge of a sheet is a fold: a corner of a room, not the
/// curve of a bowl.
inline constexpr float kSharpFold = 0.866f;

/// Why a part is a sheet.
enum class PartIssue : std::uint8_t {
  none,           ///< it is closed
  open,           ///< it has openings of more than 1 % of its area
  nonManifold,    ///< more than two faces meet at edges and no closed shell could be told from the rest
  notOrientable,  ///< no choice of windings agrees across all edges
};

/// What building a HalfEdgeMesh repaired besides the parts' own counts.
struct MeshRepairs {
  std::uint32_t mergedVertices = 0;   ///< on open borders, within 1e-6 of the mesh's size of another
  std::uint32_t backToBackFaces = 0;  ///< same corners as another face, opposite winding; dropped
};

/// One connected set of faces: what casts one shadow. Its faces and edges are contiguous ranges.
struct CasterPart {
  std::uint32_t firstFace = 0, faceCount = 0;
  std::uint32_t firstEdge = 0, edgeCount = 0;
  std::uint32_t boundaryEdges = 0;
  std::uint32_t nonManifoldEdges = 0;
  std::uint32_t repairedTJunctions = 0;  ///< faces split at a vertex that lay on their open edge
  std::uint32_t flippedFaces = 0;        ///< against the winding of the source mesh
  std::uint32_t filledGaps = 0;          ///< cracks and small openings closed with faces of their own
  PartIssue issue = PartIssue::none;
  /// The source mesh wound all of this closed part inward, like the walls of a room seen from within. The
  /// part is held outward all the same.
  bool inward = false;
  std::uint32_t firstCluster = 0, clusterCount = 0;
  std::uint32_t firstGroup = 0, groupCount = 0;
  std::uint32_t foldedEdges = 0;  ///< of a sheet: that turn by more than kSharpFold
  /// Seen from outside only light-facing faces occlude, once each. An open part is a sheet that occludes from
  /// both sides: all its faces count, turned towards the light; its two sides are kept apart, because where
  /// they meet at a silhouette edge they cover the same ground twice.
  bool closed = true;
  /// It is closed and convex, or an even sheet: cut at any plane its silhouette still tells what it covers.
  bool convex = false;
  Bounds bounds;  ///< object space
};

/// A few neighbouring faces of one part with similar normals, a contiguous range: seen from most points they
/// all look the same way, which one test of their normals' cone tells.
struct FaceCluster {
  std::uint32_t firstFace = 0, faceCount = 0;
  glm::vec3 center{0.0f};  ///< relative to HalfEdgeMesh::origin()
  glm::vec3 axis{0.0f};    ///< unit normals lie within an angle of it; wide cones have offsets ±infinity
  float cosAngle = 1.0f, sinAngle = 0.0f;
  float lowOffset = 0.0f, highOffset = 0.0f;  ///< range of normal · (face - center), with 0
};

/// The edges between two clusters, or within one (clusterA = clusterB), or at a boundary (clusterB =
/// kNoFace): none of them is a silhouette edge where all the faces of both look the same way.
struct EdgeGroup {
  std::uint32_t clusterA = 0, clusterB = 0;
  std::uint32_t firstEdge = 0, edgeCount = 0;
};

/// What was repaired and why the part is a sheet, one sentence; empty for a closed part that needed nothing.
std::string describe(const CasterPart& part);

/// Half-edge adjacency of a TriangleMesh, with its faces and edges sorted by connected part.
class HalfEdgeMesh {
 public:
  static HalfEdgeMesh build(const TriangleMesh& mesh);
  /// New positions, same topology. `mesh` is the one it was built from.
  void updatePositions(const TriangleMesh& mesh);

  std::span<const glm::vec3> positions() const { return positions_; }  ///< of welded vertices
  std::span<const EdgeRecord> edges() const { return edges_; }
  std::span<const CasterPart> parts() const { return parts_; }
  /// Three welded vertices a face, counter-clockwise seen from outside. Where the mesh had to be repaired
  /// they are not its triangles one by one.
  std::span<const glm::uvec3> faces() const { return faces_; }
  /// Signed distance of a point to a face's plane is dot(xyz, point - origin()) + w; xyz is unit.
  std::span<const glm::vec4> facePlanes() const { return planes_; }
  glm::dvec3 origin() const { return origin_; }
  std::span<const FaceCluster> clusters() const { return clusters_; }
  std::span<const EdgeGroup> edgeGroups() const { return groups_; }
  const MeshRepairs& repairs() const { return repairs_; }

 private:
  void addPart(std::span<const glm::uvec3> faces, CasterPart part);
  void copyPositions(const TriangleMesh& mesh);
  void computePlanes();
  bool isConvex(const CasterPart& part) const;
  std::uint32_t foldedEdges(const CasterPart& part) const;
  std::vector<glm::vec3> positions_;
  std::vector<std::uint32_t> sourceVertex_;  ///< in the TriangleMesh, of each welded vertex
  std::vector<glm::uvec3> faces_;
  std::vector<glm::vec4> planes_;
  std::vector<EdgeRecord> edges_;
  std::vector<CasterPart> parts_;
  std::vector<FaceCluster> clusters_;
  std::vector<EdgeGroup> groups_;
  MeshRepairs repairs_;
  glm::dvec3 origin_{0.0};
};

/// Closed loops of vertices, grouped by part.
struct Silhouette {
  struct Loop {
    std::uint32_t first = 0, count = 0;  ///< in `vertices`; the last vertex joins the first
  };
  struct Part {
    std::uint32_t part = 0;  ///< in HalfEdgeMesh::parts()
    std::uint32_t firstLoop = 0, loopCount = 0;
    bool enclosesLight = false;      ///< the point lies inside this closed part
    bool turnedAway = false;         ///< the side of a sheet whose faces look away from the point
    std::uint32_t region = kNoFace;  ///< of that side, see `regions`; kNoFace: all of it
  };
  std::vector<std::uint32_t> vertices;  ///< welded
  std::vector<Loop> loops;
  std::vector<Part> parts;  ///< those with loops, or enclosing the point; two entries for a sheet's sides
  /// Per face of the mesh: 1 where it faces the point.
  std::vector<std::uint8_t> facing;
  /// Per face, of sides in several regions: sheets are taken apart along sharp folds whose inside the point
  /// looks into. Behind a corner of a room its outline covers what the two walls do; among them it does not.
  std::vector<std::uint32_t> regions;
  /// What the last extraction did.
  struct Counters {
    std::uint64_t facesTested = 0;      ///< one by one; the others were decided with their cluster
    std::uint64_t clustersSkipped = 0;  ///< wholly facing or wholly turned away
    std::uint64_t edgesVisited = 0;
    Counters& operator+=(const Counters& other) {
      facesTested += other.facesTested;
      clustersSkipped += other.clustersSkipped;
      edgesVisited += other.edgesVisited;
      return *this;
    }
  };
  Counters counters;
};

/// Working memory of extractSilhouette(), for any mesh: with the same one again it allocates nothing.
struct SilhouetteScratch {
  struct Link {
    std::uint32_t to = 0;
    std::int32_t next = -1;
  };
  std::vector<Link> links;
  std::vector<std::int32_t> firstLink;
  std::vector<std::uint32_t> starts;
  std::vector<std::uint8_t> clusterFacing;
  std::vector<std::vector<glm::uvec2>> regionEdges;
};

/// The boundary of what `mesh` shows to a light at `lightObject` (object space): loops that run
/// counter-clockwise seen from the light around what they cover. A loop counts once per layer; the boundary
/// of a set of faces is always a union of closed loops, whatever the mesh. Overwrites `silhouette`.
void extractSilhouette(const HalfEdgeMesh& mesh, const glm::dvec3& lightObject, SilhouetteScratch& scratch,
                       Silhouette& silhouette);
/// The same with working memory of its own.
void extractSilhouette(const HalfEdgeMesh& mesh, const glm::dvec3& lightObject, Silhouette& silhouette);

}  // namespace halfshadow::scene
