// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/gpu_mesh.hpp"

#include <algorithm>
#include <unordered_map>

namespace halfshadow::techniques {
namespace {
constexpr std::size_t kShortIndexVertices = 65536;
/// Up to here three vertices a triangle cost less than derivatives in every fragment: 288 KiB, a few percent
/// of one 1024 x 1024 depth map.
constexpr std::uint32_t kFewTriangles = 4096;

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span<const T>(values));
}

template <typename T>
std::vector<T> gathered(const std::vector<T>& source, const std::vector<std::uint32_t>& order) {
  std::vector<T> result;
  result.reserve(order.size());
  for (const std::uint32_t vertex : order) result.push_back(source[vertex]);
  return result;
}

std::vector<glm::vec3> facetStream(const scene::TriangleMesh& mesh) {
  std::vector<glm::vec3> stream;
  stream.reserve(mesh.indices.size() * 2);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                    c = mesh.positions[mesh.indices[i + 2]];
    // In double: the cross product of a sliver's edges cancels in float.
    const glm::dvec3 normal = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const double length = glm::length(normal);
    const glm::vec3 unit = length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
    for (const glm::vec3& corner : {a, b, c}) stream.insert(stream.end(), {corner, unit});
  }
  return stream;
}

Status refresh(gl::Context& context, gl::Buffer& buffer, gl::BufferTarget target,
               std::span<const std::byte> bytes) {
  if (buffer) return buffer.update(context, bytes);
  auto made = gl::Buffer::create(context, target, bytes, gl::BufferUsage::staticDraw);
  if (!made) return made.error();
  buffer = std::move(made).value();
  return {};
}
}  // namespace

void GpuMesh::split(const scene::TriangleMesh& mesh, bool wideIndices) {
  if (wideIndices || mesh.positions.size() <= kShortIndexVertices) {
    sourceVertex_.resize(mesh.positions.size());
    for (std::size_t i = 0; i < sourceVertex_.size(); ++i) sourceVertex_[i] = static_cast<std::uint32_t>(i);
    gpuIndices_ = mesh.indices;
    ranges_ = {{0, 0, mesh.indices.size()}};
    return;
  }
  std::unordered_map<std::uint32_t, std::uint32_t> local;
  ranges_ = {{0, 0, 0}};
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    if (local.size() + 3 > kShortIndexVertices) {
      ranges_.push_back({sourceVertex_.size(), gpuIndices_.size(), 0});
      local.clear();
    }
    for (std::size_t corner = i; corner < i + 3; ++corner) {
      const auto [found, added] =
          local.try_emplace(mesh.indices[corner], static_cast<std::uint32_t>(local.size()));
      if (added) sourceVertex_.push_back(mesh.indices[corner]);
      gpuIndices_.push_back(found->second);
    }
    ranges_.back().indexCount += 3;
  }
}

Status GpuMesh::upload(gl::Context& context, const scene::TriangleMesh& mesh) {
  const auto positions = gathered(mesh.positions, sourceVertex_);
  if (Status s = refresh(context, positions_, gl::BufferTarget::vertex, bytesOf(positions)); !s) return s;
  if (!mesh.normals.empty()) {
    const auto normals = gathered(mesh.normals, sourceVertex_);
    if (Status s = refresh(context, normals_, gl::BufferTarget::vertex, bytesOf(normals)); !s) return s;
  }
  if (needsFacetStream(context.capabilities()) || mesh.triangleCount() <= kFewTriangles) {
    const auto facets = facetStream(mesh);
    facetVertexCount_ = facets.size() / 2;
    if (Status s = refresh(context, facet_, gl::BufferTarget::vertex, bytesOf(facets)); !s) return s;
  }
  return {};
}

Status GpuMesh::uploadSurface(gl::Context& context, const scene::TriangleMesh& mesh, MeshExtras extras) {
  const auto add = [&](gl::Buffer& buffer, const auto& values, const std::vector<std::uint32_t>& order) {
    if (values.empty()) return Status();
    return refresh(context, buffer, gl::BufferTarget::vertex, bytesOf(gathered(values, order)));
  };
  if (Status s = add(texcoords_, mesh.texcoords, sourceVertex_); !s) return s;
  if (Status s = add(colors_, mesh.colors, sourceVertex_); !s) return s;
  if (!shadedByFacets_ && !(extras == MeshExtras::alpha && facet_)) return {};
  if (Status s = add(facetTexcoords_, mesh.texcoords, mesh.indices); !s) return s;
  return add(facetColors_, mesh.colors, mesh.indices);
}

Result<GpuMesh> GpuMesh::create(gl::Context& context, const scene::TriangleMesh& mesh, MeshExtras extras) {
  GpuMesh gpu;
  gpu.split(mesh, context.capabilities().has(device::Capability::uintIndex));
  if (Status s = gpu.upload(context, mesh); !s) return s.error();
  gpu.shadedByFacets_ = mesh.normals.empty() && needsFacetStream(context.capabilities());
  if (Status s = gpu.uploadSurface(context, mesh, extras); !s) return s.error();
  const bool shortIndices =
      std::ranges::all_of(gpu.gpuIndices_, [](std::uint32_t i) { return i < kShortIndexVertices; });
  Status indices;
  if (shortIndices) {
    const std::vector<std::uint16_t> narrow(gpu.gpuIndices_.begin(), gpu.gpuIndices_.end());
    indices = refresh(context, gpu.indices_, gl::BufferTarget::index, bytesOf(narrow));
  } else {
    gpu.indexType_ = gl::IndexType::uint32;
    indices = refresh(context, gpu.indices_, gl::BufferTarget::index, bytesOf(gpu.gpuIndices_));
  }
  if (!indices) return indices.error();
  gpu.gpuIndices_ = {};
  return gpu;
}

Status GpuMesh::update(gl::Context& context, const scene::TriangleMesh& mesh) {
  const auto largest = std::ranges::max_element(sourceVertex_);
  if (largest != sourceVertex_.end() && *largest >= mesh.positions.size()) {
    return Error{ErrorCode::invalidArgument,
                 "an updated mesh has fewer vertices than it was made with; add it anew"};
  }
  return upload(context, mesh);
}

void GpuMesh::drawFacets(gl::Encoder& encoder, const gl::DrawState& state, bool withSurface) const {
  using gl::AttributeType;
  using gl::VertexAttribute;
  gl::AttributeBinding bindings[4] = {{VertexAttribute::position, &facet_, 3, AttributeType::float32, 24, 0},
                                      {VertexAttribute::normal, &facet_, 3, AttributeType::float32, 24, 12}};
  std::size_t count = 2;
  if (withSurface && facetTexcoords_)
    bindings[count++] = {VertexAttribute::texcoord, &facetTexcoords_, 2, AttributeType::float32, 8, 0};
  if (withSurface && facetColors_)
    bindings[count++] = {VertexAttribute::extra0, &facetColors_, 4, AttributeType::float32, 16, 0};
  encoder.draw(state, {.attributes = std::span(bindings, count), .count = facetVertexCount_});
}

void GpuMesh::draw(gl::Encoder& encoder, const gl::DrawState& state, Streams streams,
                   MeshExtras extras) const {
  using gl::AttributeType;
  using gl::VertexAttribute;
  const bool withSurface = streams == Streams::shading || extras == MeshExtras::alpha;
  if ((streams == Streams::facet && facet_) || (streams == Streams::shading && shadedByFacets_)) {
    drawFacets(encoder, state, withSurface);
    return;
  }
  for (const Range& range : ranges_) {
    const std::size_t first = range.firstVertex;
    gl::AttributeBinding bindings[4] = {
        {VertexAttribute::position, &positions_, 3, AttributeType::float32, 12, first * 12}};
    std::size_t count = 1;
    if (streams == Streams::shading && normals_)
      bindings[count++] = {VertexAttribute::normal, &normals_, 3, AttributeType::float32, 12, first * 12};
    if (withSurface && texcoords_)
      bindings[count++] = {VertexAttribute::texcoord, &texcoords_, 2, AttributeType::float32, 8, first * 8};
    if (withSurface && colors_)
      bindings[count++] = {VertexAttribute::extra0, &colors_, 4, AttributeType::float32, 16, first * 16};
    encoder.draw(state, {.attributes = std::span(bindings, count),
                         .indices = &indices_,
                         .indexType = indexType_,
                         .first = range.firstIndex,
                         .count = range.indexCount});
  }
}

std::uint64_t GpuMesh::memoryBytes() const {
  return positions_.byteCount() + indices_.byteCount() + normals_.byteCount() + texcoords_.byteCount() +
         colors_.byteCount() + facet_.byteCount() + facetTexcoords_.byteCount() + facetColors_.byteCount();
}

}  // namespace halfshadow::techniques
