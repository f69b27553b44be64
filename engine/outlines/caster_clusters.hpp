// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Which casters of a sub-light are taken together, and what they cover then (internal to engine/outlines).
#pragma once

#include "outlines/caster_loops.hpp"

namespace halfshadow::outlines {

/// Clusters of `loops.casters`, which were made of `silhouettes` in their order. Casters that enclose the
/// light, or receivers, stand alone.
/// Penumbra RMSE on the ground, casters multiplied -> clusters taken together, truth's noise (.009) included:
/// bitmoji (18 parts) with centres alone .026 -> .012, with four sub-lights .016 -> .012; figure, half size
/// 1: .016 -> .008, .010 -> .007; fence .021 -> .018, .011 -> .010. Casters that do not touch, but lie before
/// each other, are better multiplied: spheres27, half size 2, .014 -> .030 if these were taken together, too.
std::vector<CasterCluster> casterClusters(const scene::LightSilhouettes& silhouettes,
                                          const SubLightLoops& loops, const ListSpace& space);

/// `outlines` of whole parts, seen from the light's centre: those of a cluster as one, for sums of coverage
/// that could tell no overlap. Of receivers between its casters those behind some lose what these hide of the
/// others; seldom seen, since casters' own surfaces are listed.
scene::LightSilhouettes takenTogether(scene::LightSilhouettes outlines);

}  // namespace halfshadow::outlines
