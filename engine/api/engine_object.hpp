// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// An object of the host's: its mesh, where it is, and what follows from both.
#pragma once

#include <memory>
#include <vector>

#include "api/object_mesh.hpp"
#include "api/object_textures.hpp"
#include "gl/objects.hpp"
#include "planner/light_fit.hpp"

namespace halfshadow {

/// A receiver of which a camera sees so little that only that is drawn (see scene::cutToView).
struct CutReceiver {
  std::uint64_t key = 0;  ///< of the object and the view; 0 = not asked for yet
  bool needed = false;
  scene::TriangleMesh mesh;
  techniques::GpuMesh gpu;
};

struct EngineObject {
  ObjectId id = 0;
  std::shared_ptr<api::ObjectMesh> mesh;  ///< shared with objects that were added with the same
  glm::dmat4 worldFromHost{1.0};          ///< as the host placed the positions that it gave
  glm::dmat4 worldFromObject{1.0};        ///< of the recentred positions
  scene::Bounds boundsWorld;
  bool mirrored = false;
  bool casts = true, receives = true, singleSided = false;
  glm::vec4 baseColor{1.0f};
  std::shared_ptr<api::SurfaceTexture> baseColorImage;  ///< null: none
  std::shared_ptr<api::SurfaceTexture>
      alphaMask;             ///< of what alpha cuts holes into; see techniques::DrawItem
  float alphaCutoff = 0.0f;  ///< of mask times vertex colour
  std::uint64_t revision = 0;
  mutable CutReceiver cutReceiver;  ///< of the last frame

  /// Of what is not there yet. Errors: outOfMemory, contextLost.
  Status uploadTextures(gl::Context& context);
  void forgetUploads();  ///< the context is gone
  bool isCutOut() const { return alphaMask != nullptr; }
  techniques::MeshExtras meshExtras() const {
    return isCutOut() ? techniques::MeshExtras::alpha : techniques::MeshExtras::none;
  }
  /// As outlines take it.
  const scene::CasterGeometry& geometry() const {
    return isCutOut() ? mesh->geometry(alphaMask, alphaCutoff) : mesh->geometry();
  }
  /// Sets worldFromObject and what follows from it and from the mesh.
  void place(const glm::dmat4& worldFromHostNow);
  /// For fits; its points are found once for a mesh, and placed when it has moved.
  planner::CasterShape shape() const;

 private:
  void placePoints() const;
  mutable std::vector<glm::dvec3> pointsWorld_;  ///< see shape()
  mutable scene::Bounds pointBoundsWorld_;
  mutable bool pointsPlaced_ = false;
};

}  // namespace halfshadow
