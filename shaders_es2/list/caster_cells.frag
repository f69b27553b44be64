// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What one caster leaves of light cells, to be multiplied into what the others leave: four cells of a target, or one
// in the channel that the colour mask leaves open.
#include "receiver/tap_count.glsl"
#include "list/cell_coverage.glsl"
#include "screen/receiver_position.glsl"
#include "list/list_vertices.glsl"
#include "list/caster_fragment.glsl"
#include "list/cell_walk.glsl"
void main() {
  HS_HIGHP vec2 at;
  HS_HIGHP vec3 origin;
  bool reaches = hs_casterReaches(at, origin);
  HS_CasterWalk walk;
  hs_startCasterWalk(walk);
  HS_Cells covered = HS_CELLS_ALL(0.0);
#ifdef HS_SIDES
  HS_Cells otherSide = HS_CELLS_ALL(0.0);
#endif
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!reaches) break;
    HS_Tags tags;
    HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
    hs_casterWalk(walk, covered, projected, tags);
#ifdef HS_SIDES
    hs_joinSides(covered, otherSide, step(0.5, tags.ends), tags.firstSide);
    if (tags.firstSide > 0.5) continue;
#endif
    if (tags.ends > 0.5) break;
  }
#if HS_CELLS == 4
  HS_HIGHP vec4 visible = 1.0 - clamp(covered.xxxx, 0.0, 1.0);
#elif HS_CELLS == 16
  HS_HIGHP vec4 visible = 1.0 - clamp(covered, 0.0, 1.0);
#elif defined(HS_UPPER_CELLS)
  HS_HIGHP vec4 visible = 1.0 - clamp(covered.upper, 0.0, 1.0);
#else
  HS_HIGHP vec4 visible = 1.0 - clamp(covered.lower, 0.0, 1.0);
#endif
#ifdef HS_USE_FETCH
  visible *= HS_LAST_COLOR;
#endif
  // Rounded here, and stored an eighth above the step, as on truncating targets.
  gl_FragColor = (floor(visible * 255.0 + 0.5) + 0.125) / 255.0;
}
