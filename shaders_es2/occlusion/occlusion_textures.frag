// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Share of the light that no slice covers.
// Based on: Eisemann, Decoret, "Plausible Image Based Soft Shadows Using Occlusion Textures", 2006, section 3;
// HS_SLICE_DEPTH departs from it: slices hold what the light's centre sees, with its mean depth.
#include "receiver/tap_count.glsl"
#include "occlusion/occlusion_filter.glsl"
varying HS_HIGHP vec4 v_map;               // see SliceSpace::mapFromWorld
// x: nearer border, y: farther border, z: 1 / thickness, w: the share of it that an occluder must be nearer than a
// receiver, and over which its shadow then fades in
uniform HS_HIGHP vec4 u_slices[HS_SLOTS];
uniform HS_HIGHP vec4 u_slicePlace;  // xy: place of the light's axis; ratio on plane s = z + s w
uniform HS_HIGHP vec4 u_sliceOwn;    // own s = v_map.z / (x v_map.w + y); z: frustum's side, see SliceSpace::sideScale
uniform HS_HIGHP sampler2D u_occlusion0;
#if HS_TEXTURES > 1
uniform HS_HIGHP sampler2D u_occlusion1;
#endif
#if HS_TEXTURES > 2
uniform HS_HIGHP sampler2D u_occlusion2;
#endif
#if HS_TEXTURES > 3
uniform HS_HIGHP sampler2D u_occlusion3;
#endif
#if HS_TEXTURES > 4
uniform HS_HIGHP sampler2D u_occlusion4;
#endif
#if HS_TEXTURES > 5
uniform HS_HIGHP sampler2D u_occlusion5;
#endif
#if HS_TEXTURES > 6
uniform HS_HIGHP sampler2D u_occlusion6;
#endif
#if HS_TEXTURES > 7
uniform HS_HIGHP sampler2D u_occlusion7;
#endif

HS_HIGHP vec2 hs_direction;  // towards the light's centre, or that of the sub-light entered
HS_HIGHP float hs_own;
HS_HIGHP float hs_sidePerSlice;
// May the receiver's own surface be in the slices (of any view; of the one that is read)? Else all that is not clearly
// behind it shadows it, up to where they touch.
bool hs_ownMayBeInSlices = false;
bool hs_ownInSlices = false;
#ifdef HS_CASTING_RECEIVER
// Of closed casters only the faces towards the light are in slices, so none whose inner side receives: those are seen as
// front faces at -1 (mirrored), as back faces at 1; at 0 all faces are in slices.
uniform HS_HIGHP float u_innerSide;
#endif
#ifdef HS_LAST_RECEIVERS
uniform HS_HIGHP sampler2D u_lastReceivers;
uniform HS_HIGHP vec4 u_lastRange;  // x: slice units of depth 1, y: slice units that a last receiver is off by

// Is this surface the last one here, and so in no slice? Seen along the line to the centre of projection.
bool hs_isLast() {
  HS_COUNT(1);
  HS_HIGHP vec2 place = u_slicePlace.xy + hs_direction * (u_slicePlace.z + hs_own * u_slicePlace.w);
#ifdef HS_SUB_LIGHTS_U
  place = (clamp(place, 0.0, 1.0) + hs_tile) * u_tiles.zw / u_occlusionLayout.x;
#endif
  HS_HIGHP vec3 bytes = floor(texture2D(u_lastReceivers, place).rgb * 255.0 + 0.5);
  HS_HIGHP float last = dot(bytes, vec3(65536.0, 256.0, 1.0)) * (u_lastRange.x / 16777215.0);
  return hs_own > last - u_lastRange.y;
}
#endif
float hs_visible = 1.0;

#ifdef HS_SUB_LIGHTS_U
#if HS_SUB_LIGHTS_U > HS_SUB_LIGHTS_V
#define HS_MORE_SUB_LIGHTS float(HS_SUB_LIGHTS_U)
#else
#define HS_MORE_SUB_LIGHTS float(HS_SUB_LIGHTS_V)
#endif
uniform HS_HIGHP vec4 u_subLightStep;  // of the map, per slice unit; xy along u, zw along v
uniform HS_HIGHP vec4 u_subLights;     // x: own s at which all maps agree
HS_HIGHP vec2 hs_centerDirection;
HS_HIGHP vec2 hs_apart;  // of the sub-light entered from the light's centre, as u_subLightStep

// Counted along u, then along v.
void hs_enterSubLight(HS_HIGHP float index) {
  HS_HIGHP float v = floor((index + 0.5) * (1.0 / float(HS_SUB_LIGHTS_U)));
  HS_HIGHP float u = index - v * float(HS_SUB_LIGHTS_U);
  hs_apart = (u - 0.5 * float(HS_SUB_LIGHTS_U - 1)) * u_subLightStep.xy +
             (v - 0.5 * float(HS_SUB_LIGHTS_V - 1)) * u_subLightStep.zw;
  hs_direction = hs_centerDirection + hs_apart * (hs_own - u_subLights.x);
  hs_tile.y = floor((index + 0.5) / u_tiles.x);
  hs_tile.x = index - hs_tile.y * u_tiles.x;
}
#endif

// Where the light's frustum meets plane s, in texels: its middle and its side.
HS_HIGHP vec2 hs_middle(HS_HIGHP float s) {
  return (u_slicePlace.xy + hs_direction * (u_slicePlace.z + s * u_slicePlace.w)) * hs_mapTexels;
}
HS_HIGHP float hs_side(HS_HIGHP float s) { return max((hs_own - s) * hs_sidePerSlice, 0.0); }

void hs_combine(float covered) {
#if defined(HS_COMBINE_PRODUCT)
  hs_visible *= 1.0 - covered;
#elif defined(HS_COMBINE_MAX)
  hs_visible = min(hs_visible, 1.0 - covered);
#else
  hs_visible -= covered;
#endif
}

#ifdef HS_SLICE_DEPTH
HS_HIGHP float hs_meanPlane(vec2 covered, HS_HIGHP vec4 slice) {
  return mix(slice.x, slice.y, clamp(covered.y / max(covered.x, 1.0 / 255.0), 0.0, 1.0));
}
#ifdef HS_ONE_SEARCH
#define HS_SAME_PLANE 0.1
// Planes where occluders lie, one for all sub-lights: what one of them sees of what the whole light's frustum covers of
// both slices of a texture, as wide as it is on the nearer border. Sections of farther slices lie inside those of nearer
// ones: whatever hides an occluder there from that sub-light is found before it.
HS_HIGHP float hs_planes[HS_SLOTS];  // -1: none
bool hs_occluded = false;
HS_HIGHP float hs_foundPlane(vec2 covered, HS_HIGHP vec4 slice) {
  if (covered.x <= 0.5 / 255.0 || hs_own <= slice.x) return -1.0;
  hs_occluded = true;
  return min(hs_meanPlane(covered, slice), hs_own);
}
void hs_searchPair(HS_HIGHP sampler2D occlusion, HS_HIGHP vec4 nearer, HS_HIGHP vec4 farther, out HS_HIGHP float first,
                   out HS_HIGHP float second) {
  first = -1.0;
  second = -1.0;
  if (hs_own > nearer.x) {
    HS_HIGHP vec2 apart = hs_apart * (nearer.x - u_subLights.x);
    HS_HIGHP vec2 middle = (u_slicePlace.xy + hs_centerDirection + apart) * hs_mapTexels;
    vec4 covered = hs_pairsMean(occlusion, middle, hs_side(nearer.x) * HS_MORE_SUB_LIGHTS);
    first = hs_foundPlane(covered.xy, nearer);
    second = hs_foundPlane(covered.zw, farther);
  }
}
void hs_addSlice(HS_HIGHP sampler2D occlusion, float pair, HS_HIGHP vec4 slice, HS_HIGHP float plane) {
  if (plane >= 0.0) {
    vec2 covered = hs_pairMean(occlusion, pair, hs_middle(plane), hs_side(plane));
    // This sub-light's own occluders may lie elsewhere, where the frustum is clearly wider or narrower.
    HS_HIGHP float mean = hs_meanPlane(covered, slice);
    if (abs(mean - plane) > HS_SAME_PLANE * (hs_own - plane) && covered.x > 0.5 / 255.0) {
      plane = min(mean, hs_own);
      covered = hs_pairMean(occlusion, pair, hs_middle(plane), hs_side(plane));
      mean = hs_meanPlane(covered, slice);
    }
    HS_HIGHP float before = (hs_own - mean) * slice.z;
    hs_combine(covered.x * clamp(hs_ownInSlices ? before / slice.w - 1.0 : 128.0 * before + 1.0, 0.0, 1.0));
  }
}
#define HS_SEARCH(texture, i) hs_searchPair(texture, u_slices[i], u_slices[i + 1], hs_planes[i], hs_planes[i + 1]);
#define HS_ADD(texture, pair, i) hs_addSlice(texture, pair, u_slices[i], hs_planes[i]);
#else
#define HS_ADD(texture, pair, i) hs_addSlice(texture, pair, u_slices[i]);
// First over the slice's middle plane; then again over the plane where the occluders are found to lie.
void hs_addSlice(HS_HIGHP sampler2D occlusion, float pair, HS_HIGHP vec4 slice) {
  if (hs_own > slice.x) {
    HS_HIGHP float plane = min(0.5 * (slice.x + slice.y), hs_own);
    vec2 covered = hs_pairMean(occlusion, pair, hs_middle(plane), hs_side(plane));
    if (covered.x > 0.5 / 255.0) {
      plane = min(hs_meanPlane(covered, slice), hs_own);
      covered = hs_pairMean(occlusion, pair, hs_middle(plane), hs_side(plane));
      HS_HIGHP float before = (hs_own - hs_meanPlane(covered, slice)) * slice.z;
      // A step of the mean depth is 1/255.
      hs_combine(covered.x * clamp(hs_ownInSlices ? before / slice.w - 1.0 : 128.0 * before + 1.0, 0.0, 1.0));
    }
  }
}
#endif
// Of each texture that there is, with its first slice.
#define HS_FOR_0(each) each(u_occlusion0, 0)
#if HS_TEXTURES > 1
#define HS_FOR_1(each) HS_FOR_0(each) each(u_occlusion1, 2)
#else
#define HS_FOR_1(each) HS_FOR_0(each)
#endif
#if HS_TEXTURES > 2
#define HS_FOR_2(each) HS_FOR_1(each) each(u_occlusion2, 4)
#else
#define HS_FOR_2(each) HS_FOR_1(each)
#endif
#if HS_TEXTURES > 3
#define HS_FOR_3(each) HS_FOR_2(each) each(u_occlusion3, 6)
#else
#define HS_FOR_3(each) HS_FOR_2(each)
#endif
#if HS_TEXTURES > 4
#define HS_FOR_4(each) HS_FOR_3(each) each(u_occlusion4, 8)
#else
#define HS_FOR_4(each) HS_FOR_3(each)
#endif
#if HS_TEXTURES > 5
#define HS_FOR_5(each) HS_FOR_4(each) each(u_occlusion5, 10)
#else
#define HS_FOR_5(each) HS_FOR_4(each)
#endif
#if HS_TEXTURES > 6
#define HS_FOR_6(each) HS_FOR_5(each) each(u_occlusion6, 12)
#else
#define HS_FOR_6(each) HS_FOR_5(each)
#endif
#if HS_TEXTURES > 7
#define HS_FOR_7(each) HS_FOR_6(each) each(u_occlusion7, 14)
#else
#define HS_FOR_7(each) HS_FOR_6(each)
#endif
#define HS_ADD_PAIR(texture, i) HS_ADD(texture, 0.0, i) HS_ADD(texture, 1.0, i + 1)
#else
// The slice that contains the receiver fades in between its two borders.
void hs_addSlice(HS_HIGHP sampler2D occlusion, vec2 channel, HS_HIGHP vec4 slice) {
  if (hs_own > slice.x) {
    float fade = clamp((hs_own - slice.x) * slice.z, 0.0, 1.0);
    HS_HIGHP float plane = min(slice.y, hs_own);
    hs_combine(hs_channelMean(occlusion, channel, hs_middle(plane), hs_side(plane)) * fade);
  }
}
#define HS_ROW_OF(texture, row, first) hs_addSlice(texture, vec2(0.0, row), u_slices[first]); hs_addSlice(texture, vec2(1.0, row), u_slices[first + 1]);
#define HS_SLICES_OF(texture, first) HS_ROW_OF(texture, 0.0, first) HS_ROW_OF(texture, 1.0, first + 2)
#endif

#ifdef HS_CONCENTRIC
// Seen from the light's centre all frustum sections share their middle, and the first is the widest: receivers
// beyond the map see the whole light without a fetch.
bool hs_beyondMap(HS_HIGHP vec2 share) {
  HS_HIGHP vec2 beyond = abs(hs_middle(0.0) - 0.5 * hs_mapTexels) -
                         0.5 * (hs_mapTexels + hs_side(0.0) * u_kernelShape.xy * share);
  return max(beyond.x, beyond.y) > 0.0;
}
#endif

float hs_visibility() {
  hs_ownInSlices = hs_ownMayBeInSlices;
#ifdef HS_LAST_RECEIVERS
  if (hs_ownInSlices) hs_ownInSlices = !hs_isLast();
#endif
#if defined(HS_CONCENTRIC) && defined(HS_NO_HIGHP) && !defined(HS_SUB_LIGHTS_U)
  // In front of all slices: branches around all that follows would take registers.
  hs_own = hs_beyondMap(vec2(1.0)) ? -60000.0 : hs_own;
#elif defined(HS_CONCENTRIC)
  if (hs_beyondMap(vec2(1.0))) return 1.0;
#endif
  hs_visible = 1.0;
#ifdef HS_SLICE_DEPTH
  HS_FOR_7(HS_ADD_PAIR)
#else
  HS_SLICES_OF(u_occlusion0, 0)
#if HS_TEXTURES > 1
  HS_SLICES_OF(u_occlusion1, 4)
#endif
#if HS_TEXTURES > 2
  HS_SLICES_OF(u_occlusion2, 8)
#endif
#if HS_TEXTURES > 3
  HS_SLICES_OF(u_occlusion3, 12)
#endif
#endif
  return clamp(hs_visible, 0.0, 1.0);
}

#include "map/sub_lights.glsl"
float halfshadow_visibility() {
  // Nearer to the light than every caster, or behind the light.
  if (v_map.z <= 0.0 || v_map.w <= 0.0) return 1.0;
  HS_HIGHP float inverseDistance = 1.0 / v_map.w;
  HS_HIGHP float divisor = u_sliceOwn.x * v_map.w + u_sliceOwn.y;
  hs_direction = v_map.xy * inverseDistance;
  hs_own = v_map.z / divisor;
  hs_sidePerSlice = u_sliceOwn.z * divisor * inverseDistance;
#if defined(HS_CASTING_RECEIVER) || defined(HS_FORWARD)
  hs_ownMayBeInSlices = true;
#ifdef HS_CASTING_RECEIVER
  // Not compared with ==: drivers differ in what a facing bit is equal to.
  if (u_innerSide != 0.0) hs_ownMayBeInSlices = gl_FrontFacing ? u_innerSide > 0.0 : u_innerSide < 0.0;
#endif
#endif
#ifdef HS_SUB_LIGHTS_U
  hs_centerDirection = hs_direction;
  if (hs_beyondMap(vec2(float(HS_SUB_LIGHTS_U), float(HS_SUB_LIGHTS_V)))) return 1.0;
#endif
#ifdef HS_ONE_SEARCH
  hs_enterSubLight(float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V / 2));
  HS_FOR_7(HS_SEARCH)
  if (!hs_occluded) return 1.0;
#endif
  return hs_meanVisibility();
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
