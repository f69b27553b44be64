// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/validate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/matrix.hpp>
#include <unordered_map>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scenes {
namespace {
using scene::SceneObject;

std::string short4(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// What the adjacency of a mesh came to.
struct Adjacency {
  std::vector<scene::CasterPart> parts;
  scene::MeshRepairs repairs;
};

/// Objects often share a mesh.
class AdjacencyOfMeshes {
 public:
  const Adjacency& of(const scene::TriangleMesh& mesh) {
    const auto [found, added] = known_.try_emplace(&mesh);
    if (added) {
      const scene::HalfEdgeMesh halfEdges = scene::HalfEdgeMesh::build(mesh);
      found->second = {{halfEdges.parts().begin(), halfEdges.parts().end()}, halfEdges.repairs()};
    }
    return found->second;
  }

 private:
  std::unordered_map<const scene::TriangleMesh*, Adjacency> known_;
};

std::string counted(std::uint32_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

void addAdjacency(const Adjacency& adjacency, ObjectReport& report) {
  report.parts = static_cast<std::uint32_t>(adjacency.parts.size());
  report.mergedVertices = adjacency.repairs.mergedVertices;
  report.backToBackFaces = adjacency.repairs.backToBackFaces;
  std::uint32_t inward = 0, unorientable = 0;
  for (const scene::CasterPart& part : adjacency.parts) {
    report.sheets += !part.closed;
    report.looseParts += part.issue == scene::PartIssue::nonManifold;
    report.repairedTJunctions += part.repairedTJunctions;
    report.filledGaps += part.filledGaps;
    report.flippedFaces += part.flippedFaces;
    inward += part.inward;
    unorientable += part.issue == scene::PartIssue::notOrientable;
  }
  report.closed = report.sheets == 0;
  const auto add = [&](std::uint32_t count, const char* one, const char* many) {
    if (count > 0) report.repairs.push_back(counted(count, one, many));
  };
  add(report.backToBackFaces, "face back to back with another left out",
      "faces back to back with others left out");
  add(report.mergedVertices, "vertex merged into one next to it", "vertices merged into those next to them");
  add(report.repairedTJunctions, "T-junction split", "T-junctions split");
  add(report.filledGaps, "crack or small hole filled", "cracks or small holes filled");
  add(report.flippedFaces, "face turned round", "faces turned round");
  add(inward, "part was wound inward: a light inside it still shines out",
      "parts were wound inward: lights inside them still shine out");
  add(unorientable, "part cannot be wound alike and is a sheet",
      "parts cannot be wound alike and are sheets");
}

ObjectReport reportOn(const SceneObject& object, AdjacencyOfMeshes& adjacency) {
  const scene::TriangleMesh& mesh = *object.mesh;
  ObjectReport report{
      .name = object.name,
      .triangles = mesh.triangleCount(),
      .vertices = static_cast<std::uint32_t>(mesh.positions.size()),
      .boundaryEdges = mesh.statistics.boundaryEdges,
      .nonManifoldEdges = mesh.statistics.nonManifoldEdges,
      .degenerateDropped = mesh.statistics.degenerateTrianglesDropped,
      .duplicateDropped = mesh.statistics.duplicateTrianglesDropped,
      .casts = object.casts,
      .receives = object.receives,
  };
  addAdjacency(adjacency.of(mesh), report);
  for (std::uint32_t i = 0; i < mesh.weldedVertex.size(); ++i)
    report.weldedVertices += mesh.weldedVertex[i] == i;
  for (const std::uint32_t index : mesh.indices) {
    report.boundsWorld.include(
        glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(mesh.positions[index]), 1.0)));
  }
  const glm::dvec3 origin(mesh.positions[mesh.indices.front()]);  // near the mesh: no cancellation far from 0
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a = glm::dvec3(mesh.positions[mesh.indices[i]]) - origin;
    const glm::dvec3 b = glm::dvec3(mesh.positions[mesh.indices[i + 1]]) - origin;
    const glm::dvec3 c = glm::dvec3(mesh.positions[mesh.indices[i + 2]]) - origin;
    report.signedVolumeWorld += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  report.signedVolumeWorld *= glm::determinant(glm::dmat3(object.worldFromObject));
  return report;
}

void addObjectWarnings(ObjectReport& report) {
  if (report.casts && !report.closed) {
    report.warnings.push_back(
        "the caster is open (" + counted(report.sheets, "sheet", "sheets") + " of " +
        counted(report.parts, "part", "parts") + ", " +
        counted(report.boundaryEdges, "boundary edge", "boundary edges") +
        "): techniques that use silhouettes count its sides apart; close the holes or give it thickness");
  }
  if (report.casts && report.closed && report.signedVolumeWorld < 0.0) {
    report.warnings.push_back("the caster is wound inside out (negative volume): reverse its triangles");
  }
  if (report.looseParts > 0) {
    report.warnings.push_back(
        counted(report.looseParts, "part hangs", "parts hang") +
        " on edges of more than two triangles (fins, inner walls): taken as sheets of their own; separate "
        "or remove them");
  } else if (report.nonManifoldEdges > 0 && report.sheets > 0) {
    report.warnings.push_back(counted(report.nonManifoldEdges, "edge has", "edges have") +
                              " more than two triangles: silhouettes branch there; separate the parts");
  }
  if (report.degenerateDropped + report.duplicateDropped > 0) {
    report.warnings.push_back(std::to_string(report.degenerateDropped) + " zero-area and " +
                              std::to_string(report.duplicateDropped) + " duplicate triangles were dropped");
  }
  const double size = report.boundsWorld.radius();
  const double away = glm::length(report.boundsWorld.center());
  // 1e5 radii: a float position (24 bits) then has 7 bits left for the object itself.
  if (size > 0.0 && away > 1e5 * size) {
    report.warnings.push_back(
        "the object is " + short4(away / size) +
        " times its radius away from the origin: positions lose precision; move it nearer");
  }
}
}  // namespace

ValidationReport validateScene(const scene::SceneDescription& description) {
  ValidationReport report{.name = description.name, .warnings = description.notes};
  std::uint32_t receivers = 0;
  AdjacencyOfMeshes adjacency;
  for (const SceneObject& object : description.objects) {
    ObjectReport objectReport = reportOn(object, adjacency);
    addObjectWarnings(objectReport);
    report.triangles += objectReport.triangles;
    report.boundsWorld.include(objectReport.boundsWorld);
    if (object.casts) {
      ++report.casters;
      report.openCasters += !objectReport.closed;
      report.repairedCasters += !objectReport.repairs.empty();
      report.casterParts += objectReport.parts;
      report.casterBoundsWorld.include(objectReport.boundsWorld);
    }
    receivers += object.receives;
    report.objects.push_back(std::move(objectReport));
  }
  if (report.casters == 0) report.warnings.push_back("no object casts: every technique answers fully lit");
  if (receivers == 0) report.warnings.push_back("no object receives: there is nothing to ask visibility on");
  const double radius = report.boundsWorld.radius();
  if (radius > 1e5 || (radius > 0.0 && radius < 1e-4)) {
    report.warnings.push_back(
        "the scene's radius is " + short4(radius) +
        " units: scale it to between 0.0001 and 100000 so that depths keep their precision");
  }
  const double casterRadius = report.casterBoundsWorld.radius();
  // 1e3: a 1024-texel map stretched over everything would give the casters about one texel.
  if (casterRadius > 0.0 && radius > 1e3 * casterRadius) {
    report.warnings.push_back("the scene is " + short4(radius / casterRadius) +
                              " times larger than its casters: fit maps to the casters, not to the scene");
  }
  return report;
}

}  // namespace halfshadow::scenes
