// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "api/engine_state.hpp"

namespace halfshadow {
namespace {
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

Result<gl::Texture> baseColorTexture(gl::Context& context, const ObjectDesc& desc) {
  const int channels = desc.baseColorChannels;
  if (desc.baseColorWidth <= 0 || desc.baseColorHeight <= 0 || (channels != 3 && channels != 4)) {
    return Error{ErrorCode::invalidArgument, "a base colour image needs a positive size and 3 or 4 channels"};
  }
  const auto width = static_cast<std::size_t>(desc.baseColorWidth),
             height = static_cast<std::size_t>(desc.baseColorHeight);
  // Rows stay as they are, since texture coordinates count from the top left; alpha is dropped: shadows of
  // cut-out materials are not supported.
  std::vector<std::uint8_t> rgba(width * height * 4);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* source =
          desc.baseColorPixels + (y * width + x) * static_cast<std::size_t>(channels);
      std::uint8_t* target = rgba.data() + (y * width + x) * 4;
      target[0] = source[0], target[1] = source[1], target[2] = source[2], target[3] = 255;
    }
  }
  const auto powerOfTwo = [](std::size_t n) { return (n & (n - 1)) == 0; };
  const bool mips = powerOfTwo(width) && powerOfTwo(height);  // ES 2.0: others have no mips and no repeat
  auto texture =
      gl::Texture::create(context,
                          {.width = desc.baseColorWidth,
                           .height = desc.baseColorHeight,
                           .filter = mips ? gl::TextureFilter::linearMipLinear : gl::TextureFilter::linear,
                           .wrap = mips ? gl::TextureWrap::repeat : gl::TextureWrap::clampToEdge,
                           .mipmapped = mips},
                          rgba.data());
  if (texture && mips) texture->generateMipmaps(context);
  return texture;
}
}  // namespace

Outcome Engine::addObject(const ObjectDesc& desc, ObjectId& id) {
  State& state = *state_;
  id = 0;
  if (state.context->lost())
    return state.fail({ErrorCode::contextLost, "the context was lost; make a new engine"});
  auto transform = checkedTransform(desc.worldFromObject);
  if (!transform) return state.fail(transform.error());
  gl::HostStateGuard guard(*state.context, state.policy());
  EngineObject object;
  auto mesh = state.meshes.find(*state.context, desc.mesh);
  if (!mesh) return state.fail(mesh.error());
  object.mesh = std::move(mesh).value();
  if (desc.baseColorPixels) {
    auto texture = baseColorTexture(*state.context, desc);
    if (!texture) return state.fail(texture.error());
    object.baseColorTexture = std::move(texture).value();
  }
  object.place(*transform);
  object.casts = desc.casts;
  object.receives = desc.receives;
  object.baseColor = glm::make_vec4(desc.baseColor);
  object.revision = state.nextRevision++;
  id = state.nextId++;
  object.id = id;
  state.objects.emplace(id, std::move(object));
  state.lists.listChanged();
  ++state.changes;
  return {};
}

Outcome Engine::setTransform(ObjectId id, const double worldFromObject[16]) {
  State& state = *state_;
  const auto found = state.objects.find(id);
  if (found == state.objects.end()) return state.fail({ErrorCode::invalidArgument, "no object has this id"});
  auto transform = checkedTransform(worldFromObject);
  if (!transform) return state.fail(transform.error());
  if (found->second.worldFromHost == *transform) return {};
  found->second.place(*transform);
  state.changed(found->second);
  return {};
}

Outcome Engine::setVertices(ObjectId id, const MeshDesc& desc) {
  State& state = *state_;
  const auto found = state.objects.find(id);
  if (found == state.objects.end()) return state.fail({ErrorCode::invalidArgument, "no object has this id"});
  if (state.context->lost())
    return state.fail({ErrorCode::contextLost, "the context was lost; make a new engine"});
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
  const auto* bytes = reinterpret_cast<const std::byte*>(desc.positions);
  for (std::uint32_t i = 0; i < desc.vertexCount; ++i) {
    std::memcpy(&positions[i], bytes + i * desc.positionStrideBytes, 12);
    if (!std::isfinite(positions[i].x) || !std::isfinite(positions[i].y) || !std::isfinite(positions[i].z)) {
      return state.fail({ErrorCode::invalidMesh, "vertex " + std::to_string(i) + " is NaN or infinite"});
    }
  }
  gl::HostStateGuard guard(*state.context, state.policy());
  if (object.mesh.use_count() > 1) {
    auto own = object.mesh->copy(*state.context);
    if (!own) return state.fail(own.error());
    object.mesh = std::move(own).value();
  }
  if (Status s = object.mesh->setVertices(*state.context, std::move(positions), desc.normals); !s)
    return state.fail(s.error());
  object.place(object.worldFromHost);
  state.changed(object);
  return {};
}

Outcome Engine::removeObject(ObjectId id) {
  State& state = *state_;
  const auto found = state.objects.find(id);
  if (found == state.objects.end()) return state.fail({ErrorCode::invalidArgument, "no object has this id"});
  gl::HostStateGuard guard(*state.context,
                           state.context->lost() ? gl::HostStatePolicy::leaveDirty : state.policy());
  state.objects.erase(found);
  state.lists.listChanged();
  ++state.changes;
  return {};
}

}  // namespace halfshadow
