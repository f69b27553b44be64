// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Coverage of the cells of the square [-1, 1]² by one edge of a closed loop: the integral of x dy inside each
// cell, with x counted from the cell's left side and limited to its width. Summed over a counter-clockwise loop
// it is the covered share of the cell, exactly: no light-centre bit, no quadrant signs, no repair of wraps.
#if defined(HS_CASTING_RECEIVER) || defined(HS_AMONG_RECEIVERS)
#define HS_CUTS  // edges may pass the receiver's height
#endif
#ifdef HS_NO_HIGHP
#define HS_FLAT 0.002
#define HS_STEEP 0.03
#else
#define HS_FLAT 1e-6
#define HS_STEEP 0.001
#endif

// The part of an edge that lies in a row: x from x0 to x1 (cell widths), `rows` its height, `inverseSlope` =
// dy / dx of the edge. Written so that nothing cancels where x stays on one side of the cell.
HS_HIGHP vec4 hs_rowCoverage(HS_HIGHP vec4 x0, HS_HIGHP vec4 x1, HS_HIGHP vec4 rows,
                             HS_HIGHP float inverseSlope) {
  HS_HIGHP vec4 c0 = clamp(x0, 0.0, 1.0), c1 = clamp(x1, 0.0, 1.0);
  return c1 * rows + (c1 - c0) * (x0 - 0.5 * (c0 + c1)) * inverseSlope;
}

#if HS_CELLS == 32
struct HS_Cells {
  HS_HIGHP vec4 lower, upper;  // four cells each, left to right
};
#define HS_CELLS_ALL(value) HS_Cells(vec4(value), vec4(value))
#elif HS_CELLS == 16
#define HS_Cells HS_HIGHP vec4  // lower left, lower right, upper left, upper right
#define HS_CELLS_ALL(value) vec4(value)
#else
#define HS_Cells HS_HIGHP vec4  // x: the whole square
#define HS_CELLS_ALL(value) vec4(value)
#endif

// dx / dy and dy / dx of an edge. Edges steeper than HS_STEEP lean by that much, since their quotient would cancel: half of
// it is the largest error.
void hs_leanOfEdge(HS_HIGHP vec2 edge, out HS_HIGHP float slope, out HS_HIGHP float inverseSlope) {
  slope = edge.x / (abs(edge.y) < HS_FLAT ? HS_FLAT : edge.y);
  slope = slope < 0.0 ? min(slope, -HS_STEEP) : max(slope, HS_STEEP);
  inverseSlope = 1.0 / slope;
}

// Adds the edge from a to b.
void hs_addEdge(inout HS_Cells cells, HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  HS_HIGHP float slope, inverseSlope;
  hs_leanOfEdge(b - a, slope, inverseSlope);
#ifdef HS_NO_HIGHP
  // From the nearer end: the other may be very far away.
  HS_HIGHP vec2 near = dot(abs(a), vec2(1.0)) < dot(abs(b), vec2(1.0)) ? a : b;
#else
  HS_HIGHP vec2 near = abs(a.y) < abs(b.y) ? a : b;
#endif
#if HS_CELLS == 4
  HS_HIGHP vec2 y = clamp(vec2(a.y, b.y), -1.0, 1.0);
  HS_HIGHP vec2 x = 0.5 * (near.x + (y - near.y) * slope) + 0.5;
  cells.x += 0.5 * hs_rowCoverage(vec4(x.x), vec4(x.y), vec4(y.y - y.x), 2.0 * inverseSlope).x;
#else
  HS_HIGHP vec4 y = clamp(vec4(a.y, b.y, a.y, b.y), vec4(-1.0, -1.0, 0.0, 0.0), vec4(0.0, 0.0, 1.0, 1.0));
  HS_HIGHP vec4 x = near.x + (y - near.y) * slope;
#if HS_CELLS == 16
  const vec4 left = vec4(1.0, 0.0, 1.0, 0.0);
  cells += hs_rowCoverage(x.xxzz + left, x.yyww + left, (y - y.xxzz).yyww, inverseSlope);
#else
  const vec4 left = vec4(2.0, 1.0, 0.0, -1.0);
  inverseSlope *= 0.5;
  cells.lower += hs_rowCoverage(2.0 * x.x + left, 2.0 * x.y + left, vec4(y.y - y.x), inverseSlope);
  cells.upper += hs_rowCoverage(2.0 * x.z + left, 2.0 * x.w + left, vec4(y.w - y.z), inverseSlope);
#endif
#endif
}

#ifdef HS_CUTS
// 1: a chord between two points far outside the square passes it on the right.
HS_HIGHP float hs_passesRight(HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  HS_HIGHP float run = b.y - a.y;
  return step(0.0, a.x - a.y * (b.x - a.x) / (abs(run) < HS_FLAT ? HS_FLAT : run));
}
// Adds such a chord: on the left it covers nothing, on the right the rows whole.
void hs_addFarChord(inout HS_Cells cells, HS_HIGHP vec2 a, HS_HIGHP vec2 b, HS_HIGHP float weight) {
  HS_HIGHP float right = weight * hs_passesRight(a, b);
#if HS_CELLS == 4
  cells.x += right * 0.5 * (clamp(b.y, -1.0, 1.0) - clamp(a.y, -1.0, 1.0));
#else
  const vec2 low = vec2(-1.0, 0.0), high = vec2(0.0, 1.0);
  HS_HIGHP vec2 rows = right * (clamp(b.yy, low, high) - clamp(a.yy, low, high));
#if HS_CELLS == 16
  cells += rows.xxyy;
#else
  cells.lower += rows.x;
  cells.upper += rows.y;
#endif
#endif
}

#ifdef HS_ONE_SIDED
// covered += part; parts of a one-sided loop are collected, and count where their sum is positive once it closes, if
// `counts` is 1.
void hs_addPart(inout HS_Cells covered, inout HS_Cells loop, HS_Cells part, HS_HIGHP float oneSided,
                HS_HIGHP float closes, HS_HIGHP float counts) {
  HS_HIGHP float others = 1.0 - oneSided, open = 1.0 - closes;
#if HS_CELLS == 32
  loop.lower += part.lower * oneSided;
  loop.upper += part.upper * oneSided;
  covered.lower += part.lower * others + max(loop.lower, 0.0) * (closes * counts);
  covered.upper += part.upper * others + max(loop.upper, 0.0) * (closes * counts);
  loop.lower *= open;
  loop.upper *= open;
#else
  loop += part * oneSided;
  covered += part * others + max(loop, 0.0) * (closes * counts);
  loop *= open;
#endif
}
#endif
#endif

// visible *= 1 - covered where `fold` is 1; covered is emptied there.
void hs_foldCaster(inout HS_Cells visible, inout HS_Cells covered, HS_HIGHP float fold) {
#if HS_CELLS == 32
  visible.lower *= 1.0 - fold * clamp(covered.lower, 0.0, 1.0);
  visible.upper *= 1.0 - fold * clamp(covered.upper, 0.0, 1.0);
  covered.lower *= 1.0 - fold;
  covered.upper *= 1.0 - fold;
#else
  visible *= 1.0 - fold * clamp(covered, 0.0, 1.0);
  covered *= 1.0 - fold;
#endif
}

#ifdef HS_SIDES
// Before a caster is folded: of a sheet's two sides the one that covers more counts. `other` keeps the first.
void hs_joinSides(inout HS_Cells covered, inout HS_Cells other, HS_HIGHP float fold, HS_HIGHP float firstSide) {
#if HS_CELLS == 32
  covered.lower = mix(covered.lower, max(covered.lower, other.lower), fold);
  covered.upper = mix(covered.upper, max(covered.upper, other.upper), fold);
  other.lower = mix(other.lower * (1.0 - fold), covered.lower, firstSide);
  other.upper = mix(other.upper * (1.0 - fold), covered.upper, firstSide);
  covered.lower *= 1.0 - firstSide;
  covered.upper *= 1.0 - firstSide;
#else
  covered = mix(covered, max(covered, other), fold);
  other = mix(other * (1.0 - fold), covered, firstSide);
  covered *= 1.0 - firstSide;
#endif
}
#endif

#ifdef HS_TREES
// visible *= left where `fold` is 1. `left`: lower left, lower right, upper left, upper right.
void hs_foldQuarters(inout HS_Cells visible, HS_HIGHP vec4 left, HS_HIGHP float fold) {
  left = mix(vec4(1.0), left, fold);
#if HS_CELLS == 32
  visible.lower *= left.xxyy;
  visible.upper *= left.zzww;
#elif HS_CELLS == 16
  visible *= left;
#else
  visible *= dot(left, vec4(0.25));
#endif
}
#endif

// Visible share of the square; all cells become visible again where `take` is 1.
HS_HIGHP float hs_takeSquare(inout HS_Cells visible, HS_HIGHP float take) {
#if HS_CELLS == 32
  HS_HIGHP float share = dot(visible.lower + visible.upper, vec4(0.125));
  visible.lower = mix(visible.lower, vec4(1.0), take);
  visible.upper = mix(visible.upper, vec4(1.0), take);
#elif HS_CELLS == 16
  HS_HIGHP float share = dot(visible, vec4(0.25));
  visible = mix(visible, vec4(1.0), take);
#else
  HS_HIGHP float share = visible.x;
  visible = mix(visible, vec4(1.0), take);
#endif
  return share * take;
}
