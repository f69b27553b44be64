// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The integral of x dy along a piece of silhouette as a receiver sees it on the light's plane, with x and y clamped to
// the light's square. Exact, continuous in the receiver's position, and additive: pieces that share a chord cancel
// along it. Programs whose vertices come projected, as varyings, define HS_WEDGE_PROJECTED.
// `w`, the height of the receiver above a vertex in units of the caster's size, must exceed `near`, at least
// HS_WEDGE_NEAR, for the vertex to occlude. Receivers are split in two by the heights where all vertices do, which is
// the rule.
#ifdef HS_NO_HIGHP
#define HS_WEDGE_ALL_NEAR 4e-3
#define HS_WEDGE_FLAT 1e-2
#define HS_WEDGE_LEVEL 2e-3
#define hs_finite(x) clamp(x, -200.0, 200.0)
#else
#define HS_WEDGE_ALL_NEAR 1e-3
#define HS_WEDGE_FLAT 1e-4
#define HS_WEDGE_LEVEL 1e-6
#define hs_finite(x) (x)
#endif
#if !defined(HS_NO_HIGHP)
#define HS_WEDGE_NEAR 1e-4
#elif defined(HS_WEDGE_PROJECTED)
#define HS_WEDGE_NEAR 4e-3
#else
#define HS_WEDGE_NEAR 2e-3
#endif

// So many edges, or vertices, at a time.
#if defined(HS_WEDGE_CLIP) && defined(HS_WEDGE_CHAIN)
#define HS_Edges vec2
#else
#define HS_Edges vec4
#endif

#if defined(HS_NO_HIGHP) && !defined(HS_WEDGE_PROJECTED)
// Keeps projected positions where slopes and primitives do not overflow, in their direction from the light's centre.
void hs_bound(inout HS_HIGHP HS_Edges x, inout HS_HIGHP HS_Edges y) {
  HS_HIGHP HS_Edges scale = 60.0 / max(max(abs(x), abs(y)), 60.0);
  x *= scale;
  y *= scale;
}
#endif

// From a vertex on the receiver's side of the light's plane to where the receiver sees it.
#ifdef HS_WEDGE_PROJECTED
// (x w, y w), w: relative precision is all that counts, and no quotient overflows.
void hs_project(inout HS_HIGHP HS_Edges x, inout HS_HIGHP HS_Edges y, HS_HIGHP HS_Edges w, HS_HIGHP vec2 foot,
                HS_HIGHP float scale, HS_HIGHP float near) {
#ifdef HS_NO_HIGHP
  w = max(w, max(abs(x), abs(y)) * (1.0 / 60.0));
#endif
  HS_HIGHP HS_Edges inverse = 1.0 / max(w, near);
  x *= inverse;
  y *= inverse;
}
#else
// Relative to the receiver; `scale` turns that into offsets on the light's plane, from `foot`.
void hs_project(inout HS_HIGHP HS_Edges x, inout HS_HIGHP HS_Edges y, HS_HIGHP HS_Edges w, HS_HIGHP vec2 foot,
                HS_HIGHP float scale, HS_HIGHP float near) {
  HS_HIGHP HS_Edges inverse = scale / max(w, near);
  x = x * inverse + foot.x;
  y = y * inverse + foot.y;
#ifdef HS_NO_HIGHP
  hs_bound(x, y);
#endif
}
#endif

// Not mix(), which drivers may compute as a + s (b - a): b is then lost beside a large a.
HS_HIGHP HS_Edges hs_select(HS_HIGHP HS_Edges a, HS_HIGHP HS_Edges b, HS_HIGHP HS_Edges s) { return a * (HS_Edges(1.0) - s) + b * s; }

// Edges (xa, ya) -> (xb, yb): the integral of clamp(x) dy between the clamped ends.
HS_HIGHP float hs_edgeIntegrals(HS_HIGHP HS_Edges xa, HS_HIGHP HS_Edges ya, HS_HIGHP HS_Edges xb, HS_HIGHP HS_Edges yb) {
  HS_HIGHP HS_Edges clampedA = clamp(ya, -1.0, 1.0);
  HS_HIGHP HS_Edges clampedB = clamp(yb, -1.0, 1.0);
  HS_HIGHP HS_Edges rise = yb - ya;
  // Where the edge is level the clamped ends are, too, and whatever the slope the integral is 0.
  HS_HIGHP HS_Edges slope = (xb - xa) / (rise + (HS_Edges(1.0) - step(HS_WEDGE_LEVEL, abs(rise))));
  // From the end nearer to the light's square: the other may be far away.
  HS_HIGHP HS_Edges nearer = step(abs(yb), abs(ya));
  HS_HIGHP HS_Edges x = hs_select(xa, xb, nearer), y = hs_select(ya, yb, nearer);
  HS_HIGHP HS_Edges xFrom = x + hs_finite((clampedA - y) * slope);
  HS_HIGHP HS_Edges xTo = x + hs_finite((clampedB - y) * slope);
  HS_HIGHP HS_Edges from = clamp(xFrom, -1.0, 1.0);
  HS_HIGHP HS_Edges to = clamp(xTo, -1.0, 1.0);
  // The mean of clamp(x) for x from xFrom to xTo, weighted by the lengths before, within and behind the square: far
  // beside it, where one of these is lost beside another, all have the one value that counts.
  HS_HIGHP HS_Edges before = from - xFrom, within = to - from, behind = xTo - to;
  HS_HIGHP HS_Edges run = before + within + behind;
  HS_HIGHP HS_Edges level = HS_Edges(1.0) - step(HS_WEDGE_FLAT, abs(run));
  HS_HIGHP HS_Edges weighted = from * before + 0.5 * (from + to) * within + to * behind;
  HS_HIGHP HS_Edges mean = hs_select(weighted / (run + level), 0.5 * (from + to), level);
  return dot(mean, clampedB - clampedA);
}

#if defined(HS_WEDGE_CLIP) && defined(HS_WEDGE_CHAIN)
// For devices that have no room for the whole polygon: points that stay, in order, a vertex at a time: the point where
// the edge to it passes `near`, then itself. What is cut away repeats the point before; edges count once there is one,
// and the last point is joined to the first.
struct HS_Chain {
  HS_HIGHP vec2 first, last;
  HS_HIGHP float begun;
};
// before, v: (x, y, w) of a vertex.
HS_HIGHP float hs_next(inout HS_Chain chain, HS_HIGHP vec3 before, HS_HIGHP vec3 v, HS_HIGHP vec2 foot, HS_HIGHP float scale,
                       HS_HIGHP float near) {
  HS_HIGHP float inside = step(near, v.z);
  HS_HIGHP float cut = abs(inside - step(near, before.z));
  HS_HIGHP float t = (near - before.z) / (1.0 - cut + (v.z - before.z) * cut);
  HS_HIGHP vec2 x = vec2(mix(before.x, v.x, t), v.x), y = vec2(mix(before.y, v.y, t), v.y);
  hs_project(x, y, vec2(near, v.z), foot, scale, near);
  // No edge leads to the first point that stays.
  HS_HIGHP vec2 point = cut > 0.5 ? vec2(x.x, y.x) : vec2(x.y, y.y);
  HS_HIGHP vec2 from = chain.begun > 0.5 ? chain.last : point;
  if (chain.begun < 0.5) chain.first = point;
  HS_HIGHP vec2 through = cut > 0.5 ? vec2(x.x, y.x) : from;
  chain.last = inside > 0.5 ? vec2(x.y, y.y) : through;
  chain.begun = max(chain.begun, max(cut, inside));
  return hs_edgeIntegrals(vec2(from.x, through.x), vec2(from.y, through.y), vec2(through.x, chain.last.x),
                          vec2(through.y, chain.last.y));
}
// x, y: vertices as hs_project() takes them.
HS_HIGHP float hs_polygonIntegral(HS_HIGHP vec4 x0, HS_HIGHP vec4 x1, HS_HIGHP vec4 y0, HS_HIGHP vec4 y1,
                                  HS_HIGHP vec4 w0, HS_HIGHP vec4 w1, HS_HIGHP vec2 foot, HS_HIGHP float scale,
                                  HS_HIGHP float near) {
  HS_Chain chain;
  chain.first = chain.last = vec2(0.0);
  chain.begun = 0.0;
  HS_HIGHP vec3 v0 = vec3(x0.x, y0.x, w0.x), v1 = vec3(x0.y, y0.y, w0.y), v2 = vec3(x0.z, y0.z, w0.z);
  HS_HIGHP vec3 v3 = vec3(x0.w, y0.w, w0.w), v4 = vec3(x1.x, y1.x, w1.x), v5 = vec3(x1.y, y1.y, w1.y);
  HS_HIGHP vec3 v6 = vec3(x1.z, y1.z, w1.z), v7 = vec3(x1.w, y1.w, w1.w);
  HS_HIGHP float sum = hs_next(chain, v7, v0, foot, scale, near);
  sum += hs_next(chain, v0, v1, foot, scale, near);
  sum += hs_next(chain, v1, v2, foot, scale, near);
  sum += hs_next(chain, v2, v3, foot, scale, near);
  sum += hs_next(chain, v3, v4, foot, scale, near);
  sum += hs_next(chain, v4, v5, foot, scale, near);
  sum += hs_next(chain, v5, v6, foot, scale, near);
  sum += hs_next(chain, v6, v7, foot, scale, near);
  // One edge, twice.
  return sum + 0.5 * hs_edgeIntegrals(vec2(chain.last.x), vec2(chain.last.y), vec2(chain.first.x), vec2(chain.first.y));
}
#elif defined(HS_WEDGE_CLIP)
// Vertices and the points where edges pass `near`, in order; what is cut away becomes a copy of its
// neighbour, so that a chord closes the rest.
HS_HIGHP vec2 hs_keep(HS_HIGHP vec2 last, HS_HIGHP vec2 point, HS_HIGHP float kept) {
  return kept > 0.5 ? point : last;
}
HS_HIGHP vec2 hs_keepBackwards(HS_HIGHP vec2 last, HS_HIGHP vec4 x, HS_HIGHP vec4 y, HS_HIGHP vec4 inside,
                               HS_HIGHP vec4 cutX, HS_HIGHP vec4 cutY, HS_HIGHP vec4 cut) {
  last = hs_keep(last, vec2(x.w, y.w), inside.w);
  last = hs_keep(last, vec2(cutX.w, cutY.w), cut.w);
  last = hs_keep(last, vec2(x.z, y.z), inside.z);
  last = hs_keep(last, vec2(cutX.z, cutY.z), cut.z);
  last = hs_keep(last, vec2(x.y, y.y), inside.y);
  last = hs_keep(last, vec2(cutX.y, cutY.y), cut.y);
  last = hs_keep(last, vec2(x.x, y.x), inside.x);
  return hs_keep(last, vec2(cutX.x, cutY.x), cut.x);
}
void hs_keepForwards(inout HS_HIGHP vec2 last, HS_HIGHP vec2 x, HS_HIGHP vec2 y, HS_HIGHP vec2 inside,
                     HS_HIGHP vec2 cutX, HS_HIGHP vec2 cutY, HS_HIGHP vec2 cut, out HS_HIGHP vec4 keptX,
                     out HS_HIGHP vec4 keptY) {
  HS_HIGHP vec2 p0 = hs_keep(last, vec2(cutX.x, cutY.x), cut.x);
  HS_HIGHP vec2 p1 = hs_keep(p0, vec2(x.x, y.x), inside.x);
  HS_HIGHP vec2 p2 = hs_keep(p1, vec2(cutX.y, cutY.y), cut.y);
  last = hs_keep(p2, vec2(x.y, y.y), inside.y);
  keptX = vec4(p0.x, p1.x, p2.x, last.x);
  keptY = vec4(p0.y, p1.y, p2.y, last.y);
}

// x, y: vertices as hs_project() takes them.
HS_HIGHP float hs_polygonIntegral(HS_HIGHP vec4 x0, HS_HIGHP vec4 x1, HS_HIGHP vec4 y0, HS_HIGHP vec4 y1,
                                  HS_HIGHP vec4 w0, HS_HIGHP vec4 w1, HS_HIGHP vec2 foot, HS_HIGHP float scale,
                                  HS_HIGHP float near) {
  HS_HIGHP vec4 in0 = step(near, w0), in1 = step(near, w1);
  HS_HIGHP vec4 beforeW0 = vec4(w1.w, w0.xyz), beforeW1 = vec4(w0.w, w1.xyz);
  HS_HIGHP vec4 cut0 = abs(in0 - vec4(in1.w, in0.xyz)), cut1 = abs(in1 - vec4(in0.w, in1.xyz));
  HS_HIGHP vec4 t0 = (near - beforeW0) / hs_select(vec4(1.0), w0 - beforeW0, cut0);
  HS_HIGHP vec4 t1 = (near - beforeW1) / hs_select(vec4(1.0), w1 - beforeW1, cut1);
  HS_HIGHP vec4 cutX0 = mix(vec4(x1.w, x0.xyz), x0, t0), cutX1 = mix(vec4(x0.w, x1.xyz), x1, t1);
  HS_HIGHP vec4 cutY0 = mix(vec4(y1.w, y0.xyz), y0, t0), cutY1 = mix(vec4(y0.w, y1.xyz), y1, t1);
  hs_project(x0, y0, w0, foot, scale, near);
  hs_project(x1, y1, w1, foot, scale, near);
  hs_project(cutX0, cutY0, vec4(near), foot, scale, near);
  hs_project(cutX1, cutY1, vec4(near), foot, scale, near);
  // What is cut away before the first point that stays becomes that point: found by going backwards.
  HS_HIGHP vec2 last = hs_keepBackwards(vec2(0.0), x1, y1, in1, cutX1, cutY1, cut1);
  last = hs_keepBackwards(last, x0, y0, in0, cutX0, cutY0, cut0);
  HS_HIGHP vec4 px0, py0, px1, py1, px2, py2, px3, py3;
  hs_keepForwards(last, x0.xy, y0.xy, in0.xy, cutX0.xy, cutY0.xy, cut0.xy, px0, py0);
  hs_keepForwards(last, x0.zw, y0.zw, in0.zw, cutX0.zw, cutY0.zw, cut0.zw, px1, py1);
  hs_keepForwards(last, x1.xy, y1.xy, in1.xy, cutX1.xy, cutY1.xy, cut1.xy, px2, py2);
  hs_keepForwards(last, x1.zw, y1.zw, in1.zw, cutX1.zw, cutY1.zw, cut1.zw, px3, py3);
  return hs_edgeIntegrals(px0, py0, vec4(px0.yzw, px1.x), vec4(py0.yzw, py1.x)) +
         hs_edgeIntegrals(px1, py1, vec4(px1.yzw, px2.x), vec4(py1.yzw, py2.x)) +
         hs_edgeIntegrals(px2, py2, vec4(px2.yzw, px3.x), vec4(py2.yzw, py3.x)) +
         hs_edgeIntegrals(px3, py3, vec4(px3.yzw, px0.x), vec4(py3.yzw, py0.x));
}
#else
HS_HIGHP float hs_polygonIntegral(HS_HIGHP vec4 x0, HS_HIGHP vec4 x1, HS_HIGHP vec4 y0, HS_HIGHP vec4 y1,
                                  HS_HIGHP vec4 w0, HS_HIGHP vec4 w1, HS_HIGHP vec2 foot, HS_HIGHP float scale,
                                  HS_HIGHP float near) {
  hs_project(x0, y0, w0, foot, scale, near);
  hs_project(x1, y1, w1, foot, scale, near);
  return hs_edgeIntegrals(x0, y0, vec4(x0.yzw, x1.x), vec4(y0.yzw, y1.x)) +
         hs_edgeIntegrals(x1, y1, vec4(x1.yzw, x0.x), vec4(y1.yzw, y0.x));
}
#endif
