// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The paper's edge mask: a Laplacian of the depth map, dilated through its mip chain.
/// Based on: Evans, Agenjo, Blat 2014, sections 4.3 and 4.4.
#pragma once

#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow::techniques {

enum class EdgeFilter { laplacian5, laplacian9 };

struct EdgeMaskOptions {
  EdgeFilter filter = EdgeFilter::laplacian5;
  double radiusTexels = 2.0;  ///< the dilation covers kernels of this radius
  /// Strength per unit of (map) depth difference and thresholds of the weak, medium and strong channels.
  /// Defaults: any difference above the storage quantum is an edge.
  double strengthPerDepth = 0.0;
  glm::dvec3 thresholds{0.2, 0.5, 0.8};
};

struct EdgeMask {
  framegraph::ResourceId mask;  ///< red strong, green medium, blue weak, alpha any; bilinear
};
Result<EdgeMask> planEdgeMask(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                              const EdgeMaskOptions& options);
void addEdgeMask(ReceiverShading& shading, const EdgeMask& mask);

}  // namespace halfshadow::techniques
