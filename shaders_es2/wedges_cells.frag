// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the silhouette vertices that matter for the fragment's tile: four sub-lights, each with silhouettes of
// its own; per caster the covered share of each light cell, over casters their product.
#include "tap_count.glsl"
#include "cell_coverage.glsl"
#ifdef HS_FACET_NORMAL
varying HS_HIGHP vec2 v_gradient;
#ifndef HS_NO_HIGHP
#define HS_EXACT_PLACE
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec3 u_eyeLight;  // the eye in (a, b, h)
uniform HS_HIGHP mat3 u_rayLight;  // direction of a pixel's ray in (a, b, h) from (x, y, 1), both 0 to 1
#endif
#endif
varying HS_HIGHP vec4 v_map;  // (a, b, -, h) in the light's coordinates
uniform HS_HIGHP sampler2D u_cellTiles;
uniform HS_HIGHP sampler2D u_cellLists;
uniform HS_HIGHP vec4 u_tileOfTangent;  // tile = tangent · xy + zw
uniform HS_HIGHP vec4 u_tileAtlas;      // xy: columns and rows of the receiver's tiles, zw: first texel
uniform HS_HIGHP vec4 u_cellTexel;      // xy: 1 / size of the tile texture, zw: of the list texture
uniform HS_HIGHP vec4 u_listCenter;     // xyz: (t, i) of the value 32768, w: smallest height of a receiver
uniform HS_HIGHP vec4 u_listScale;      // xyz: (t, i) of one step, w: bias of i
#if defined(HS_CASTING_RECEIVER) && (defined(HS_FACET_NORMAL) || defined(HS_DERIVATIVES))
#define HS_LIFTED
uniform HS_HIGHP mat3 u_lift;  // lift² times the inner product of gradients in (a, b, h)
#endif
#ifdef HS_NO_HIGHP
#define HS_FAR 0.02
#define HS_NEAR 0.001
#define HS_SMALL 1e-4
#else
#define HS_FAR 0.00005
#define HS_NEAR 1e-6
#define HS_SMALL 1e-30
#endif
// More than the longest list that any scene has needed; also keeps compilers from unrolling.
#define HS_LONGEST_LIST 16384

// Where a vertex projects onto the light, relative to the sub-light's centre, in its half sides.
// Vertices beside or behind the receiver go far away in their direction.
HS_HIGHP vec2 hs_onLight(HS_HIGHP vec3 projected, HS_HIGHP vec2 side) {
  HS_HIGHP float w = max(projected.z, HS_FAR * max(abs(projected.x), abs(projected.y)) + 1e-7);
  return 2.0 * projected.xy / w - side;
}

HS_HIGHP vec3 hs_receiver = vec3(0.0);  // (t, i)
HS_HIGHP vec4 hs_head = vec4(0.0);      // xyz: where the list begins
HS_HIGHP float hs_lit = 4.0;            // sub-lights that nothing covers
bool hs_listed = false;

// Finds the fragment's tile, then where it stands once lifted.
void hs_findList() {
  HS_HIGHP vec3 position = v_map.xyw;
  HS_HIGHP float reciprocal = 1.0 / max(position.z, u_listCenter.w);
#ifdef HS_FACET_NORMAL
  // i = 1 / h has the gradient v_gradient over (a, b) / h: the plane is dot(n, (a, b, h)) = 1.
  HS_HIGHP vec3 n = vec3(v_gradient, reciprocal - reciprocal * dot(v_gradient, position.xy));
#endif
#ifdef HS_EXACT_PLACE
  // Rasterisers snap vertices, some to a sixteenth of a pixel, and interpolate to match: a narrow penumbra shows
  // that. The pixel's own ray meets the facet's plane where it should.
  HS_HIGHP vec3 ray = u_rayLight * vec3(gl_FragCoord.xy * u_viewport.xy + u_viewport.zw, 1.0);
  HS_HIGHP float across = dot(n, ray);
  HS_HIGHP vec3 met = u_eyeLight + ray * ((1.0 - dot(n, u_eyeLight)) / (abs(across) < 1e-12 ? 1e-12 : across));
  // Not where the facet is seen edge-on.
  HS_HIGHP vec3 moved = abs(met - position);
  if (max(max(moved.x, moved.y), moved.z) < 0.01 * max(max(abs(position.x), abs(position.y)), position.z)) {
    position = met;
    reciprocal = 1.0 / max(position.z, u_listCenter.w);
  }
#endif
  HS_HIGHP vec2 tile = floor(position.xy * reciprocal * u_tileOfTangent.xy + u_tileOfTangent.zw);
  bool outside = position.z < u_listCenter.w || min(tile.x, tile.y) < 0.0 || tile.x >= u_tileAtlas.x ||
                 tile.y >= u_tileAtlas.y;
  HS_COUNT(1);
  hs_head = floor(texture2D(u_cellTiles, (tile + u_tileAtlas.zw + 0.5) * u_cellTexel.xy) * 255.0 + 0.5);
  // Alpha: sub-lights that nothing covers, and 16 where there is a list.
  hs_listed = !outside && hs_head.a > 15.5;
  hs_lit = outside ? 4.0 : mod(hs_head.a, 16.0);
#ifdef HS_LIFTED
  // A surface must not be cut by the silhouettes of its own edges.
#ifndef HS_FACET_NORMAL
  HS_HIGHP vec3 n = cross(dFdx(position), dFdy(position));
#endif
  n *= dot(n, position) > 0.0 ? -1.0 : 1.0;
  HS_HIGHP vec3 lift = u_lift * n;
  position += lift * inversesqrt(max(dot(n, lift), HS_SMALL));
#endif
  reciprocal = 1.0 / max(position.z, u_listCenter.w);
  hs_receiver = vec3(position.xy * reciprocal, reciprocal);
}

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : 0.25 * hs_lit;
}

float halfshadow_visibility() {
  hs_findList();
  HS_HIGHP vec2 at = vec2(2.0 * hs_head.r + 0.5, hs_head.g + 256.0 * hs_head.b + 0.5) * u_cellTexel.zw;
  HS_HIGHP vec3 origin = u_listCenter.xyz - hs_receiver;
  origin.z -= u_listScale.w;
#ifdef HS_CASTING_RECEIVER
  HS_HIGHP vec3 previous = vec3(0.0);
  HS_HIGHP vec2 reached = vec2(0.0), firstReached = vec2(0.0);
  HS_HIGHP float begun = 0.0;
#else
  HS_HIGHP vec2 previous = vec2(0.0);
#endif
  HS_Cells visible = HS_CELLS_ALL(1.0);
  HS_Cells covered = HS_CELLS_ALL(0.0);
  for (int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!hs_listed) break;
    HS_COUNT(2);
    HS_HIGHP vec4 first = texture2D(u_cellLists, at);
    HS_HIGHP vec4 second = texture2D(u_cellLists, at + vec2(u_cellTexel.z, 0.0));
    HS_HIGHP vec3 high = floor(vec3(first.xz, second.x) * 255.0 + 0.5);
    HS_HIGHP vec3 value = (high - 128.0) * 256.0 + vec3(first.yw, second.y) * 255.0;
    HS_HIGHP vec2 tags = floor(second.zw * 255.0 + 0.5);
    HS_HIGHP vec3 projected = value * u_listScale.xyz * tags.y + origin;
    // Bits of the tag: 128 and 64 the sub-light's side along a and b, 32 the start of a loop, 16
    // its end, 3 what else ends here.
    HS_HIGHP float right = step(127.5, tags.x);
    HS_HIGHP float rest = tags.x - 128.0 * right;
    HS_HIGHP float upper = step(63.5, rest);
    rest -= 64.0 * upper;
    HS_HIGHP float starts = step(31.5, rest);
    rest -= 32.0 * starts;
    HS_HIGHP float closes = step(15.5, rest);
    HS_HIGHP float ends = rest - 16.0 * closes;
    HS_HIGHP vec2 side = 2.0 * vec2(right, upper) - 1.0;
#ifdef HS_CASTING_RECEIVER
    // Edges are cut where they pass the receiver's height; the ends are joined by chords far outside the light.
    begun *= 1.0 - starts;
    HS_HIGHP float before = starts > 0.5 ? -1.0 : previous.z - HS_NEAR, now = projected.z - HS_NEAR;
    HS_HIGHP vec3 cut = mix(previous, projected, before / (abs(before - now) < 1e-9 ? 1e-9 : before - now));
    bool crosses = before * now < 0.0 && starts < 0.5;
    bool seen = max(before, now) > 0.0;
    HS_HIGHP vec2 from = hs_onLight(before > 0.0 ? previous : (crosses ? cut : projected), side);
    HS_HIGHP vec2 to = hs_onLight(now > 0.0 ? projected : cut, side);
    if (seen && begun < 0.5) {
      firstReached = from;
      reached = from;
      begun = 1.0;
    }
    // An edge that starts a loop has no length: from = to.
    hs_addFarChord(covered, reached, from, seen ? 1.0 : 0.0);
    hs_addEdge(covered, seen ? from : to, to);
    reached = seen ? to : reached;
    hs_addFarChord(covered, reached, firstReached, begun * closes);
    previous = projected;
#else
    HS_HIGHP vec2 point = hs_onLight(projected, side);
    hs_addEdge(covered, mix(previous, point, starts), point);
    previous = point;
#endif
    hs_foldCaster(visible, covered, step(0.5, ends));
    hs_lit += hs_takeSquare(visible, step(1.5, ends));
    if (ends > 2.5) break;
    at.x += 2.0 * u_cellTexel.z;
    HS_HIGHP float wrap = step(1.0, at.x);
    at += wrap * vec2(-1.0, u_cellTexel.w);
  }
  return 0.25 * hs_lit;
}
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
