// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the silhouette vertices that matter for the fragment's tile of its receiver. The including file defines
// HS_SUB_LIGHTS, the number of sub-lights.
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

HS_HIGHP vec3 hs_receiver = vec3(0.0);  // (t, i)
HS_HIGHP vec4 hs_head = vec4(0.0);      // xyz: where the list begins
HS_HIGHP float hs_lit = 0.0;            // of HS_SUB_LIGHTS, those that nothing covers
bool hs_outside = false;                // of all shadows
bool hs_listed = false;
bool hs_single = false;  // the list is one caster

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
  hs_outside = position.z < u_listCenter.w || min(tile.x, tile.y) < 0.0 || tile.x >= u_tileAtlas.x ||
                 tile.y >= u_tileAtlas.y;
  HS_COUNT(1);
  hs_head = floor(texture2D(u_cellTiles, (tile + u_tileAtlas.zw + 0.5) * u_cellTexel.xy) * 255.0 + 0.5);
  // Alpha: sub-lights that nothing covers, 16 where there is a list, 32 where it is one caster.
  hs_listed = !hs_outside && hs_head.a > 15.5;
  hs_single = !hs_outside && hs_head.a > 31.5;
  hs_lit = hs_outside ? HS_SUB_LIGHTS : mod(hs_head.a, 16.0);
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

// Where the fragment's list begins, and what hs_nextVertex() adds to its vertices.
HS_HIGHP vec2 hs_firstVertex() {
  return vec2(2.0 * hs_head.r + 0.5, hs_head.g + 256.0 * hs_head.b + 0.5) * u_cellTexel.zw;
}
HS_HIGHP vec3 hs_listOrigin() {
  return u_listCenter.xyz - hs_receiver - vec3(0.0, 0.0, u_listScale.w);
}

// Whether a loop starts here (no edge leads here) or closes, and what ends: 1 the caster, 2 the sub-light, 3 the
// list. `side`: the sub-light's, in half sides of the light.
struct HS_Tags {
  HS_HIGHP float starts, closes, ends;
  HS_HIGHP vec2 side;
};

// A vertex as (x w, y w, w) on the light's plane; moves on to the next.
HS_HIGHP vec3 hs_nextVertex(inout HS_HIGHP vec2 at, HS_HIGHP vec3 origin, out HS_Tags tags) {
  HS_COUNT(2);
  HS_HIGHP vec4 first = texture2D(u_cellLists, at);
  HS_HIGHP vec4 second = texture2D(u_cellLists, at + vec2(u_cellTexel.z, 0.0));
  HS_HIGHP vec3 high = floor(vec3(first.xz, second.x) * 255.0 + 0.5);
  HS_HIGHP vec3 value = (high - 128.0) * 256.0 + vec3(first.yw, second.y) * 255.0;
  HS_HIGHP vec2 bytes = floor(second.zw * 255.0 + 0.5);
  HS_HIGHP float right = step(127.5, bytes.x);
  HS_HIGHP float rest = bytes.x - 128.0 * right;
  HS_HIGHP float upper = step(63.5, rest);
  rest -= 64.0 * upper;
  tags.side = 2.0 * vec2(right, upper) - 1.0;
  tags.starts = step(31.5, rest);
  rest -= 32.0 * tags.starts;
  tags.closes = step(15.5, rest);
  tags.ends = rest - 16.0 * tags.closes;
  at.x += 2.0 * u_cellTexel.z;
  at += step(1.0, at.x) * vec2(-1.0, u_cellTexel.w);
  return value * u_listScale.xyz * bytes.y + origin;
}

// Where a vertex projects onto the light. Vertices beside or behind the receiver go far away in their direction.
HS_HIGHP vec2 hs_onLight(HS_HIGHP vec3 projected) {
  HS_HIGHP float w = max(projected.z, HS_FAR * max(abs(projected.x), abs(projected.y)) + 1e-7);
  return projected.xy / w;
}
