// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Forest's blending on receivers that cast, whose lists are walked on the screen: pixel by pixel, whatever the size of
// their triangles.
// Based on: Forest, Barthe, Paulin 2006, section 3.
#include "receiver/tap_count.glsl"
#define HS_ON_SCREEN
#define HS_CASTING_RECEIVER
#include "list/vbuffer_edges.glsl"
#include "list/vbuffer_merge.glsl"
#include "list/list_vertices.glsl"
#include "screen/receiver_position.glsl"
#include "list/screen_receiver.glsl"
#define HS_SUB_LIGHTS 1.0
#include "map/half_plane.glsl"
#include "list/caster_lists.glsl"
#include "list/vbuffer_walk.glsl"
#include "list/facet_tree.glsl"
#include "list/blended_lists.glsl"
HS_HIGHP float hs_ownVisibility() { return hs_blendedOwn(); }
#include "list/own_write.glsl"
