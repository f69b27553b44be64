// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/object_mesh.hpp"

#include <algorithm>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>

#include "scene/solidity.hpp"

namespace halfshadow::api {

Result<std::shared_ptr<ObjectMesh>> ObjectMesh::create(gl::Context& context, const MeshDesc& desc,
                                                       techniques::MeshExtras extras) {
  auto checked = scene::buildMesh({.positions = desc.positions,
                                   .positionStrideBytes = desc.positionStrideBytes,
                                   .vertexCount = desc.vertexCount,
                                   .indices = desc.indices,
                                   .indexCount = desc.indexCount,
                                   .normals = desc.normals,
                                   .texcoords = desc.texcoords,
                                   .colors = desc.colors});
  if (!checked) return checked.error();
  auto made = std::make_shared<ObjectMesh>();
  made->mesh_ = std::move(*checked);
  made->recenteredBy_ = scene::recenter(made->mesh_);
  made->bounds_ = scene::boundsOf(made->mesh_);
  made->extras_ = extras;
  auto gpu = techniques::GpuMesh::create(context, made->mesh_, extras);
  if (!gpu) return gpu.error();
  made->gpu_ = std::move(gpu).value();
  return made;
}

Result<std::shared_ptr<ObjectMesh>> ObjectMesh::copy(gl::Context& context) const {
  auto made = std::make_shared<ObjectMesh>();
  made->mesh_ = mesh_;
  made->recenteredBy_ = recenteredBy_;
  made->bounds_ = bounds_;
  made->solidity_ = solidity();
  made->extras_ = extras_;
  auto gpu = techniques::GpuMesh::create(context, mesh_, extras_);
  if (!gpu) return gpu.error();
  made->gpu_ = std::move(gpu).value();
  return made;
}

Status ObjectMesh::upload(gl::Context& context) {
  auto gpu = techniques::GpuMesh::create(context, mesh_, extras_);
  if (!gpu) return gpu.error();
  gpu_ = std::move(gpu).value();
  return {};
}

Status ObjectMesh::setVertices(gl::Context& context, std::vector<glm::vec3> positions, const float* normals) {
  (void)solidity();  // of the first positions
  scene::TriangleMesh changed = mesh_;
  changed.positions = std::move(positions);
  const glm::dvec3 recenteredBy = scene::recenter(changed);
  if (normals != nullptr) {
    for (std::size_t i = 0; i < changed.normals.size(); ++i)
      changed.normals[i] = glm::make_vec3(normals + 3 * i);
  }
  // A pose that mirrors the mesh, or the way back: other windings, so other indices and half-edges.
  const bool turned = scene::turnShellsOutward(changed);
  if (turned) {
    auto gpu = techniques::GpuMesh::create(context, changed, extras_);
    if (!gpu) return gpu.error();
    if (context.lost()) return context.checkErrors("replacing vertices");
    gpu_ = std::move(gpu).value();
    geometry_ = {};
    cutGeometries_.clear();
  } else {
    Status updated = gpu_.update(context, changed);
    if (updated && context.lost()) updated = context.checkErrors("replacing vertices");
    if (!updated) {
      // What was sent already is sent again as it was; where that fails too, the picture tells of both.
      (void)gpu_.update(context, mesh_).ok();
      return updated;
    }
    geometry_.positionsChanged();
    for (CutGeometry& cut : cutGeometries_) cut.geometry->positionsChanged();
  }
  animated_ = true;
  mesh_ = std::move(changed);
  recenteredBy_ = recenteredBy;
  bounds_ = scene::boundsOf(mesh_);
  supportingPlanes_.reset();
  enclosing_ = {};
  return {};
}

const scene::CasterGeometry& ObjectMesh::geometry(const std::shared_ptr<SurfaceTexture>& mask,
                                                  float cutoff) const {
  const auto known = std::ranges::find_if(cutGeometries_, [&](const CutGeometry& cut) {
    return cut.cutoff == cutoff && !cut.mask.owner_before(mask) && !mask.owner_before(cut.mask);
  });
  if (known != cutGeometries_.end()) return *known->geometry;
  std::erase_if(cutGeometries_, [](const CutGeometry& cut) { return cut.mask.expired(); });
  cutGeometries_.push_back({mask, cutoff, std::make_unique<scene::CasterGeometry>(mask->cut(cutoff))});
  return *cutGeometries_.back().geometry;
}

const scene::SupportingPlanes& ObjectMesh::support() const {
  if (!supportingPlanes_) supportingPlanes_ = scene::supportingPlanesOf(mesh_, recenteredBy_);
  return *supportingPlanes_;
}

const scene::EnclosingPoints& ObjectMesh::enclosing() const {
  // A hull costs more than it saves where the next frame has other positions.
  if (enclosing_.points.empty())
    enclosing_ =
        animated_ ? scene::EnclosingPoints{scene::usedVertices(mesh_), true} : scene::enclosingPoints(mesh_);
  return enclosing_;
}

float ObjectMesh::solidity() const {
  if (!solidity_) solidity_ = static_cast<float>(scene::solidity(mesh_));
  return *solidity_;
}

ContentKey MeshStore::keyOf(const MeshDesc& desc, techniques::MeshExtras extras) {
  ContentHasher hasher;
  hasher.add(desc.vertexCount);
  hasher.add(static_cast<std::uint64_t>(extras));
  const auto* positions = reinterpret_cast<const std::byte*>(desc.positions);
  for (std::size_t i = 0; i < desc.vertexCount; ++i) hasher.add(positions + i * desc.positionStrideBytes, 12);
  hasher.add(desc.indexCount);
  if (desc.indices != nullptr) hasher.add(desc.indices, desc.indexCount * sizeof *desc.indices);
  // Which of the streams there are is told apart by a word before each.
  hasher.add(desc.indices != nullptr ? 1u : 2u);
  for (const auto& [values, width] :
       {std::pair(desc.normals, 12u), std::pair(desc.texcoords, 8u), std::pair(desc.colors, 16u)}) {
    hasher.add(values != nullptr ? 1u : 2u);
    if (values != nullptr) hasher.add(values, std::size_t{desc.vertexCount} * width);
  }
  return hasher.key();
}

Result<std::shared_ptr<ObjectMesh>> MeshStore::find(gl::Context& context, const MeshDesc& desc,
                                                    techniques::MeshExtras extras) {
  // What has no positions is refused there.
  if (desc.positions == nullptr || desc.positionStrideBytes < 12)
    return ObjectMesh::create(context, desc, extras);
  if (meshes_.size() >= sweepAt_) {
    std::erase_if(meshes_, [](const auto& entry) { return entry.second.expired(); });
    sweepAt_ = std::max<std::size_t>(64, 2 * meshes_.size());
  }
  std::weak_ptr<ObjectMesh>& known = meshes_[keyOf(desc, extras)];
  if (auto mesh = known.lock(); mesh && !mesh->animated()) return mesh;
  auto made = ObjectMesh::create(context, desc, extras);
  if (made) known = *made;
  return made;
}

}  // namespace halfshadow::api
