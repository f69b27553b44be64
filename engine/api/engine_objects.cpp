// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "api/engine_state.hpp"
#include "api/object_textures.hpp"
#include "scene/place.hpp"

namespace halfshadow {
namespace {
constexpr Outcome kNoObject{ErrorCode::invalidArgument, "no object has this id"};

Result<glm::dmat4> checkedTransform(const double matrix[16]) {
  const glm::dmat4 transform = glm::make_mat4(matrix);
  double sum = 0.0;
  for (int i = 0; i < 16; ++i) sum += std::abs(matrix[i]);
  if (!std::isfinite(sum)) {
    return Error{ErrorCode::invalidArgument, "the object's transform has a NaN or infinite element"};
  }
  if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1) {
    return Error{ErrorCode::invalidArgument,
                 "the object's transform is not affine: its last row must be 0 0 0 1"};
  }
  if (glm::determinant(glm::dmat3(transform)) == 0.0) {
    return Error{ErrorCode::invalidArgument, "the object's transform is singular (a scale of zero?)"};
  }
  return transform;
}

/// `bounds`: of a mesh before the transform.
Status checkPlace(const glm::dmat4& worldFromMesh, const scene::Bounds& bounds) {
  const scene::Bounds world = scene::transformed(worldFromMesh, bounds);
  if (scene::isPlace(world.low) && scene::isPlace(world.high)) return {};
  return Error{ErrorCode::invalidArgument,
               "the object reaches beyond 1e30 along an axis; give smaller positions or a smaller transform"};
}

Status addImages(gl::Context& context, api::SurfaceStore& store, const ObjectDesc& desc,
                 EngineObject& object) {
  auto colors = store.find(context, desc, api::SurfaceImageKind::baseColor);
  if (!colors) return colors.error();
  auto mask = store.find(context, desc, api::SurfaceImageKind::alphaMask);
  if (!mask) return mask.error();
  object.baseColorImage = std::move(colors).value();
  object.alphaMask = std::move(mask).value();
  // The mask's texels stand for image alone: what else multiplies alpha divides the cutoff.
  object.alphaCutoff = desc.alphaCutoff / std::max(desc.baseColor[3], 1e-6f);
  return {};
}
}  // namespace

Outcome Engine::addObject(const ObjectDesc& desc, ObjectId& id) {
  id = 0;
  return state_->guarded([&] { return state_->addObject(desc, id); });
}

Outcome Engine::State::addObject(const ObjectDesc& desc, ObjectId& id) {
  State& state = *this;
  if (state.context->lost())
    return state.fail({ErrorCode::contextLost, "the context was lost; call contextRestored on a new one"});
  auto transform = checkedTransform(desc.worldFromObject);
  if (!transform) return state.fail(transform.error());
  if (Status status = api::checkSurface(desc); !status) return state.fail(status.error());
  gl::HostStateGuard guard(*state.context, state.policy());
  EngineObject object;
  if (Status status = addImages(*state.context, state.surfaces, desc, object); !status)
    return state.fail(status.error());
  auto mesh = state.meshes.find(*state.context, desc.mesh, object.meshExtras());
  if (!mesh) return state.fail(mesh.error());
  object.mesh = std::move(mesh).value();
  if (Status s = state.context->checkErrors("adding an object"); !s) return state.fail(s.error());
  object.place(*transform);
  if (Status status = checkPlace(object.worldFromObject, object.mesh->bounds()); !status)
    return state.fail(status.error());
  object.casts = desc.casts;
  object.receives = desc.receives;
  object.singleSided = desc.singleSided;
  object.baseColor = glm::make_vec4(desc.baseColor);
  object.revision = state.nextRevision++;
  object.id = state.nextId;
  state.objects.emplace(state.nextId, std::move(object));
  id = state.nextId++;
  state.lists.listChanged();
  ++state.changes;
  return {};
}

Outcome Engine::setTransform(ObjectId id, const double worldFromObject[16]) {
  State& state = *state_;
  return state.guarded([&]() -> Outcome {
    const auto found = state.objects.find(id);
    if (found == state.objects.end()) return kNoObject;
    if (worldFromObject == nullptr)
      return {ErrorCode::invalidArgument, "setTransform needs a matrix of 16 numbers"};
    auto transform = checkedTransform(worldFromObject);
    if (!transform) return state.fail(transform.error());
    if (found->second.worldFromHost == *transform) return {};
    const api::ObjectMesh& mesh = *found->second.mesh;
    if (Status status = checkPlace(glm::translate(*transform, mesh.recenteredBy()), mesh.bounds()); !status)
      return state.fail(status.error());
    state.changed(found->second);
    found->second.place(*transform);
    return {};
  });
}

Outcome Engine::setVertices(ObjectId id, const MeshDesc& desc) {
  return state_->guarded([&] { return state_->setVertices(id, desc); });
}

Outcome Engine::State::setVertices(ObjectId id, const MeshDesc& desc) {
  State& state = *this;
  const auto found = state.objects.find(id);
  if (found == state.objects.end()) return kNoObject;
  if (state.context->lost())
    return state.fail({ErrorCode::contextLost, "the context was lost; call contextRestored on a new one"});
  EngineObject& object = found->second;
  if (desc.vertexCount != object.mesh->mesh().positions.size()) {
    return state.fail(
        {ErrorCode::invalidArgument, "setVertices needs as many vertices as the object was added with"});
  }
  if (desc.positions == nullptr || desc.positionStrideBytes < 12) {
    return state.fail({ErrorCode::invalidMesh, "setVertices needs positions, at least 12 bytes apart"});
  }
  // Checked before anything is replaced: a refused call leaves the object as it was.
  std::vector<glm::vec3> positions(desc.vertexCount);
  scene::Bounds bounds;
  const auto* bytes = reinterpret_cast<const std::byte*>(desc.positions);
  for (std::uint32_t i = 0; i < desc.vertexCount; ++i) {
    std::memcpy(&positions[i], bytes + i * desc.positionStrideBytes, 12);
    if (!std::isfinite(positions[i].x) || !std::isfinite(positions[i].y) || !std::isfinite(positions[i].z)) {
      return state.fail({ErrorCode::invalidMesh, "vertex " + std::to_string(i) + " is NaN or infinite"});
    }
    bounds.include(glm::dvec3(positions[i]));
  }
  if (Status status = checkPlace(object.worldFromHost, bounds); !status) return state.fail(status.error());
  gl::HostStateGuard guard(*state.context, state.policy());
  std::shared_ptr<api::ObjectMesh> mesh = object.mesh;
  if (mesh.use_count() > 2) {
    auto own = mesh->copy(*state.context);
    if (!own) return state.fail(own.error());
    mesh = std::move(own).value();
  }
  if (Status s = mesh->setVertices(*state.context, std::move(positions), desc.normals); !s)
    return state.fail(s.error());
  state.changed(object);
  object.mesh = std::move(mesh);
  object.place(object.worldFromHost);
  return {};
}

Outcome Engine::removeObject(ObjectId id) {
  State& state = *state_;
  return state.guarded([&]() -> Outcome {
    const auto found = state.objects.find(id);
    if (found == state.objects.end()) return kNoObject;
    gl::HostStateGuard guard(*state.context, state.policy());
    state.objects.erase(found);
    state.lists.listChanged();
    ++state.changes;
    return {};
  });
}

}  // namespace halfshadow
