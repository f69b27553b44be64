// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Ground truth: visibility of a rectangular light at every pixel, by ray tracing on the CPU.
/// Images are row-major, row 0 on top, pixel (x, y) at index y · width + x.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::reference {

/// What a pixel's centre shows. Values of ReceiverImage::kind; 0 makes the image usable as a selection mask.
enum ReceiverKind : std::uint8_t {
  kNoReceiver = 0,      ///< nothing, an object that does not receive, or a surface turned away from the light
  kGroundReceiver = 1,  ///< surface of an object that casts nothing
  kCasterReceiver = 2,  ///< surface of a caster
};

/// The surface points at which visibility is asked. Positions are double: in a scene far from the origin a
/// float would move them by more than the shadows' detail. Both vectors are zero where no surface is visible.
struct ReceiverImage {
  int width = 0, height = 0;
  std::vector<glm::dvec3> positionWorld;
  std::vector<glm::dvec3> normalWorld;  ///< unit, of the triangle (not interpolated), on the camera's side
  std::vector<std::uint8_t> kind;       ///< ReceiverKind
};

/// Traces one ray through each pixel centre, between the camera's near and far planes.
/// A pixel is a receiver when its object receives and the light's centre lies on the camera's side of the
/// triangle's plane. Every surface is two-sided here: one seen from behind is a receiver on its back.
/// Errors: invalidArgument (size < 1), invalidCamera, emptyScene.
Result<ReceiverImage> traceReceivers(const scene::SceneDescription& scene, const scene::Camera& camera,
                                     const scene::AreaLight& light, int width, int height);

/// Counts up when the tracer answers the same question otherwise: part of the name of whatever keeps a truth.
inline constexpr int kTracerVersion = 2;

struct ReferenceOptions {
  int samples = 4096;      ///< light points per pixel, >= 1; rounded up, see tracedSamples
  std::uint32_t seed = 1;  ///< another seed gives independent noise
  int threads = 0;         ///< 0 = one per hardware thread
  /// How far ray origins on casters are lifted along the normal, in world units. 0: rays start on the facet
  /// itself, as light arrives. Another truth's lift makes images comparable with it where facets meet the
  /// light at a grazing angle.
  double originLiftWorld = 0.0;
  /// Share done, 0 … 1; called by the calling thread only; may be empty.
  std::function<void(double)> progress;
  /// Asked by every thread before each few pixels; once it says true, the others keep the value 1. May be
  /// empty.
  std::function<bool()> isCancelled;
};

/// The number of light points that a request leads to: n × m strata with n = ceil(sqrt(samples)) and
/// m = ceil(samples / n).
int tracedSamples(int samples);

/// Visibility at every pixel: the share of the light's *area* (not weighted by any cosine) that no caster
/// hides (through holes that alpha cuts, light passes), 1 where kind is kNoReceiver and behind the light's
/// plane, where it sends nothing that could be hidden. A triangle that lies in the plane of the receiver's
/// facet as far as single precision tells does not hide it: that facet, its continuation, or a second surface
/// in the same place. All else is decided in double precision, so neither the extent of the scene nor the
/// place of anything else matters. A light of size zero gives 0 or 1. Unbiased; equal for equal seed whatever
/// the number of threads. Errors: invalidArgument (samples not in 1 … 2^24, vectors of the wrong length),
/// invalidLight (NaN or infinite), outOfMemory, internal (Embree refused to start). Based on: Mitchell,
/// Consequences of Stratified Sampling in Graphics, 1996, for jittered strata.
Result<std::vector<float>> traceVisibility(const scene::SceneDescription& scene,
                                           const scene::AreaLight& light, const ReceiverImage& receivers,
                                           const ReferenceOptions& options);

/// The same at the listed pixels only: one value per entry of `pixelIndices`, equal to traceVisibility's
/// there.
Result<std::vector<float>> tracePixels(const scene::SceneDescription& scene, const scene::AreaLight& light,
                                       const ReceiverImage& receivers,
                                       std::span<const std::uint32_t> pixelIndices,
                                       const ReferenceOptions& options);

/// Noise floor: RMSE between `visibility` (traced with `options`) and an independent seed, over every third
/// penumbra pixel; 0 without any. The noise of one image alone is this divided by the square root of 2.
Result<double> noiseRmse(const scene::SceneDescription& scene, const scene::AreaLight& light,
                         const ReceiverImage& receivers, std::span<const float> visibility,
                         const ReferenceOptions& options);

}  // namespace halfshadow::reference
