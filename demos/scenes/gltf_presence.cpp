// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_presence.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace halfshadow::scenes {
namespace {
scene::AlphaRange alphaOf(const GltfMaterial& material, const scene::TriangleMesh& mesh,
                          std::size_t triangle) {
  const std::uint32_t* const corner = &mesh.indices[3 * triangle];
  scene::AlphaRange range{material.material.baseColor.a, material.material.baseColor.a};
  if (!mesh.colors.empty()) {
    const auto [low, high] =
        std::minmax({mesh.colors[corner[0]].a, mesh.colors[corner[1]].a, mesh.colors[corner[2]].a});
    range.times({low, high});
  }
  if (material.imageAlpha && !mesh.texcoords.empty()) {
    const glm::dvec2 a(mesh.texcoords[corner[0]]), b(mesh.texcoords[corner[1]]), c(mesh.texcoords[corner[2]]);
    range.times(material.imageAlpha->over(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)),
                                          material.material.sampling));
  }
  return range;
}

/// The triangles of `kept`, wound as the file has them, as a mesh of their own.
std::shared_ptr<const scene::TriangleMesh> partOf(const scene::TriangleMesh& mesh,
                                                  const std::vector<std::uint32_t>& kept) {
  scene::TriangleMesh part;
  std::vector<std::uint32_t> numberOf(mesh.positions.size(), ~0u);
  const auto take = [&](std::uint32_t vertex) {
    if (numberOf[vertex] == ~0u) {
      numberOf[vertex] = static_cast<std::uint32_t>(part.positions.size());
      part.positions.push_back(mesh.positions[vertex]);
      if (!mesh.normals.empty()) part.normals.push_back(mesh.normals[vertex]);
      if (!mesh.texcoords.empty()) part.texcoords.push_back(mesh.texcoords[vertex]);
      if (!mesh.colors.empty()) part.colors.push_back(mesh.colors[vertex]);
    }
    part.indices.push_back(numberOf[vertex]);
  };
  for (const std::uint32_t t : kept) {
    const std::uint32_t* const corner = &mesh.indices[std::size_t{3} * t];
    const bool turned = !mesh.turned.empty() && mesh.turned[t] != 0;
    take(corner[0]);
    take(corner[turned ? 2 : 1]);
    take(corner[turned ? 1 : 2]);
  }
  auto built = scene::buildMesh({.positions = &part.positions.front().x,
                                 .vertexCount = static_cast<std::uint32_t>(part.positions.size()),
                                 .indices = part.indices.data(),
                                 .indexCount = part.indices.size(),
                                 .normals = part.normals.empty() ? nullptr : &part.normals.front().x,
                                 .texcoords = part.texcoords.empty() ? nullptr : &part.texcoords.front().x,
                                 .colors = part.colors.empty() ? nullptr : &part.colors.front().x});
  return built ? std::make_shared<const scene::TriangleMesh>(std::move(built).value()) : nullptr;
}
}  // namespace

PresentMesh presentMesh(const GltfMaterial& material, std::shared_ptr<const scene::TriangleMesh> mesh) {
  const float cutoff = material.material.alphaCutoff;
  if (cutoff <= 0.0f) return {std::move(mesh)};
  std::vector<std::uint32_t> kept;
  bool hasHoles = false;
  for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
    const scene::AlphaRange alpha = alphaOf(material, *mesh, t);
    if (alpha.high < cutoff) continue;
    kept.push_back(t);
    hasHoles = hasHoles || alpha.low < cutoff;
  }
  if (kept.empty()) return {};
  if (kept.size() == mesh->triangleCount()) return {std::move(mesh), hasHoles};
  return {partOf(*mesh, kept), hasHoles};
}

}  // namespace halfshadow::scenes
