// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where a material with an alpha cutoff has holes: on the CPU, for truth and for tests.
#pragma once

#include "scene/scene_description.hpp"

namespace halfshadow::scene {

/// Alpha in [0, 1] of an image of 4 channels, or of 1, at texture coordinates (v downward), as a sampler
/// without mips reads it; 1 of images of 3.
double alphaAt(const Image& image, const ImageSampling& sampling, const glm::dvec2& texcoord);

/// Alpha of an object at a place of one of its triangles: base colour, image and vertex colours together.
/// `weights`: of the triangle's corners, they add up to 1.
double alphaAt(const SceneObject& object, std::uint32_t triangle, const glm::dvec3& weights);

}  // namespace halfshadow::scene
