// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Meshes apart from the objects that show them: instances share one, on the CPU and on the GPU.
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "api/object_textures.hpp"
#include "base/content_hash.hpp"
#include "halfshadow/types.hpp"
#include "scene/bounds.hpp"
#include "scene/caster_geometry.hpp"
#include "scene/convex_hull.hpp"
#include "scene/supporting_planes.hpp"
#include "techniques/execution/gpu_mesh.hpp"

namespace halfshadow::api {

/// Everything that follows from a mesh alone, wherever it stands.
class ObjectMesh {
 public:
  /// Checks, recentres and uploads. Errors: those of Engine::addObject.
  static Result<std::shared_ptr<ObjectMesh>> create(gl::Context& context, const MeshDesc& desc,
                                                    techniques::MeshExtras extras);
  /// One with other positions (and normals) at the same vertices.
  Result<std::shared_ptr<ObjectMesh>> copy(gl::Context& context) const;
  /// On another context. Errors: outOfMemory, contextLost.
  Status upload(gl::Context& context);
  void forgetUpload() { gpu_ = {}; }
  /// Replaces positions, and normals where both have them: `desc` as in Engine::setVertices, checked. Nothing
  /// changes when it fails.
  Status setVertices(gl::Context& context, std::vector<glm::vec3> positions, const float* normals);

  const scene::TriangleMesh& mesh() const { return mesh_; }  ///< recentred
  const glm::dvec3& recenteredBy() const { return recenteredBy_; }
  /// As outlines take it.
  const scene::CasterGeometry& geometry() const { return geometry_; }
  /// The same without what alpha cuts out; objects with one mask share it.
  const scene::CasterGeometry& geometry(const std::shared_ptr<SurfaceTexture>& mask, float cutoff) const;
  const techniques::GpuMesh& gpu() const { return gpu_; }
  const scene::Bounds& bounds() const { return bounds_; }
  /// Its positions were replaced, and may be again.
  bool animated() const { return animated_; }
  /// Of the positions there are now; found on the first call.
  const scene::SupportingPlanes& support() const;
  /// Hold its mesh; found once for it.
  const scene::EnclosingPoints& enclosing() const;
  /// See scene::solidity(); of the first positions, found on the first call.
  float solidity() const;

 private:
  scene::TriangleMesh mesh_;
  glm::dvec3 recenteredBy_{0.0};  ///< what was taken off the host's positions
  struct CutGeometry {
    std::weak_ptr<SurfaceTexture> mask;
    float cutoff = 0.0f;
    std::unique_ptr<scene::CasterGeometry> geometry;
  };
  scene::CasterGeometry geometry_;
  mutable std::vector<CutGeometry> cutGeometries_;
  techniques::GpuMesh gpu_;
  scene::Bounds bounds_;
  techniques::MeshExtras extras_ = techniques::MeshExtras::none;
  bool animated_ = false;
  mutable std::optional<scene::SupportingPlanes> supportingPlanes_;
  mutable scene::EnclosingPoints enclosing_;
  mutable std::optional<float> solidity_;
};

/// Finds the mesh that an earlier object was added with, by all its values.
class MeshStore {
 public:
  /// Errors: those of ObjectMesh::create.
  Result<std::shared_ptr<ObjectMesh>> find(gl::Context& context, const MeshDesc& desc,
                                           techniques::MeshExtras extras);

 private:
  static ContentKey keyOf(const MeshDesc& desc, techniques::MeshExtras extras);
  std::unordered_map<ContentKey, std::weak_ptr<ObjectMesh>, ContentKey::Hash> meshes_;
  std::size_t sweepAt_ = 64;  ///< so many entries are looked through for those that nobody holds any more
};

}  // namespace halfshadow::api
