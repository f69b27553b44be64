// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/cutout.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::scene {
namespace {
/// Texel of a row or column that stands at a place which may lie beyond the border.
int wrapped(long long texel, int size, ImageWrap wrap) {
  if (texel >= 0 && texel < size) return static_cast<int>(texel);
  if (wrap == ImageWrap::clampToEdge) return static_cast<int>(std::clamp<long long>(texel, 0, size - 1));
  const long long period = wrap == ImageWrap::repeat ? size : 2LL * size;
  const long long inside = (texel % period + period) % period;
  return static_cast<int>(inside < size ? inside : period - 1 - inside);
}

/// Far outside every image a place has no texel of its own any more.
double tamed(double coordinate) {
  return std::isfinite(coordinate) ? std::clamp(coordinate, -1e9, 1e9) : 0.0;
}
}  // namespace

double alphaAt(const Image& image, const ImageSampling& sampling, const glm::dvec2& texcoord) {
  if (image.channels == 3) return 1.0;
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto texel = [&](long long x, long long y) {
    const auto at = static_cast<std::size_t>(wrapped(y, image.height, sampling.wrapV)) * image.width +
                    static_cast<std::size_t>(wrapped(x, image.width, sampling.wrapU));
    return image.pixels[channels * at + channels - 1] / 255.0;
  };
  const double x = tamed(texcoord.x) * image.width, y = tamed(texcoord.y) * image.height;
  if (sampling.filter == ImageFilter::nearest) {
    return texel(static_cast<long long>(std::floor(x)), static_cast<long long>(std::floor(y)));
  }
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const double alongX = x - 0.5 - left, alongY = y - 0.5 - top;
  const auto column = static_cast<long long>(left), row = static_cast<long long>(top);
  return (texel(column, row) * (1 - alongX) + texel(column + 1, row) * alongX) * (1 - alongY) +
         (texel(column, row + 1) * (1 - alongX) + texel(column + 1, row + 1) * alongX) * alongY;
}

double alphaAt(const SceneObject& object, std::uint32_t triangle, const glm::dvec3& weights) {
  const TriangleMesh& mesh = *object.mesh;
  const std::uint32_t* corner = &mesh.indices[std::size_t{3} * triangle];
  const auto mean = [&](const auto& values) {
    return weights.x * glm::dvec4(values[corner[0]]) + weights.y * glm::dvec4(values[corner[1]]) +
           weights.z * glm::dvec4(values[corner[2]]);
  };
  double alpha = object.material.baseColor.a;
  if (!mesh.colors.empty()) alpha *= mean(mesh.colors).a;
  if (object.material.baseColorImage && !mesh.texcoords.empty()) {
    const glm::dvec2 place = weights.x * glm::dvec2(mesh.texcoords[corner[0]]) +
                             weights.y * glm::dvec2(mesh.texcoords[corner[1]]) +
                             weights.z * glm::dvec2(mesh.texcoords[corner[2]]);
    alpha *= alphaAt(*object.material.baseColorImage, object.material.sampling, place);
  }
  return alpha;
}

}  // namespace halfshadow::scene
