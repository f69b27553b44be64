// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Penumbrae from the distance to the nearest silhouette. HS_PAPER: inside the hard shadow only, by the paper's
// attenuation of shadow depth and shadow width; else on both sides, by the exact profile of a square light.
// Based on: Kirsch, Doellner, "Real-Time Soft Shadows Using a Single Light Sample", 2003, section 3; both sides of
// the silhouette and the widths from the light's size: Halfshadow.
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/shadow_tap.glsl"

#ifdef HS_POINT_LIGHT
float hs_visibility() { return hs_hardTap(); }
#elif defined(HS_PAPER)
uniform HS_HIGHP sampler2D u_widthMap;
uniform HS_HIGHP vec4 u_attenuation;  // x: near distance / distance at shadow depth 1, y: c_scale, z: 1 + c_bias, w: depth units
#ifdef HS_ATTENUATION_TEXTURE
uniform HS_HIGHP sampler2D u_attenuationMap;
#endif

float hs_visibility() {
  HS_HIGHP vec2 center = floor(hs_texel) + 0.5;
  HS_HIGHP vec4 stored = texture2D(u_depthMap, hs_mapUv(center));
  HS_COUNT(1);
  HS_HIGHP float slope = abs(hs_gradient.x) + abs(hs_gradient.y);
  HS_HIGHP float gap = hs_gap(stored, hs_receiver);
  HS_HIGHP float shadowWidth = texture2D(u_widthMap, hs_texel * u_map.y).r;
  HS_COUNT(1);
  if (gap >= min(dot(hs_gradient, center - hs_texel), 0.0) - u_bias.x - u_bias.y * slope) return 1.0;
  // Distances along the light's axis: near / (1 - d), with both d in depth units.
  HS_HIGHP float receiverShare = 1.0 - hs_receiverValue / u_attenuation.w;
  HS_HIGHP float blockerShare = receiverShare - gap / u_attenuation.w;
  HS_HIGHP float shadowDepth = u_attenuation.x * (-gap / u_attenuation.w) / (receiverShare * blockerShare);
#ifdef HS_ATTENUATION_TEXTURE
  HS_COUNT(1);
  return texture2D(u_attenuationMap, (clamp(vec2(shadowDepth, shadowWidth), 0.0, 1.0) * 255.0 + 0.5) * (1.0 / 256.0)).r;
#else
  return clamp(u_attenuation.z - u_attenuation.y * shadowWidth / max(shadowDepth, 1e-4), 0.0, 1.0);
#endif
}
#else
#include "map/half_plane.glsl"
#include "map/horizon.glsl"
#ifdef HS_SUB_LIGHTS_U
#include "map/penumbra_bounds.glsl"
#endif
#ifdef HS_CORNERS
#include "width/width_boxes.glsl"
#endif
#include "width/width_distance.glsl"
uniform HS_HIGHP sampler2D u_widthMap;
#ifndef HS_CORNERS
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side, zw: 1 / xy
#endif
#ifdef HS_SUB_LIGHTS_U
uniform HS_HIGHP vec4 u_widthTile;    // xy: texels per side of a sub-light's map
#endif
uniform HS_HIGHP vec4 u_widthPlace;   // xy: texels of the width map per depth texel, z: margin in texels
uniform HS_HIGHP vec4 u_widthRange;   // x: largest distance, y: knee of the storage, zw: kernel in texels per unit of depth
// x: the nearest caster's distance beyond the near distance, in units of it, y: range of casters' distances (of a split
// light both of depths), z: 1 / depth texels per texel, w: depth units
uniform HS_HIGHP vec4 u_casterDepth;

#ifdef HS_SUB_LIGHTS_U
// Of a split light depths are stored, not distances.
HS_HIGHP float hs_casterDepth(HS_HIGHP float normalised) { return u_casterDepth.x + u_casterDepth.y * normalised; }
#else
HS_HIGHP float hs_casterDepth(HS_HIGHP float normalisedDistance) {
  HS_HIGHP float distance = u_casterDepth.x + u_casterDepth.y * normalisedDistance;
  return u_casterDepth.w * distance / (1.0 + distance);
}
#endif

// Share of a rectangle (widths.x by widths.y, centred on the receiver) on the inner side of a straight edge at a
// signed distance, whose normal has the absolute components `normal`.
HS_HIGHP float hs_halfPlane(HS_HIGHP float signedDistance, HS_HIGHP vec2 normal, HS_HIGHP vec2 widths) {
  return hs_shareInside(signedDistance, normal * widths);
}

// Share of a rectangle outside a disc about its centre: the disc that reaches the nearest silhouette is all lit or all
// shadowed. Exact until the disc leaves the short sides; then the four corners, as squares of what is left of their
// diagonals.
HS_HIGHP float hs_discOutside(HS_HIGHP float radius, HS_HIGHP vec2 widths) {
  HS_HIGHP float a = 0.5 * max(widths.x, widths.y);
  // In units of the longer half side.
  HS_HIGHP float b = 0.5 * min(widths.x, widths.y) / a;
  HS_HIGHP float r = radius / a;
  HS_HIGHP float inscribed = min(r, 1.0);
  HS_HIGHP float sine = min(b / max(inscribed, 1e-4), 1.0);
  HS_HIGHP float angle = asin(sine);
  HS_HIGHP float area = inscribed * inscribed * (angle + sine * sqrt(1.0 - sine * sine));
  HS_HIGHP float outside = 1.0 - area / (2.0 * b);
  HS_HIGHP float diagonal = sqrt(1.0 + b * b);
  HS_HIGHP float corner = clamp((diagonal - r) / (diagonal - 1.0), 0.0, 1.0);
  return r < 1.0 ? outside : outside * corner * corner;
}

#if defined(HS_CASTING_RECEIVER) || defined(HS_FORWARD)
// The receiver may be the caster itself. A host's program serves all of its receivers, casting or not.
#define HS_MAY_CAST
#endif
#if defined(HS_SUB_LIGHTS_U) && !defined(HS_CORNERS)
#include "width/edge_profile.glsl"
#include "width/part_order.glsl"
#include "width/sub_light_widths.glsl"
#else
float hs_visibility() {
  HS_HIGHP vec2 place = hs_texel * u_widthPlace.xy + u_widthPlace.z;
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 size = u_widthTile.xy;
  HS_HIGHP vec2 corner = hs_tile * size;
#else
  HS_HIGHP vec2 size = u_widthLayout.xy;
  HS_HIGHP vec2 corner = vec2(0.0);
#endif
  HS_HIGHP vec2 texel = clamp(place, vec2(0.5), size - 0.5);
  HS_HIGHP vec4 stored = texture2D(u_widthMap, (corner + texel) * u_widthLayout.zw);
  HS_COUNT(1);
  // x: mean distance of the casters there, y: the largest
#ifdef HS_NO_HIGHP
  HS_HIGHP vec2 casters = min(stored.ba, vec2(1.0));  // a value of its own: kept whole, what is stored takes four registers
#else
  HS_HIGHP vec2 casters = stored.ba;
#endif
  // No silhouette as far as distances reach.
  if (stored.r < 0.5 / 255.0) return 1.0;
  HS_HIGHP float signedTexels = hs_unpackDistance(stored.r, u_widthRange.xy);
  HS_HIGHP vec2 normal = vec2(sqrt(max(1.0 - stored.g * stored.g, 0.0)), stored.g);
  // Beyond the map all silhouettes are farther by the way back to it.
  HS_HIGHP vec2 wayBack = abs(place - texel);
  if (signedTexels < 0.0 && max(wayBack.x, wayBack.y) > 0.0) {
    HS_HIGHP vec2 edge = normal * -signedTexels + wayBack;
    signedTexels = -length(edge);
    normal = edge / -signedTexels;
  }
  HS_HIGHP float gap = hs_receiverValue - hs_casterDepth(casters.x);
  HS_HIGHP float slope = abs(hs_gradient.x) + abs(hs_gradient.y);
  HS_HIGHP float ahead = hs_receiverValue - u_bias.x - u_bias.z * slope;
#ifdef HS_MAY_CAST
  bool exact = ahead <= hs_casterDepth(casters.y + 1.0 / 255.0);
#else
  // Occupied, but perhaps by casters behind the receiver.
  bool exact = signedTexels > 0.0 && ahead <= hs_casterDepth(casters.x + 1.0 / 255.0);
#endif
  if (exact) {
    // Only the exact depth knows, and what it finds lit is.
    HS_HIGHP vec2 center = floor(hs_texel) + 0.5;
    HS_HIGHP float exactGap = hs_gap(texture2D(u_depthMap, hs_mapUv(center)), hs_receiver);
    HS_COUNT(1);
    HS_HIGHP float bias = u_bias.x + u_bias.y * slope;
    if (exactGap >= min(dot(hs_gradient, center - hs_texel), 0.0) - bias) return 1.0;
    HS_HIGHP vec2 widths = u_widthRange.zw * max(gap, -exactGap);
    return 1.0 - hs_halfPlane(max(signedTexels, 0.0), normal, max(widths, u_casterDepth.z));
  }
#ifdef HS_CORNERS
  // Straight edges are the profile's; what the boxes hold more or less than a straight edge would is corners,
  // thin casters and casters beside each other.
  HS_HIGHP vec2 widths = u_widthRange.zw * max(gap, 0.0);
  HS_HIGHP float level = 0.5 * log2(max(widths.x * widths.y - 2.0, 4.0));
  HS_HIGHP float lower = clamp(floor(level), 1.0, u_boxLayout.z);
  HS_HIGHP float upper = clamp(level - lower, 0.0, 1.0);
  HS_HIGHP vec4 boxes = hs_boxes(texel, lower, corner, size);
  // The silhouette nearest by and the casters of the whole kernel: two opinions on the occluder's depth, of equal
  // weight unless the kernel is too empty for its mean to have any bits.
  HS_HIGHP vec2 mean = mix(boxes.rg, boxes.ba, upper);
  HS_HIGHP float meanGap = hs_receiverValue - hs_casterDepth(mean.y / max(mean.x, 1e-3));
  gap = mix(gap, meanGap, 0.5 * min(8.0 * mean.x, 1.0));
  widths = u_widthRange.zw * max(gap, 0.0);
  upper = clamp(0.5 * log2(max(widths.x * widths.y - 2.0, 4.0)) - lower, 0.0, 1.0);
  widths = max(widths, u_casterDepth.z);
  HS_HIGHP float small = boxes.r - hs_halfPlane(signedTexels, normal, vec2(sqrt(hs_boxSideSquared(lower))));
  HS_HIGHP float large = boxes.b - hs_halfPlane(signedTexels, normal, vec2(sqrt(hs_boxSideSquared(lower + 1.0))));
  // A receiver beyond the map has the boxes of the map's border, which lie the nearer to the casters.
  HS_HIGHP float area = widths.x * widths.y;
  HS_HIGHP float same = clamp(1.0 - 2.0 * max(wayBack.x, wayBack.y) * inversesqrt(area), 0.0, 1.0);
  HS_HIGHP float share = hs_halfPlane(signedTexels, normal, widths) + same * mix(small, large, upper);
  // Beyond the largest box there is nothing, as far as boxes know.
  HS_HIGHP float held = min(hs_boxSideSquared(u_boxLayout.z + 1.0) / area, 1.0);
  share = mix(same * held * boxes.b, share, held);
  HS_HIGHP float inner = hs_discOutside(abs(signedTexels), widths);
  return 1.0 - (signedTexels < 0.0 ? clamp(share, 0.0, inner) : clamp(share, 1.0 - inner, 1.0));
#else
  return 1.0 - hs_halfPlane(signedTexels, normal, max(u_widthRange.zw * gap, u_casterDepth.z));
#endif
}
#ifdef HS_SUB_LIGHTS_U
float hs_meanVisibility() {
  float sum = 0.0;
  float seen = 0.0;
  float all = 0.0;
  for (int i = 0; i < HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V; ++i) {
    hs_enterSubLight(float(i));
    float above = hs_subLightAbove();
    all += above;
#ifdef HS_HORIZON
    // From below the horizon the caster's own body hides the fragment, see penumbra_main.glsl.
    if (above <= 0.0 || hs_turned * u_receiver.x < 0.0) continue;
#endif
    sum += above * hs_visibility();
    seen += above;
  }
  return sum * (all / (max(seen, 1e-3) * float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V)));
}
#endif
#endif
#endif

#if defined(HS_POINT_LIGHT) || defined(HS_PAPER)
float halfshadow_visibility() {
  hs_prepare();
  return hs_lightMisses ? 1.0 : hs_visibility();
}
#elif defined(HS_SUB_LIGHTS_U)
float halfshadow_class() {
  hs_prepare();
  float known = hs_maskClass();
  return known > -0.5 ? known * hs_lightAbove() : known;
}

float halfshadow_visibility() {
  hs_prepare();
#ifdef HS_CLASSIFIED
  // What the mask knows was drawn before.
  return hs_meanVisibility();
#elif defined(HS_CASTING_RECEIVER) && !defined(HS_CORNERS)
  // Of casters, their own neighbours in the map, the mask knows little, and to ask it costs as much as half of the parts.
  return hs_lightMisses ? hs_lightAbove() : hs_meanVisibility();
#else
  float known = hs_maskClass();
  return known > -0.5 ? known * hs_lightAbove() : hs_meanVisibility();
#endif
}
#else
float halfshadow_visibility() {
  hs_prepare();
  float seen = hs_lightMisses ? 1.0 : hs_visibility();
  return hs_lightAbove() * seen;
}
#endif
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
