// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lists of silhouette vertices in a texture, two texels each, and where vertices project onto the light. Points are
// (t, i): tangents (a, b) / h as the light sees them, and the reciprocal height 1 / h.
uniform HS_HIGHP sampler2D u_cellLists;
uniform HS_HIGHP vec4 u_cellTexel;   // xy: 1 / size of the tile texture, zw: of the list texture
// x: smallest height of a receiver; y: by how many steps vertices are nearer to its height than stored; by how many
// steps (z), and by what share of its (t, i) (w), it stands off its facet.
uniform HS_HIGHP vec4 u_listPlace;
#ifdef HS_NO_HIGHP
#define HS_FAR 0.02
#define HS_PLANE_ROUNDING 2.0
#define HS_BEHIND 1e-7
#define HS_SMALL 1e-4
#define HS_SAME 1e-4
#else
#define HS_FAR 1e-6
#define HS_PLANE_ROUNDING 16.0
#define HS_BEHIND 1e-30
#define HS_SMALL 1e-30
#define HS_SAME 1e-30
#endif
// As outlines::kLongestList: no list is longer. Also keeps compilers from unrolling. Some drivers make 16 bits of an
// integer that is not highp, and end loops after 65,535 turns.
#ifdef HS_NO_HIGHP
#define HS_LONGEST_LIST 32767
#else
#define HS_LONGEST_LIST 65000
#endif

// Where a record is fetched from.
HS_HIGHP vec2 hs_vertexAt(HS_HIGHP float column, HS_HIGHP float row) {
  return vec2(2.0 * column + 0.5, row + 0.5) * u_cellTexel.zw;
}
HS_HIGHP vec3 hs_step = vec3(1.0);  // (t, i) of one step of the list's vertices
HS_HIGHP vec3 hs_wideStep = vec3(256.0);  // of 256: a step alone may be too small for half precision
HS_HIGHP float hs_near = 1.0;       // edges are cut where they are so little nearer to the light than the receiver

HS_HIGHP vec2 hs_recordAfter(HS_HIGHP vec2 at) {
  at.x += 2.0 * u_cellTexel.z;
  return at + step(1.0, at.x) * vec2(-1.0, u_cellTexel.w);
}

// Reads where the list's vertices are counted from, and moves on to the first.
HS_HIGHP vec3 hs_beginList(inout HS_HIGHP vec2 at) {
  HS_COUNT(2);
  HS_HIGHP vec4 first = texture2D(u_cellLists, at);
  HS_HIGHP vec4 second = texture2D(u_cellLists, at + vec2(u_cellTexel.z, 0.0));
  HS_HIGHP vec3 high = floor(vec3(first.xz, second.x) * 255.0 + 0.5);
  HS_HIGHP vec3 value = (high - 128.0) * 256.0 + floor(vec3(first.yw, second.y) * 255.0 + 0.5);
  HS_HIGHP vec2 exponents = floor(second.zw * 255.0 + 0.5) - 128.0;
  hs_step = exp2(exponents.xxy);
  hs_wideStep = exp2(exponents.xxy + 8.0);
#ifdef HS_NO_HIGHP
  hs_near = 0.001;
#else
  hs_near = 0.25 * hs_step.z;
#endif
  at = hs_recordAfter(at);
  return value * hs_wideStep;
}
#ifdef HS_ON_SCREEN
// Of a receiver that was stored: how much the plane of its facet may turn over a unit of t and i.
HS_HIGHP vec3 hs_planeTurn = vec3(0.0);
#endif
// What hs_nextVertex() adds to vertices, for a receiver in (t, i) that leaves its facet in the directions `away`, one for
// each coordinate, and a list with that centre.
HS_HIGHP vec3 hs_originFrom(HS_HIGHP vec3 center, HS_HIGHP vec3 receiver, HS_HIGHP vec3 away) {
  HS_HIGHP vec3 rounding = u_listPlace.w * abs(receiver);
  HS_HIGHP vec3 origin = center - receiver - away * (u_listPlace.z * hs_step + rounding);
#ifdef HS_NO_HIGHP
  origin.z -= u_listPlace.y * hs_step.z;
#else
  origin.z -= u_listPlace.y * hs_step.z + rounding.z;
#endif
  return origin;
}

// Whether a loop starts here (no edge leads here) or closes, and what ends: 1 the caster, 2 the sub-light, 3 the
// list. `side`: the sub-light's, in half sides of the light. `oneSided`: the loop counts only where what it covers
// is positive. `coarse`: its steps, of the list's. `firstSide`: what ends is one side of a sheet, and the other follows.
struct HS_Tags {
  HS_HIGHP float starts, closes, ends;
#ifdef HS_ONE_SIDED
  HS_HIGHP float oneSided, coarse;
#endif
#ifdef HS_SIDES
  HS_HIGHP float firstSide;
#endif
  HS_HIGHP vec2 side;
#ifdef HS_TREES
  HS_HIGHP float tree;       // 1: what was read is where a tree begins
  HS_HIGHP float subLights;  // of a tree: those it counts for, a bit each
#endif
};

#if defined(HS_BEHIND_FACETS) || defined(HS_ONE_SIDED) || defined(HS_CASTING_RECEIVER)
HS_HIGHP vec3 hs_facet = vec3(0.0);  // how the plane of the receiver's facet rises along (t, i), on its visible side
HS_HIGHP float hs_facetRounding = 0.0;  // for vertices of one step: they are known to lie off that plane where they rise by more
// How far a vertex, relative to the receiver, rises off that plane, less what the plane's own rounding makes of its distance:
// it comes through a varying, and large facets reach far.
HS_HIGHP float hs_offFacet(HS_HIGHP vec3 vertex) {
  HS_HIGHP vec3 rounding = HS_PLANE_ROUNDING * u_listPlace.w * abs(hs_facet);
#ifdef HS_ON_SCREEN
  rounding += hs_planeTurn;
#endif
  return abs(dot(hs_facet, vertex)) - dot(rounding, abs(vertex));
}
#endif
#ifdef HS_BEHIND_FACETS
// Corner 0, 1 or 2 of a triangle that has of the light what lies behind that plane, counter-clockwise.
HS_HIGHP vec3 hs_behindFacet(HS_HIGHP float corner) {
  HS_HIGHP float slope = max(length(hs_facet.xy), HS_SMALL);
  HS_HIGHP vec2 outward = hs_facet.xy / slope;
  // On the light the plane is a line: so far from its centre, or at least well outside.
  HS_HIGHP vec2 middle = -clamp(hs_facet.z / slope, -4.0, 4.0) * outward;
  HS_HIGHP float along = corner < 0.5 ? -16.0 : corner < 1.5 ? 16.0 : 0.0;
  HS_HIGHP vec2 at = middle + along * vec2(-outward.y, outward.x) - (corner < 1.5 ? 0.0 : 32.0) * outward;
  return vec3(at, 1.0) * (4.0 * hs_near);
}
#endif

// A vertex as (x w, y w, w) on the light's plane; moves on to the next.
HS_HIGHP vec3 hs_nextVertex(inout HS_HIGHP vec2 at, HS_HIGHP vec3 origin, out HS_Tags tags) {
  HS_COUNT(2);
  HS_HIGHP vec4 first = texture2D(u_cellLists, at);
  HS_HIGHP vec4 second = texture2D(u_cellLists, at + vec2(u_cellTexel.z, 0.0));
  HS_HIGHP vec3 high = floor(vec3(first.xz, second.x) * 255.0 + 0.5);
  HS_HIGHP vec3 value = high - 128.0 + vec3(first.yw, second.y) * (255.0 / 256.0);
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
  tags.coarse = bytes.y * bytes.y;
#endif
#ifdef HS_BEHIND_FACETS
  HS_HIGHP float behind = step(3.5, rest);
  rest -= 4.0 * behind;
#endif
  tags.ends = rest;
#ifdef HS_SIDES
  // No loop starts where one ends.
  tags.firstSide = tags.starts * step(0.5, rest);
  tags.starts -= tags.firstSide;
#endif
  at = hs_recordAfter(at);
#ifdef HS_TREES
  tags.tree = behind * step(2.5, 256.0 * value.x);
  tags.subLights = floor(second.y * 255.0 + 0.5);
  if (tags.tree > 0.5) return floor(vec3(first.zw, second.x) * 255.0 + 0.5);
#endif
#ifdef HS_BEHIND_FACETS
  if (behind > 0.5) return hs_behindFacet(256.0 * value.x);
#endif
  return value * hs_wideStep * bytes.y * bytes.y + origin;
}

// Where a vertex projects onto the light. Vertices beside or behind the receiver go far away in their direction.
HS_HIGHP vec2 hs_onLight(HS_HIGHP vec3 projected) {
  HS_HIGHP float w = max(projected.z, HS_FAR * max(abs(projected.x), abs(projected.y)) + HS_BEHIND);
  return projected.xy / w;
}

#ifdef HS_CUTS
// The part of an edge that is nearer to the light than the receiver, as (x w, y w, w); false: there is none. Where a loop
// starts the edge has no length.
bool hs_cutEdge(HS_HIGHP vec3 previous, HS_HIGHP vec3 projected, HS_HIGHP float starts, out HS_HIGHP vec3 from,
                out HS_HIGHP vec3 to) {
  HS_HIGHP float before = starts > 0.5 ? -1.0 : previous.z - hs_near, now = projected.z - hs_near;
  HS_HIGHP vec3 cut = mix(previous, projected, before / (abs(before - now) < HS_SAME ? HS_SAME : before - now));
  bool crosses = before * now < 0.0 && starts < 0.5;
  from = before > 0.0 ? previous : (crosses ? cut : projected);
  to = now > 0.0 ? projected : cut;
  return max(before, now) > 0.0;
}
#endif
