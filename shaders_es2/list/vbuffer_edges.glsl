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
// HS_HALF 0, HS_HALF 1: the lower or the upper row alone, for devices that have no room for both.
#ifdef HS_HALF
#define HS_Quads vec2    // one number a quadrant
#define HS_Rows float    // one number a row
#define HS_RowEnds vec2  // two numbers a row
#define hs_firstOf(ends) (ends).x
#define hs_secondOf(ends) (ends).y
#define hs_byRow(rows) vec2(rows)
#define hs_byColumn(columns) (columns)
#define HS_RIGHT vec2(1.0, 0.0)
#define HS_UP vec2(1.0 - float(HS_HALF))
#define HS_ROW_LOW vec2(float(HS_HALF) - 1.0)
#define HS_ROW_HIGH vec2(float(HS_HALF))
#else
#define HS_Quads vec4
#define HS_Rows vec2
#define HS_RowEnds vec4
#define hs_firstOf(ends) (ends).xz
#define hs_secondOf(ends) (ends).yw
#define hs_byRow(rows) (rows).xxyy
#define hs_byColumn(columns) (columns).xyxy
#define HS_RIGHT vec4(1.0, 0.0, 1.0, 0.0)
#define HS_UP vec4(1.0, 1.0, 0.0, 0.0)
#define HS_ROW_LOW vec4(-1.0, -1.0, 0.0, 0.0)
#define HS_ROW_HIGH vec4(0.0, 0.0, 1.0, 1.0)
#endif
struct HS_Sums {
  HS_HIGHP HS_Quads share;
  HS_HIGHP HS_RowEnds reachX;  // largest x and -x of the edges in each row
  HS_HIGHP vec4 reachY;        // largest y and -y in the left half, then in the right half
#ifdef HS_CENTRES
  HS_HIGHP HS_Quads momentX, momentY;  // integrals of x and y over what is occluded
#endif
#if defined(HS_HALF) && defined(HS_ONE_SIDED)
  HS_HIGHP float whole;  // of the whole light: its sign tells the way round
#endif
};
struct HS_Occlusion {
  HS_HIGHP HS_Quads share;
  HS_HIGHP HS_Quads left, right, bottom, top;
#ifdef HS_CENTRES
  HS_HIGHP HS_Quads centreX, centreY;
#endif
};

HS_Occlusion hs_nothing() {
  HS_Occlusion q;
  q.share = q.right = q.top = HS_Quads(0.0);
  q.left = q.bottom = HS_Quads(1.0);
#ifdef HS_CENTRES
  q.centreX = q.centreY = HS_Quads(0.5);
#endif
  return q;
}

void hs_clearSums(out HS_Sums sums) {
  sums.share = HS_Quads(0.0);
  sums.reachX = HS_RowEnds(-2.0);
  sums.reachY = vec4(-2.0);
#ifdef HS_CENTRES
  sums.momentX = sums.momentY = HS_Quads(0.0);
#endif
#if defined(HS_HALF) && defined(HS_ONE_SIDED)
  sums.whole = 0.0;
#endif
}

#ifdef HS_ONE_SIDED
HS_HIGHP float hs_wayRound(HS_Sums sums) {
#ifdef HS_HALF
  return sums.whole;
#else
  return dot(sums.share, vec4(1.0));
#endif
}
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
// Whether what casters before hid, or this one covers, leaves nothing.
#define HS_Left HS_Occlusion
#define HS_Covered HS_Sums
#define hs_addTreeEdge hs_addEdge
bool hs_hidesAll(HS_Occlusion before, HS_Sums sums) {
  return all(greaterThanEqual(max(before.share, sums.share), HS_Quads(1.0)));
}
#endif

// Means of c = clamp(x, 0, 1) and of c² / 2 while x runs evenly from x0 to x1. Short runs and runs outside
// take the middle: there the quotient would cancel.
#ifdef HS_CENTRES
void hs_clampedMeans(HS_HIGHP HS_Quads x0, HS_HIGHP HS_Quads x1, out HS_HIGHP HS_Quads mean, out HS_HIGHP HS_Quads moment) {
#else
void hs_clampedMeans(HS_HIGHP HS_Quads x0, HS_HIGHP HS_Quads x1, out HS_HIGHP HS_Quads mean) {
#endif
  HS_HIGHP HS_Quads c0 = clamp(x0, 0.0, 1.0), c1 = clamp(x1, 0.0, 1.0);
  HS_HIGHP HS_Quads run = x1 - x0, change = c1 - c0, middle = 0.5 * (c0 + c1);
  HS_HIGHP HS_Quads isShort = max(step(abs(run), HS_Quads(HS_SHORT)), step(abs(change), HS_Quads(1e-6)));
  HS_HIGHP HS_Quads inverse = 1.0 / mix(run, HS_Quads(1.0), isShort);
  HS_HIGHP HS_Quads past0 = (x0 - c0) * c0, past1 = (x1 - c1) * c1;
  mean = mix((middle * change + past1 - past0) * inverse, middle, isShort);
#ifdef HS_CENTRES
  HS_HIGHP HS_Quads squares = (c0 * c0 + c0 * c1 + c1 * c1) * (1.0 / 6.0);
  moment = mix((squares * change + 0.5 * (past1 * c1 - past0 * c0)) * inverse, squares, isShort);
#endif
}

// Largest and negated smallest of the ends of two parts, where `length` says that there is a part.
HS_HIGHP vec4 hs_reach(HS_HIGHP vec4 ends, HS_HIGHP vec2 length) {
  HS_HIGHP vec4 reach = vec4(max(ends.xz, ends.yw), -min(ends.xz, ends.yw)).xzyw;
  return mix(vec4(-2.0), reach, step(vec4(1e-6), abs(length.xxyy)));
}

#ifdef HS_HALF
HS_HIGHP vec2 hs_reach(HS_HIGHP vec2 ends, HS_HIGHP float length) {
  return abs(length) < 1e-6 ? vec2(-2.0) : vec2(max(ends.x, ends.y), -min(ends.x, ends.y));
}
#endif

// The same for the whole light, and only the share.
HS_HIGHP float hs_edgeShare(HS_HIGHP vec2 a, HS_HIGHP vec2 b);

void hs_addEdge(inout HS_Sums sums, HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  HS_HIGHP vec2 edge = b - a;
  edge = mix(vec2(HS_LEVEL), edge, step(vec2(HS_LEVEL), abs(edge)));
  // From the nearer end: the other may be very far away.
  HS_HIGHP vec2 near = dot(abs(a), vec2(1.0)) < dot(abs(b), vec2(1.0)) ? a : b;

#ifdef HS_HALF
  HS_HIGHP vec2 rowY = clamp(vec2(a.y, b.y), HS_ROW_LOW, HS_ROW_HIGH);
#else
  HS_HIGHP vec4 rowY = clamp(vec4(a.y, b.y, a.y, b.y), HS_ROW_LOW, HS_ROW_HIGH);
#endif
  HS_HIGHP HS_RowEnds rowX = near.x + (rowY - near.y) * (edge.x / edge.y);
  HS_HIGHP HS_Rows rows = hs_secondOf(rowY) - hs_firstOf(rowY);
  HS_HIGHP HS_Quads mean;
  HS_HIGHP HS_Quads from = hs_byRow(hs_firstOf(rowX)) + HS_RIGHT, to = hs_byRow(hs_secondOf(rowX)) + HS_RIGHT;
#ifdef HS_CENTRES
  HS_HIGHP HS_Quads moment;
  hs_clampedMeans(from, to, mean, moment);
  sums.momentX += hs_byRow(rows) * moment;
#else
  hs_clampedMeans(from, to, mean);
#endif
  sums.share += hs_byRow(rows) * mean;
  sums.reachX = max(sums.reachX, hs_reach(rowX, rows));

  HS_HIGHP vec4 x = clamp(vec4(a.x, b.x, a.x, b.x), vec4(-1.0, -1.0, 0.0, 0.0), vec4(0.0, 0.0, 1.0, 1.0));
  HS_HIGHP vec4 y = near.y + (x - near.x) * (edge.y / edge.x);
  HS_HIGHP vec2 columns = x.yw - x.xz;
#ifdef HS_CENTRES
  hs_clampedMeans(hs_byColumn(y.xz) + HS_UP, hs_byColumn(y.yw) + HS_UP, mean, moment);
  sums.momentY -= hs_byColumn(columns) * moment;
#endif
  sums.reachY = max(sums.reachY, hs_reach(y, columns));
#if defined(HS_HALF) && defined(HS_ONE_SIDED)
  sums.whole += hs_edgeShare(a, b);
#endif
}

#ifdef HS_CUTS
// The same for a chord between two points far outside the light, which passes it on one side.
void hs_addFarChord(inout HS_Sums sums, HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  HS_HIGHP vec2 edge = b - a;
  edge = mix(vec2(HS_LEVEL), edge, step(vec2(HS_LEVEL), abs(edge)));
  // Where it meets the axes: on the right of the light or not, above it or not.
  HS_HIGHP vec2 sides = step(vec2(0.0), a - a.yx * edge / edge.yx);
  const vec2 low = vec2(-1.0, 0.0), high = vec2(0.0, 1.0);
#ifdef HS_HALF
  HS_HIGHP float rows = clamp(b.y, HS_ROW_LOW.x, HS_ROW_HIGH.x) - clamp(a.y, HS_ROW_LOW.x, HS_ROW_HIGH.x);
#else
  HS_HIGHP vec2 rows = clamp(b.yy, low, high) - clamp(a.yy, low, high);
#endif
  HS_HIGHP vec2 columns = clamp(b.xx, low, high) - clamp(a.xx, low, high);
  sums.share += sides.x * hs_byRow(rows);
#ifdef HS_CENTRES
  sums.momentX += 0.5 * sides.x * hs_byRow(rows);
  sums.momentY -= 0.5 * sides.y * hs_byColumn(columns);
#endif
  HS_HIGHP vec2 ends = 4.0 * sides - 2.0;
  sums.reachX = max(sums.reachX, hs_reach(HS_RowEnds(ends.x), rows));
  sums.reachY = max(sums.reachY, hs_reach(vec4(ends.y), columns));
#if defined(HS_HALF) && defined(HS_ONE_SIDED)
  sums.whole += 0.25 * (2.0 * sides.x - 1.0) * (clamp(b.y, -1.0, 1.0) - clamp(a.y, -1.0, 1.0));
#endif
}
#ifdef HS_TREES
void hs_addTreeChord(inout HS_Sums sums, HS_HIGHP vec2 a, HS_HIGHP vec2 b, HS_HIGHP float weight) {
  hs_addFarChord(sums, a, mix(a, b, weight));
}
#endif
#endif

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
  HS_Occlusion q;
  q.share = clamp(sums.share, 0.0, 1.0);
  // What misses a quadrant must not widen its rectangle: it becomes empty, from 1 to 0.
  HS_HIGHP HS_Quads some = step(HS_NOTHING, q.share);
  q.left = max(clamp(HS_RIGHT - hs_byRow(hs_secondOf(sums.reachX)), 0.0, 1.0), 1.0 - some);
  q.right = some * clamp(HS_RIGHT + hs_byRow(hs_firstOf(sums.reachX)), 0.0, 1.0);
  q.bottom = max(clamp(HS_UP - hs_byColumn(sums.reachY.yw), 0.0, 1.0), 1.0 - some);
  q.top = some * clamp(HS_UP + hs_byColumn(sums.reachY.xz), 0.0, 1.0);
#ifdef HS_CENTRES
  HS_HIGHP HS_Quads divisor = max(q.share, 1e-3);
  q.centreX = clamp(sums.momentX / divisor, q.left, max(q.left, q.right));
  q.centreY = clamp(sums.momentY / divisor, q.bottom, max(q.bottom, q.top));
#endif
  return q;
}
