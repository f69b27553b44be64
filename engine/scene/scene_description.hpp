// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A scene as loaders and generators deliver it: plain CPU data shared by the engine's demos, the reference
/// ray tracer and the measurements.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfshadow/types.hpp"
#include "scene/bounds.hpp"
#include "scene/camera.hpp"
#include "scene/light.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::scene {

/// 8-bit sRGB image, rows from top to bottom, `channels` (3 or 4) interleaved.
struct Image {
  int width = 0, height = 0, channels = 4;
  std::vector<std::uint8_t> pixels;
};

/// How an image is read between its texels and beyond its borders.
struct ImageSampling {
  ImageWrap wrapU = ImageWrap::repeat, wrapV = ImageWrap::repeat;
  ImageFilter filter = ImageFilter::linear;
  bool operator==(const ImageSampling&) const = default;
};

struct Material {
  glm::vec4 baseColor{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear
  std::shared_ptr<const Image> baseColorImage;  ///< null = plain colour
  ImageSampling sampling;
  /// Above 0: where the alpha of base colour, image and vertex colour together is less, there is nothing:
  /// nothing is seen there, and no shadow falls from there. 0: all of it is there.
  float alphaCutoff = 0.0f;
  /// The camera sees its back faces too (see showsBackFaces). Shadows fall from both sides either way.
  bool doubleSided = true;
};

/// One mesh placed in the world. `casts`: it may shadow others; `receives`: visibility is asked on it.
struct SceneObject {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;
  glm::dmat4 worldFromObject{1.0};
  Material material;
  bool casts = true;
  bool receives = true;
};

struct SceneDescription {
  std::string name;
  std::vector<SceneObject> objects;
  std::optional<Camera> camera;    ///< the file's own, or a built-in's defined one
  std::vector<AreaLight> lights;   ///< the file's own, or a built-in's defined one
  std::vector<std::string> notes;  ///< warnings while loading, one sentence each
};

/// Lets go of images that only colour, once an engine has its own copy; those that cut holes stay, for rays.
void releaseColorImages(SceneDescription& scene);

/// Whether a camera is shown an object's back faces, by its material, and of all that is closed: they are
/// seen from within alone, as in a house that is modelled from outside. Closed shells that were wound inward
/// have been turned (see TriangleMesh::turned), and what was a front face there is not told any more.
bool showsBackFaces(const TriangleMesh& mesh, const Material& material);

enum class ObjectFilter { all, casters, receivers };
/// World bounds of the objects that pass the filter, exact over their triangles' corners.
Bounds boundsWorld(const SceneDescription& scene, ObjectFilter filter);

}  // namespace halfshadow::scene
