// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lists of silhouette vertices in a texture, two texels each, and where vertices project onto the light. Points are
// (t, i): tangents (a, b) / h as the light sees them, and the reciprocal height 1 / h.
uniform HS_HIGHP sampler2D u_cellLists;
uniform HS_HIGHP vec4 u_cellTexel;   // xy: 1 / size of the tile texture, zw: of the list texture
uniform HS_HIGHP vec4 u_listCenter;  // xyz: (t, i) of the value 32768, w: smallest height of a receiver
uniform HS_HIGHP vec4 u_listScale;   // xyz: (t, i) of one step, w: bias of i
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

// Where a record is fetched from.
HS_HIGHP vec2 hs_vertexAt(HS_HIGHP float column, HS_HIGHP float row) {
  return vec2(2.0 * column + 0.5, row + 0.5) * u_cellTexel.zw;
}
// What hs_nextVertex() adds to vertices, for a receiver in (t, i).
HS_HIGHP vec3 hs_originFrom(HS_HIGHP vec3 receiver) {
  return u_listCenter.xyz - receiver - vec3(0.0, 0.0, u_listScale.w);
}

// Whether a loop starts here (no edge leads here) or closes, and what ends: 1 the caster, 2 the sub-light, 3 the
// list. `side`: the sub-light's, in half sides of the light. `oneSided`: the loop counts only where what it covers
// is positive.
struct HS_Tags {
  HS_HIGHP float starts, closes, ends;
#ifdef HS_ONE_SIDED
  HS_HIGHP float oneSided;
#endif
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
  rest -= 16.0 * tags.closes;
#ifdef HS_ONE_SIDED
  tags.oneSided = step(7.5, rest);
  rest -= 8.0 * tags.oneSided;
#endif
  tags.ends = rest;
  at.x += 2.0 * u_cellTexel.z;
  at += step(1.0, at.x) * vec2(-1.0, u_cellTexel.w);
  return value * u_listScale.xyz * bytes.y + origin;
}

// Where a vertex projects onto the light. Vertices beside or behind the receiver go far away in their direction.
HS_HIGHP vec2 hs_onLight(HS_HIGHP vec3 projected) {
  HS_HIGHP float w = max(projected.z, HS_FAR * max(abs(projected.x), abs(projected.y)) + 1e-7);
  return projected.xy / w;
}
