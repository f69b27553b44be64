// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/bounds.hpp"
#include "scenes/gltf_accessors.hpp"
#include "scenes/gltf_materials.hpp"

namespace halfshadow::scenes {
namespace {
struct Vertices {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  ///< empty or one per position
  std::vector<glm::vec2> texcoords;
  std::vector<glm::vec4> colors;  ///< empty or one per position
};

std::string nameOf(const PrimitiveRequest& request) {
  return "primitive " + std::to_string(request.primitive) + " of mesh " + std::to_string(request.mesh);
}

Result<std::vector<glm::dvec3>> readVectors(const tinygltf::Model& model, int accessor,
                                            const std::string& name) {
  const Result<AccessorValues> values = readAccessor(model, accessor, {.name = name, .components = 3});
  if (!values) return values.error();
  std::vector<glm::dvec3> vectors(values->count);
  for (std::size_t i = 0; i < values->count; ++i)
    vectors[i] = {(*values)[i][0], (*values)[i][1], (*values)[i][2]};
  return vectors;
}

Status checkCount(std::size_t count, const Vertices& vertices, const std::string& what) {
  if (count == vertices.positions.size()) return {};
  return malformed(what + " has " + std::to_string(count) + " elements for " +
                   std::to_string(vertices.positions.size()) + " positions; export it again");
}

/// Of the material's base colour image.
TextureCoordinates texcoordsOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const bool hasMaterial =
      primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < model.materials.size();
  return hasMaterial ? textureCoordinatesOf(model.materials[primitive.material]) : TextureCoordinates();
}

Status readTexcoords(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                     const std::string& what, Vertices& vertices) {
  const TextureCoordinates use = texcoordsOf(model, primitive);
  const auto texcoord = primitive.attributes.find("TEXCOORD_" + std::to_string(use.set));
  if (texcoord == primitive.attributes.end()) return {};
  const std::string name = texcoord->first + " of " + what;
  const Result<AccessorValues> values =
      readAccessor(model, texcoord->second, {.name = name, .components = 2});
  if (!values) return values.error();
  if (Status s = checkCount(values->count, vertices, name); !s) return s;
  vertices.texcoords.reserve(values->count);
  for (std::size_t i = 0; i < values->count; ++i) {
    vertices.texcoords.emplace_back(use.imageFromFile * glm::dvec3((*values)[i][0], (*values)[i][1], 1.0));
  }
  return {};
}

Status readColors(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::string& what,
                  Vertices& vertices) {
  const auto color = primitive.attributes.find("COLOR_0");
  if (color == primitive.attributes.end()) return {};
  const std::string name = "COLOR_0 of " + what;
  const bool exists = color->second >= 0 && static_cast<std::size_t>(color->second) < model.accessors.size();
  const bool hasAlpha = exists && model.accessors[color->second].type == TINYGLTF_TYPE_VEC4;
  const Result<AccessorValues> values =
      readAccessor(model, color->second, {.name = name, .components = hasAlpha ? 4u : 3u});
  if (!values) return values.error();
  if (Status s = checkCount(values->count, vertices, name); !s) return s;
  vertices.colors.reserve(values->count);
  for (std::size_t i = 0; i < values->count; ++i) {
    const double* c = (*values)[i];
    const glm::dvec4 rgba(c[0], c[1], c[2], hasAlpha ? c[3] : 1.0);
    vertices.colors.emplace_back(glm::clamp(rgba, 0.0, 1.0));
  }
  return {};
}

Result<Vertices> readVertices(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                              const std::string& what) {
  const auto& attributes = primitive.attributes;
  const auto position = attributes.find("POSITION");
  if (position == attributes.end()) return malformed(what + " has no POSITION; give it one or remove it");
  Vertices vertices;
  Result<std::vector<glm::dvec3>> positions = readVectors(model, position->second, "POSITION of " + what);
  if (!positions) return positions.error();
  vertices.positions = std::move(positions).value();
  if (const auto normal = attributes.find("NORMAL"); normal != attributes.end()) {
    Result<std::vector<glm::dvec3>> normals = readVectors(model, normal->second, "NORMAL of " + what);
    if (!normals) return normals.error();
    vertices.normals = std::move(normals).value();
    if (Status s = checkCount(vertices.normals.size(), vertices, "NORMAL of " + what); !s) return s.error();
  }
  if (Status s = readTexcoords(model, primitive, what, vertices); !s) return s.error();
  if (Status s = readColors(model, primitive, what, vertices); !s) return s.error();
  return vertices;
}

Status applyMorphs(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                   const std::vector<double>& weights, const std::string& what, Vertices& vertices) {
  for (std::size_t target = 0; target < primitive.targets.size() && target < weights.size(); ++target) {
    if (weights[target] == 0.0) continue;
    const std::string suffix = " of morph target " + std::to_string(target) + " of " + what;
    for (const char* attribute : {"POSITION", "NORMAL"}) {
      const auto found = primitive.targets[target].find(attribute);
      std::vector<glm::dvec3>& moved = attribute[0] == 'P' ? vertices.positions : vertices.normals;
      if (found == primitive.targets[target].end() || moved.empty()) continue;
      const Result<std::vector<glm::dvec3>> offsets = readVectors(model, found->second, attribute + suffix);
      if (!offsets) return offsets.error();
      if (Status s = checkCount(offsets->size(), vertices, attribute + suffix); !s) return s;
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += weights[target] * (*offsets)[i];
    }
  }
  return {};
}

/// Adds weight · joint matrix of one set JOINTS_n, WEIGHTS_n to `blended`.
Status addInfluences(const tinygltf::Model& model, int jointsAccessor, int weightsAccessor,
                     const std::string& what, const std::vector<glm::dmat4>& matrices,
                     std::vector<glm::dmat4>& blended, std::vector<double>& weightSums) {
  const Result<AccessorValues> joints = readAccessor(
      model, jointsAccessor, {.name = "JOINTS of " + what, .components = 4, .integersOnly = true});
  if (!joints) return joints.error();
  const Result<AccessorValues> weights =
      readAccessor(model, weightsAccessor, {.name = "WEIGHTS of " + what, .components = 4});
  if (!weights) return weights.error();
  if (joints->count != blended.size() || weights->count != blended.size()) {
    return malformed("JOINTS or WEIGHTS of " + what +
                     " do not have one element per position; export it again");
  }
  for (std::size_t i = 0; i < blended.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const double weight = (*weights)[i][k];
      if (weight == 0.0) continue;
      const double joint = (*joints)[i][k];
      if (joint >= static_cast<double>(matrices.size())) {
        return malformed("JOINTS of " + what + " names joint " +
                         std::to_string(static_cast<long long>(joint)) + " but the skin has only " +
                         std::to_string(matrices.size()));
      }
      blended[i] += matrices[static_cast<std::size_t>(joint)] * weight;
      weightSums[i] += weight;
    }
  }
  return {};
}

Status applySkin(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                 const std::vector<glm::dmat4>& matrices, const std::string& what, Vertices& vertices) {
  std::vector<glm::dmat4> blended(vertices.positions.size(), glm::dmat4(0.0));
  std::vector<double> weightSums(vertices.positions.size(), 0.0);
  for (int set = 0;; ++set) {
    const auto joints = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) {
      if (set == 0)
        return malformed(what + " is skinned but has no JOINTS_0 or no WEIGHTS_0; export it again");
      break;
    }
    const Status status =
        addInfluences(model, joints->second, weights->second, what, matrices, blended, weightSums);
    if (!status) return status;
  }
  for (std::size_t i = 0; i < blended.size(); ++i) {
    // Weights should sum to one; rounding and careless exporters make it not quite so. Without any, the first
    // joint carries the vertex.
    const glm::dmat4 m = weightSums[i] > 0.0 ? blended[i] * (1.0 / weightSums[i]) : matrices.front();
    vertices.positions[i] = glm::dvec3(m * glm::dvec4(vertices.positions[i], 1.0));
    if (!vertices.normals.empty()) vertices.normals[i] = glm::dmat3(m) * vertices.normals[i];
  }
  return {};
}

Result<std::vector<std::uint32_t>> readCorners(const tinygltf::Model& model,
                                               const tinygltf::Primitive& primitive, std::size_t vertexCount,
                                               const std::string& what) {
  std::vector<std::uint32_t> corners;
  if (primitive.indices < 0) {
    corners.resize(vertexCount);
    for (std::size_t i = 0; i < vertexCount; ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }
  const Result<AccessorValues> values =
      readAccessor(model, primitive.indices, {.name = "indices of " + what, .integersOnly = true});
  if (!values) return values.error();
  corners.resize(values->count);
  for (std::size_t i = 0; i < values->count; ++i) {
    if (values->numbers[i] >= static_cast<double>(vertexCount)) {
      return malformed("index " + std::to_string(i) + " of " + what + " is " +
                       std::to_string(static_cast<std::uint32_t>(values->numbers[i])) +
                       " but there are only " + std::to_string(vertexCount) + " vertices; export it again");
    }
    corners[i] = static_cast<std::uint32_t>(values->numbers[i]);
  }
  return corners;
}

std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return corners;
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles.insert(triangles.end(), {corners[i + 1], corners[i + 2], corners[0]});
    } else {  // every other triangle of a strip turns the other way
      triangles.insert(triangles.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    }
  }
  return triangles;
}

/// World positions of what its node's transform flattens: no matrix takes them back.
void applyFlattening(const glm::dmat4& worldFromNode, Vertices& vertices) {
  for (glm::dvec3& position : vertices.positions)
    position = glm::dvec3(worldFromNode * glm::dvec4(position, 1.0));
  vertices.normals.clear();  // the facets' are what is left
}

/// More joint matrices mirror than do not.
bool mostMirror(const std::vector<glm::dmat4>& matrices) {
  const auto mirrors = std::ranges::count_if(
      matrices, [](const glm::dmat4& m) { return glm::determinant(glm::dmat3(m)) < 0.0; });
  return 2 * mirrors > static_cast<std::ptrdiff_t>(matrices.size());
}

/// Skinned vertices are world positions in double: about their middle single precision holds them as well as
/// at the origin, wherever the skeleton stands.
glm::dvec3 middleOf(const std::vector<glm::dvec3>& positions) {
  scene::Bounds bounds;
  for (const glm::dvec3& position : positions) bounds.include(position);
  return bounds.empty() ? glm::dvec3(0.0) : bounds.center();
}

/// Unit normals, or none when one of them has no direction: flat shading is better than a black spot.
std::vector<glm::vec3> unitNormals(const std::vector<glm::dvec3>& normals) {
  std::vector<glm::vec3> result;
  for (const glm::dvec3& normal : normals) {
    const double length = glm::length(normal);
    if (!(length > 0.0) || !std::isfinite(length)) return {};
    result.push_back(glm::vec3(normal / length));
  }
  return result;
}
}  // namespace

Result<PrimitiveMesh> primitiveMesh(const tinygltf::Model& model, const PrimitiveRequest& request,
                                    SkippedPrimitives& skipped) {
  const tinygltf::Mesh& source = model.meshes[request.mesh];
  const tinygltf::Primitive& primitive = source.primitives[request.primitive];
  const std::string what = nameOf(request);
  PrimitiveMesh result;
  if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    return malformed(what + " has the unknown mode " + std::to_string(primitive.mode));
  }
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
    skipped.pointsOrLines.push_back(what);
    return PrimitiveMesh{};
  }
  Result<Vertices> vertices = readVertices(model, primitive, what);
  if (!vertices) return vertices.error();
  const auto& weights = request.morphWeights != nullptr ? *request.morphWeights : source.weights;
  if (Status s = applyMorphs(model, primitive, weights, what, *vertices); !s) return s.error();
  if (request.jointMatrices != nullptr) {
    if (Status s = applySkin(model, primitive, *request.jointMatrices, what, *vertices); !s) return s.error();
  } else if (request.flattening != nullptr) {
    applyFlattening(*request.flattening, *vertices);
  }
  if (request.jointMatrices != nullptr || request.flattening != nullptr) {
    result.centerWorld =
        request.centerWorld != nullptr ? *request.centerWorld : middleOf(vertices->positions);
    for (glm::dvec3& position : vertices->positions) position -= result.centerWorld;
  }
  Result<std::vector<std::uint32_t>> corners =
      readCorners(model, primitive, vertices->positions.size(), what);
  if (!corners) return corners.error();
  std::vector<std::uint32_t> indices = trianglesOf(primitive.mode, std::move(corners).value());
  if (indices.empty()) {
    skipped.withoutArea.push_back(what);
    return PrimitiveMesh{};
  }
  if (request.isMirrored) {
    for (glm::dvec3& position : vertices->positions) position.x = -position.x;
    for (glm::dvec3& normal : vertices->normals) normal.x = -normal.x;
  }
  if (request.isMirrored || (request.jointMatrices != nullptr && mostMirror(*request.jointMatrices))) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
  }
  const std::vector<glm::vec3> positions(vertices->positions.begin(), vertices->positions.end());
  const std::vector<glm::vec3> normals = unitNormals(vertices->normals);
  Result<scene::TriangleMesh> mesh = scene::buildMesh({
      .positions = &positions.front().x,
      .vertexCount = static_cast<std::uint32_t>(positions.size()),
      .indices = indices.data(),
      .indexCount = indices.size(),
      .normals = normals.empty() ? nullptr : &normals.front().x,
      .texcoords = vertices->texcoords.empty() ? nullptr : &vertices->texcoords.front().x,
      .colors = vertices->colors.empty() ? nullptr : &vertices->colors.front().x,
  });
  if (!mesh && mesh.error().code == ErrorCode::emptyScene) {
    skipped.withoutArea.push_back(what);
    return PrimitiveMesh{};
  }
  if (!mesh) return malformed(what + ": " + mesh.error().message);
  result.mesh = std::make_shared<const scene::TriangleMesh>(std::move(mesh).value());
  return result;
}

}  // namespace halfshadow::scenes
