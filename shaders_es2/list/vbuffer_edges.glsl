// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What one caster occludes of each quadrant of the light: share, bounding rectangle, centre of gravity; added up
// over the edges of its projected loops, in any order. Quadrants: lower left, lower right, upper left, upper
// right, each with its own lower left corner at (0, 0) and its upper right corner at (1, 1).
// Based on: Forest, Barthe, Paulin, "Realistic Soft Shadows by Penumbra-Wedges Blending", 2006, section 4.3,
// with areas integrated along the light's axes instead of around its centre: no light-centre bit, no repair.
#if defined(HS_CASTING_RECEIVER) || defined(HS_AMONG_RECEIVERS)
#define HS_CUTS  // edges may pass the receiver's height
#endif
#ifdef HS_NO_HIGHP
#define HS_LEVEL 2e-3
#define HS_SHORT 0.03
#define HS_NOTHING 4e-3
#else
#define HS_LEVEL 1e-6
#define HS_SHORT 2e-3
#define HS_NOTHING 1e-4
#endif
struct HS_Sums {
  HS_HIGHP vec4 share;
  HS_HIGHP vec4 reachX;  // largest x and -x of the edges in the lower half, then in the upper half
  HS_HIGHP vec4 reachY;  // largest y and -y in the left half, then in the right half
#ifdef HS_CENTRES
  HS_HIGHP vec4 momentX, momentY;  // integrals of x and y over what is occluded
#endif
};
struct HS_Occlusion {
  HS_HIGHP vec4 share;
  HS_HIGHP vec4 left, right, bottom, top;
#ifdef HS_CENTRES
  HS_HIGHP vec4 centreX, centreY;
#endif
};

HS_Occlusion hs_nothing() {
  HS_Occlusion q;
  q.share = q.right = q.top = vec4(0.0);
  q.left = q.bottom = vec4(1.0);
#ifdef HS_CENTRES
  q.centreX = q.centreY = vec4(0.5);
#endif
  return q;
}

void hs_clearSums(out HS_Sums sums) {
  sums.share = vec4(0.0);
  sums.reachX = sums.reachY = vec4(-2.0);
#ifdef HS_CENTRES
  sums.momentX = sums.momentY = vec4(0.0);
#endif
}

#ifdef HS_ONE_SIDED
void hs_addSums(inout HS_Sums sums, HS_Sums others) {
  sums.share += others.share;
  sums.reachX = max(sums.reachX, others.reachX);
  sums.reachY = max(sums.reachY, others.reachY);
#ifdef HS_CENTRES
  sums.momentX += others.momentX;
  sums.momentY += others.momentY;
#endif
}
#endif

#ifdef HS_TREES
#define HS_Left float
#define HS_Covered HS_Sums
bool hs_hidesAll(float left, HS_Sums sums) { return min(min(sums.share.x, sums.share.y), min(sums.share.z, sums.share.w)) >= 1.0; }
#endif

// Means of c = clamp(x, 0, 1) and of c² / 2 while x runs evenly from x0 to x1. Short runs and runs outside
// take the middle: there the quotient would cancel.
#ifdef HS_CENTRES
void hs_clampedMeans(HS_HIGHP vec4 x0, HS_HIGHP vec4 x1, out HS_HIGHP vec4 mean, out HS_HIGHP vec4 moment) {
#else
void hs_clampedMeans(HS_HIGHP vec4 x0, HS_HIGHP vec4 x1, out HS_HIGHP vec4 mean) {
#endif
  HS_HIGHP vec4 c0 = clamp(x0, 0.0, 1.0), c1 = clamp(x1, 0.0, 1.0);
  HS_HIGHP vec4 run = x1 - x0, change = c1 - c0, middle = 0.5 * (c0 + c1);
  HS_HIGHP vec4 isShort = max(step(abs(run), vec4(HS_SHORT)), step(abs(change), vec4(1e-6)));
  HS_HIGHP vec4 inverse = 1.0 / mix(run, vec4(1.0), isShort);
  HS_HIGHP vec4 past0 = (x0 - c0) * c0, past1 = (x1 - c1) * c1;
  mean = mix((middle * change + past1 - past0) * inverse, middle, isShort);
#ifdef HS_CENTRES
  HS_HIGHP vec4 squares = (c0 * c0 + c0 * c1 + c1 * c1) * (1.0 / 6.0);
  moment = mix((squares * change + 0.5 * (past1 * c1 - past0 * c0)) * inverse, squares, isShort);
#endif
}

// Largest and negated smallest of the ends of two parts, where `length` says that there is a part.
HS_HIGHP vec4 hs_reach(HS_HIGHP vec4 ends, HS_HIGHP vec2 length) {
  HS_HIGHP vec4 reach = vec4(max(ends.xz, ends.yw), -min(ends.xz, ends.yw)).xzyw;
  return mix(vec4(-2.0), reach, step(vec4(1e-6), abs(length.xxyy)));
}

void hs_addEdge(inout HS_Sums sums, HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  const vec4 low = vec4(-1.0, -1.0, 0.0, 0.0), high = vec4(0.0, 0.0, 1.0, 1.0);
  HS_HIGHP vec2 edge = b - a;
  edge = mix(vec2(HS_LEVEL), edge, step(vec2(HS_LEVEL), abs(edge)));
  // From the nearer end: the other may be very far away.
  HS_HIGHP vec2 near = dot(abs(a), vec2(1.0)) < dot(abs(b), vec2(1.0)) ? a : b;

  HS_HIGHP vec4 y = clamp(vec4(a.y, b.y, a.y, b.y), low, high);
  HS_HIGHP vec4 x = near.x + (y - near.y) * (edge.x / edge.y);
  HS_HIGHP vec2 rows = y.yw - y.xz;
  HS_HIGHP vec4 mean;
  const vec4 right = vec4(1.0, 0.0, 1.0, 0.0), up = vec4(1.0, 1.0, 0.0, 0.0);
#ifdef HS_CENTRES
  HS_HIGHP vec4 moment;
  hs_clampedMeans(x.xxzz + right, x.yyww + right, mean, moment);
  sums.momentX += rows.xxyy * moment;
#else
  hs_clampedMeans(x.xxzz + right, x.yyww + right, mean);
#endif
  sums.share += rows.xxyy * mean;
  sums.reachX = max(sums.reachX, hs_reach(x, rows));

  x = clamp(vec4(a.x, b.x, a.x, b.x), low, high);
  y = near.y + (x - near.x) * (edge.y / edge.x);
  HS_HIGHP vec2 columns = x.yw - x.xz;
#ifdef HS_CENTRES
  hs_clampedMeans(y.xzxz + up, y.ywyw + up, mean, moment);
  sums.momentY -= columns.xyxy * moment;
#endif
  sums.reachY = max(sums.reachY, hs_reach(y, columns));
}

#ifdef HS_CUTS
// The same for a chord between two points far outside the light, which passes it on one side.
void hs_addFarChord(inout HS_Sums sums, HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  const vec2 low = vec2(-1.0, 0.0), high = vec2(0.0, 1.0);
  HS_HIGHP vec2 edge = b - a;
  edge = mix(vec2(HS_LEVEL), edge, step(vec2(HS_LEVEL), abs(edge)));
  // Where it meets the axes: on the right of the light or not, above it or not.
  HS_HIGHP vec2 sides = step(vec2(0.0), a - a.yx * edge / edge.yx);
  HS_HIGHP vec2 rows = clamp(b.yy, low, high) - clamp(a.yy, low, high);
  HS_HIGHP vec2 columns = clamp(b.xx, low, high) - clamp(a.xx, low, high);
  sums.share += sides.x * rows.xxyy;
#ifdef HS_CENTRES
  sums.momentX += 0.5 * sides.x * rows.xxyy;
  sums.momentY -= 0.5 * sides.y * columns.xyxy;
#endif
  HS_HIGHP vec4 ends = 4.0 * sides.xxyy - 2.0;
  sums.reachX = max(sums.reachX, hs_reach(ends.xxxx, rows));
  sums.reachY = max(sums.reachY, hs_reach(ends.zzzz, columns));
}
#endif

// The same for the whole light, and only the share.
HS_HIGHP float hs_edgeShare(HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  HS_HIGHP vec2 edge = b - a;
  HS_HIGHP float slope = edge.x / (abs(edge.y) < HS_LEVEL ? HS_LEVEL : edge.y);
  HS_HIGHP vec2 near = dot(abs(a), vec2(1.0)) < dot(abs(b), vec2(1.0)) ? a : b;
  HS_HIGHP vec2 y = clamp(vec2(a.y, b.y), -1.0, 1.0);
  HS_HIGHP vec2 x = near.x + (y - near.y) * slope;
  HS_HIGHP vec2 c = clamp(x, -1.0, 1.0);
  HS_HIGHP vec2 past = (x - c) * c;
  HS_HIGHP float run = x.y - x.x, change = c.y - c.x, middle = 0.5 * (c.x + c.y);
  bool isShort = abs(run) < HS_SHORT || abs(change) < 1e-6;
  HS_HIGHP float mean = isShort ? middle : (middle * change + past.y - past.x) / run;
  return 0.25 * (y.y - y.x) * mean;
}

HS_Occlusion hs_occlusion(HS_Sums sums) {
  const vec4 right = vec4(1.0, 0.0, 1.0, 0.0), up = vec4(1.0, 1.0, 0.0, 0.0);
  HS_Occlusion q;
  q.share = clamp(sums.share, 0.0, 1.0);
  // What misses a quadrant must not widen its rectangle: it becomes empty, from 1 to 0.
  HS_HIGHP vec4 some = step(HS_NOTHING, q.share);
  q.left = max(clamp(right - sums.reachX.yyww, 0.0, 1.0), 1.0 - some);
  q.right = some * clamp(right + sums.reachX.xxzz, 0.0, 1.0);
  q.bottom = max(clamp(up - sums.reachY.ywyw, 0.0, 1.0), 1.0 - some);
  q.top = some * clamp(up + sums.reachY.xzxz, 0.0, 1.0);
#ifdef HS_CENTRES
  HS_HIGHP vec4 divisor = max(q.share, 1e-3);
  q.centreX = clamp(sums.momentX / divisor, q.left, max(q.left, q.right));
  q.centreY = clamp(sums.momentY / divisor, q.bottom, max(q.bottom, q.top));
#endif
  return q;
}
