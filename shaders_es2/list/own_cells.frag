// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Light cells of receivers that cast, whose lists are walked on the screen: pixel by pixel, whatever the size of their
// triangles. HS_WHOLE_LIGHT: lists of the whole light, else of its quarters.
#include "receiver/tap_count.glsl"
#define HS_ON_SCREEN
#define HS_CASTING_RECEIVER
#ifdef HS_WHOLE_LIGHT
#define HS_SUB_LIGHTS 1.0
#else
#define HS_SUB_LIGHTS 4.0
#endif
#include "list/cell_coverage.glsl"
#include "list/list_vertices.glsl"
#include "screen/receiver_position.glsl"
#include "list/screen_receiver.glsl"
#include "map/half_plane.glsl"
#include "list/caster_lists.glsl"
#include "list/cell_walk.glsl"
#include "list/light_grid.glsl"
#include "list/facet_tree.glsl"
#include "list/gathered_cells.glsl"
HS_HIGHP float hs_ownVisibility() { return hs_gatheredLight() / HS_SUB_LIGHTS; }
#include "list/own_write.glsl"
