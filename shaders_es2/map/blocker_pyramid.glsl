// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean gap to the casters over a region of the map, from an atlas of levels of cells that hold an occupied share and
// a mean depth: the finest level at the left, the others stacked at its right. Needs occupancy_storage.glsl,
// spread_places.glsl and penumbra_bounds.glsl.
//
// Cells are weighed here, not by the sampler: filters of 8 bits leave no depth to tell widths by, and a cell
// beyond the receiver blocks nothing.
uniform HS_HIGHP sampler2D u_pyramid;
// x: cells per side of the finest level, y: last level, z: 1 / texels of the depth map per side; of one map of several
uniform HS_HIGHP vec4 u_pyramidLayout;
// x: depth of the nearest caster, y: depth range of casters / 255
uniform HS_HIGHP vec4 u_pyramidRange;

// The cell whose centre is at uv, see hs_unpackOccupancy().
HS_HIGHP vec2 hs_cell(HS_HIGHP vec2 uv) {
  HS_COUNT(1);
  return hs_unpackOccupancy(texture2D(u_pyramid, uv));
}

// Texel of the atlas at which a level's cells begin.
HS_HIGHP vec2 hs_levelOrigin(HS_HIGHP float level, HS_HIGHP float side) {
  HS_HIGHP vec2 origin = level < 0.5 ? vec2(0.0) : vec2(u_pyramidLayout.x, u_pyramidLayout.x - 2.0 * side);
#ifdef HS_SUB_LIGHTS_U
  origin = origin * u_subLights.w + hs_tile * side;
#endif
  return origin;
}

// From cell to cell in texture coordinates.
HS_HIGHP vec2 hs_cellPitch() {
#ifdef HS_SUB_LIGHTS_U
  return vec2(2.0 / 3.0, 1.0) / (u_pyramidLayout.x * u_subLights.w);
#else
  return vec2(2.0 / 3.0, 1.0) / u_pyramidLayout.x;
#endif
}

// A tent of two cells' width around a texel.
HS_HIGHP vec2 hs_cellsAround(HS_HIGHP vec2 texel, HS_HIGHP float level) {
  HS_HIGHP float side = floor(u_pyramidLayout.x * exp2(-level) + 0.5);
  HS_HIGHP vec2 at = texel * (side * u_pyramidLayout.z) - 0.5;
  HS_HIGHP vec2 first = floor(at);
  HS_HIGHP vec2 part = at - first;
  HS_HIGHP vec2 near = (1.0 - part) * step(vec2(0.0), first) * step(first, vec2(side - 0.5));
  HS_HIGHP vec2 next = part * step(vec2(-1.0), first) * step(first, vec2(side - 1.5));
  HS_HIGHP vec2 pitch = hs_cellPitch();
  HS_HIGHP vec2 uv = (hs_levelOrigin(level, side) + first + 0.5) * pitch;
  HS_HIGHP vec2 uvNext = uv + pitch;
  HS_HIGHP vec2 a = hs_cell(uv), b = hs_cell(vec2(uvNext.x, uv.y)), c = hs_cell(vec2(uv.x, uvNext.y)), d = hs_cell(uvNext);
  // x: share of it that lies nearer, y: share times gap; what lies beyond the receiver blocks nothing.
  HS_HIGHP vec4 gap = hs_receiverValue - u_pyramidRange.x - u_pyramidRange.y * vec4(a.y, b.y, c.y, d.y);
  HS_HIGHP vec4 share = vec4(a.x, b.x, c.x, d.x) * step(vec4(0.0), gap) * vec4(near.x, next.x, near.x, next.x) *
                        vec4(near.yy, next.yy);
  return vec2(dot(share, vec4(1.0)), dot(share, gap)) * (1.0 / 255.0);
}

// The same over about widthTexels of the depth map, between two levels: changes evenly with the width. A region much
// longer than wide, as where the map's texels are not square, is looked at from several places along it that start to
// part as it becomes so.
HS_HIGHP vec2 hs_blockersAround(HS_HIGHP vec2 widthTexels) {
  HS_HIGHP float longer = max(widthTexels.x, widthTexels.y);
  HS_HIGHP float span = max(0.6 * longer - min(widthTexels.x, widthTexels.y), 0.0);
  HS_HIGHP float width = longer - span;
  // Half a width apart at most: eight of them at the very longest.
  HS_HIGHP float strides = ceil(2.0 * span / max(width, 1.0e-3));
  HS_HIGHP vec2 along = (widthTexels.x > widthTexels.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0)) * span;
  HS_HIGHP float cellsWide = width * u_pyramidLayout.x * u_pyramidLayout.z;
  HS_HIGHP float level = clamp(log2(max(0.5 * cellsWide, 1.0)), 0.0, u_pyramidLayout.y);
  HS_HIGHP float lower = floor(level);
  HS_HIGHP float between = level - lower;
  HS_HIGHP vec2 texel = hs_texel - 0.5 * along;
  HS_HIGHP vec2 stride = along / max(strides, 1.0);
  HS_HIGHP vec2 sum = vec2(0.0);
  // A level a turn, the finer one first: programs are half as long. Their number is one that compilers do not know.
  HS_HIGHP float left = strides;
  HS_HIGHP float coarser = 0.0;
  for (int i = 0; i < HS_MOST_TURNS; ++i) {
    if (left < -0.5) break;
    HS_HIGHP float share = coarser > 0.5 ? between : 1.0 - between;
    if (share > 0.0) sum += share * hs_cellsAround(texel, lower + coarser);
    texel += coarser * stride;
    left -= coarser;
    coarser = 1.0 - coarser;
  }
  return sum / (strides + 1.0);
}

// Mean gap of what can block the fragment, depth units, or -1: nothing does. Where it asks for much less than the
// region that was looked at, the region is then what the mean asks for, and between the two from one to the other:
// a nearer caster at the rim makes it wide without being in the way, and so does the upper part of a wall at whose foot
// the fragment lies.
HS_HIGHP float hs_meanGap() {
  HS_HIGHP float asked = hs_widestGap;
  HS_HIGHP float gap = -1.0;
  HS_HIGHP float again = 1.0;
  for (int i = 0; i < 5; ++i) {
    HS_HIGHP vec2 around = hs_blockersAround(hs_kernel * asked);
    if (around.x <= 0.0) break;
    HS_HIGHP float mean = around.y / around.x;
    HS_HIGHP float part = mean / hs_widestGap;
    // Of the region that the filter will cover, half a step of an 8-bit image.
    if (gap < 0.0 && around.x <= 0.002 * part * part) break;
    HS_HIGHP float trust = gap < 0.0 ? 1.0 : again * min(10.0 * around.x, 1.0);
    gap = mix(asked, mean, trust);
    again = clamp(3.4 - 4.0 * gap / asked, 0.0, 1.0);
    if (again <= 0.0) break;
    asked = gap;
  }
  return gap;
}
