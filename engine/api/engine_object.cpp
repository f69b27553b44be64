// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/engine_object.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace halfshadow {

Status EngineObject::uploadBaseColor(gl::Context& context) {
  const BaseColorImage& image = baseColorImage;
  if (image.rgba.empty()) return {};
  const auto powerOfTwo = [](int n) { return (n & (n - 1)) == 0; };
  // ES 2.0: others have no mips and no repeat.
  const bool mips = powerOfTwo(image.width) && powerOfTwo(image.height);
  auto texture =
      gl::Texture::create(context,
                          {.width = image.width,
                           .height = image.height,
                           .filter = mips ? gl::TextureFilter::linearMipLinear : gl::TextureFilter::linear,
                           .wrap = mips ? gl::TextureWrap::repeat : gl::TextureWrap::clampToEdge,
                           .mipmapped = mips},
                          image.rgba.data());
  if (!texture) return texture.error();
  if (mips) texture->generateMipmaps(context);
  baseColorTexture = std::move(texture).value();
  return {};
}

void EngineObject::forgetUploads() {
  mesh->forgetUpload();
  baseColorTexture = {};
  cutReceiver = {};
}

void EngineObject::place(const glm::dmat4& worldFromHostNow) {
  worldFromHost = worldFromHostNow;
  worldFromObject = glm::translate(worldFromHost, mesh->recenteredBy());
  boundsWorld = scene::transformed(worldFromObject, mesh->bounds());
  mirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0;
  pointsPlaced_ = false;
}

void EngineObject::placePoints() const {
  if (pointsPlaced_) return;
  pointsWorld_.clear();
  pointBoundsWorld_ = {};
  for (const glm::dvec3& point : mesh->enclosing().points) {
    pointsWorld_.push_back(glm::dvec3(worldFromObject * glm::dvec4(point, 1.0)));
    pointBoundsWorld_.include(pointsWorld_.back());
  }
  pointsPlaced_ = true;
}

planner::CasterShape EngineObject::shape() const {
  placePoints();
  return {.id = id,
          .revision = revision,
          .pointsWorld = pointsWorld_,
          .boundsWorld = pointBoundsWorld_,
          .mesh = &mesh->mesh(),
          .worldFromObject = &worldFromObject};
}

}  // namespace halfshadow
