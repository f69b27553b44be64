// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Coverage of sixteen cells of the whole light, four rows of four, by the facets of a tree: one walk serves all sub-lights.
// As in cell_coverage.glsl and cell_walk.glsl, which it needs.
#if defined(HS_TREES) && defined(HS_CUTS)
struct HS_Grid {
  HS_HIGHP vec4 a, b, c, d;  // rows from the lowest, cells from left to right
};
const HS_HIGHP vec4 HS_ROW_LOW = vec4(-2.0, -1.0, 0.0, 1.0);  // in widths of a cell
const HS_HIGHP vec4 HS_ROW_HIGH = vec4(-1.0, 0.0, 1.0, 2.0);

HS_Grid hs_grid(HS_HIGHP float value) { return HS_Grid(vec4(value), vec4(value), vec4(value), vec4(value)); }

void hs_addGridEdge(inout HS_Grid cells, HS_HIGHP vec2 a, HS_HIGHP vec2 b) {
  a *= 2.0;
  b *= 2.0;
  HS_HIGHP float slope, inverseSlope;
  hs_leanOfEdge(b - a, slope, inverseSlope);
  HS_HIGHP vec2 near = abs(a.y) < abs(b.y) ? a : b;
  HS_HIGHP vec4 from = clamp(vec4(a.y), HS_ROW_LOW, HS_ROW_HIGH), to = clamp(vec4(b.y), HS_ROW_LOW, HS_ROW_HIGH);
  HS_HIGHP vec4 x0 = near.x + (from - near.y) * slope, x1 = near.x + (to - near.y) * slope, rows = to - from;
  const HS_HIGHP vec4 left = vec4(2.0, 1.0, 0.0, -1.0);
  cells.a += hs_rowCoverage(x0.x + left, x1.x + left, rows.xxxx, inverseSlope);
  cells.b += hs_rowCoverage(x0.y + left, x1.y + left, rows.yyyy, inverseSlope);
  cells.c += hs_rowCoverage(x0.z + left, x1.z + left, rows.zzzz, inverseSlope);
  cells.d += hs_rowCoverage(x0.w + left, x1.w + left, rows.wwww, inverseSlope);
}

// Between two points far outside the light.
void hs_addGridChord(inout HS_Grid cells, HS_HIGHP vec2 a, HS_HIGHP vec2 b, HS_HIGHP float weight) {
  HS_HIGHP float right = weight * hs_passesRight(a, b);
  HS_HIGHP vec4 rows = right * (clamp(vec4(2.0 * b.y), HS_ROW_LOW, HS_ROW_HIGH) -
                                clamp(vec4(2.0 * a.y), HS_ROW_LOW, HS_ROW_HIGH));
  cells.a += rows.x;
  cells.b += rows.y;
  cells.c += rows.z;
  cells.d += rows.w;
}

// Of the other sub-lights nothing.
HS_Grid hs_ofSubLights(HS_Grid left, HS_HIGHP vec4 subLights) {
  HS_HIGHP vec4 lower = subLights.xxyy, upper = subLights.zzww;
  return HS_Grid(left.a * lower, left.b * lower, left.c * upper, left.d * upper);
}

// left *= 1 - covered, of sub-lights whose bit is 1.
void hs_foldGrid(inout HS_Grid left, HS_Grid covered, HS_HIGHP vec4 subLights) {
  left.a *= 1.0 - clamp(covered.a, 0.0, 1.0) * subLights.xxyy;
  left.b *= 1.0 - clamp(covered.b, 0.0, 1.0) * subLights.xxyy;
  left.c *= 1.0 - clamp(covered.c, 0.0, 1.0) * subLights.zzww;
  left.d *= 1.0 - clamp(covered.d, 0.0, 1.0) * subLights.zzww;
}

#ifdef HS_SIDES
// As hs_joinSides().
void hs_joinGrids(inout HS_Grid covered, inout HS_Grid other, HS_HIGHP float ends, HS_HIGHP float firstSide) {
  if (ends < 0.5) return;
  covered = HS_Grid(max(covered.a, other.a), max(covered.b, other.b), max(covered.c, other.c), max(covered.d, other.d));
  other = hs_grid(0.0);
  if (firstSide < 0.5) return;
  other = covered;
  covered = hs_grid(0.0);
}
#endif

// Means of the quarters of the light, in the order of sub-lights.
HS_HIGHP vec4 hs_quartersOf(HS_Grid grid) {
  HS_HIGHP vec4 lower = grid.a + grid.b, upper = grid.c + grid.d;
  return 0.25 * vec4(lower.xz + lower.yw, upper.xz + upper.yw);
}
// What foldQuarters() takes, of the sub-light on that side.
HS_HIGHP vec4 hs_cellsOfSide(HS_Grid grid, HS_HIGHP vec2 side) {
#ifdef HS_WHOLE_LIGHT
  return hs_quartersOf(grid);
#else
  HS_HIGHP vec4 low = side.y > 0.0 ? grid.c : grid.a, high = side.y > 0.0 ? grid.d : grid.b;
  return side.x > 0.0 ? vec4(low.zw, high.zw) : vec4(low.xy, high.xy);
#endif
}

// Whether no cell has more to lose than a picture shows.
bool hs_hidesAll(HS_Grid left, HS_Grid covered) {
  HS_HIGHP vec4 most = max(max(left.a * (1.0 - covered.a), left.b * (1.0 - covered.b)),
                           max(left.c * (1.0 - covered.c), left.d * (1.0 - covered.d)));
  return max(max(most.x, most.y), max(most.z, most.w)) < 0.002;
}
#define HS_Left HS_Grid
#define HS_Covered HS_Grid
#define hs_addTreeEdge hs_addGridEdge
#define hs_addTreeChord hs_addGridChord
#endif
