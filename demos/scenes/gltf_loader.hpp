// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// glTF 2.0 files (.gltf and .glb) as scenes, posed at one instant.
#pragma once

#include <string>

#include "base/error.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

struct GltfOptions {
  double animationTimeSeconds = 0.0;  ///< clamped to the range of each channel's key times
  int animationIndex = 0;             ///< -1 = rest pose; also the rest pose when the file has no animation
};

/// Loads the default scene of a glTF file (its first scene, or all root nodes, when it names none).
///
/// Geometry: triangles, strips and fans, indexed (8, 16, 32 bit) or not; sparse, interleaved, normalised and
/// empty accessors; Draco and meshopt compression, where the build has them; matrix or
/// translation-rotation-scale nodes, also such as flatten what they show; instances; hidden nodes; skins
/// (deformed on the CPU) and animations (STEP, LINEAR, CUBICSPLINE of translation, rotation, scale, morph
/// weights and visibility, also by pointers). Each primitive becomes one object, named after its node;
/// mirrored transforms are unmirrored by reversing the winding. Points and lines are skipped with a note, as
/// are images that cannot be decoded and extensions that are not honoured.
///
/// Materials: base colour factor and image (PNG, JPEG or WebP; v downwards), colours of vertices, alpha
/// cutoff of MASK; BLEND is cut at one half; doubleSided (see SceneOptions::sides). Objects without anything
/// above the cutoff are left out. Images are decoded on threads beside the one that makes the meshes.
///
/// Extras on nodes: {"halfshadow": {"casts": false, "receives": false}}, also for the
/// nodes below unless they say otherwise. Lights (KHR_lights_punctual) become
/// rectangles of full side lengths [w, h] or one number for both from {"halfshadow": {"size": …}} in the
/// node's or the light's extras, in world units, else a point light; they stand at their node and are aimed
/// along its -Z, points without a size at the middle of the scene. A directional light is placed on its axis
/// through the centre of the bounds, 1000 bounding radii away from it; its size is in degrees, 0.53 unless
/// given. Intensities are relative to the file's brightest light.
///
/// Errors: fileNotFound; fileMalformed (the sentence names the file, the element and the fix: bad JSON,
/// truncated or overrun buffers, wrong accessor types or counts, indices out of range, NaN or infinite
/// numbers, singular matrices, cyclic nodes); emptyScene (nothing to draw, or only points and lines);
/// invalidArgument (no such animation).
Result<scene::SceneDescription> loadGltf(const std::string& path, const GltfOptions& options);

}  // namespace halfshadow::scenes
