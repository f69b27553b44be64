// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/validate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/matrix.hpp>
#include <limits>
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
  add(report.turnedTriangles, "triangle wound inward turned round, for drawing too",
      "triangles wound inward turned round, for drawing too");
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
  report.turnedTriangles =
      static_cast<std::uint32_t>(std::count(mesh.turned.begin(), mesh.turned.end(), std::uint8_t{1}));
  addAdjacency(adjacency.of(mesh), report);
  for (std::uint32_t i = 0; i < mesh.weldedVertex.size(); ++i)
    report.weldedVertices += mesh.weldedVertex[i] == i;
  for (const std::uint32_t index : mesh.indices) {
    report.boundsWorld.include(
        glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(mesh.positions[index]), 1.0)));
  }
  const scene::Bounds boundsObject = scene::boundsOf(mesh);
  report.radiusObject = boundsObject.radius();
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(boundsObject.low[axis]), std::abs(boundsObject.high[axis])});
  }
  const auto asFloat = static_cast<float>(largest);
  report.coordinateStep =
      std::nextafter(asFloat, std::numeric_limits<float>::infinity()) - static_cast<double>(asFloat);
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
    report.warnings.push_back("the caster is open (" + counted(report.sheets, "sheet", "sheets") + " of " +
                              counted(report.parts, "part", "parts") + ", " +
                              counted(report.boundaryEdges, "boundary edge", "boundary edges") +
                              "): techniques that use silhouettes count its sides once, the one that covers "
                              "more; light comes through where neither has a face");
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
  // Half a step is the most a vertex is displaced: beyond a thousandth of the radius facets are seen to tilt.
  if (report.coordinateStep > 2e-3 * report.radiusObject) {
    report.warnings.push_back(
        "single precision moves the object's vertices in steps of " + short4(report.coordinateStep) + ", " +
        short4(report.coordinateStep / report.radiusObject) +
        " of its radius, as far from the origin of its own coordinates as they are: its "
        "shape is no longer what was modelled; keep the vertices near that origin and "
        "place them by the node's transform");
  }
}
/// A light sees all its casters through one map of this many texels a side.
constexpr double kMapTexels = 1024.0;
/// What a filter needs of a caster to tell it from its neighbours.
constexpr double kLeastTexels = 4.0;

void addCasterWarnings(ValidationReport& report) {
  double smallest = std::numeric_limits<double>::infinity();
  const std::string* name = nullptr;
  for (const ObjectReport& object : report.objects) {
    const double radius = object.boundsWorld.radius();
    if (!object.casts || !(radius > 0.0) || radius >= smallest) continue;
    smallest = radius;
    name = &object.name;
  }
  const double all = report.casterBoundsWorld.radius();
  if (name == nullptr || kMapTexels * smallest >= kLeastTexels * all) return;
  report.warnings.push_back(
      "the casters together are " + short4(all / smallest) + " times as large as \"" + *name +
      "\", which is " + short4(kMapTexels * smallest / all) +
      " texels of a shadow map of 1024: use a technique without maps (wedges-cells), or "
      "let what is far away cast nothing");
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
      report.cutCasters += object.material.alphaCutoff > 0.0f;
      report.repairedCasters += !objectReport.repairs.empty();
      report.casterParts += objectReport.parts;
      report.casterBoundsWorld.include(objectReport.boundsWorld);
    }
    receivers += object.receives;
    report.objects.push_back(std::move(objectReport));
  }
  if (report.casters == 0) report.warnings.push_back("no object casts: every technique answers fully lit");
  if (receivers == 0) report.warnings.push_back("no object receives: there is nothing to ask visibility on");
  addCasterWarnings(report);
  return report;
}

}  // namespace halfshadow::scenes
