// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One caster merged into a vBuffer in targets: of each quadrant of the light the share that is occluded, the sides of a
// rectangle around it and its centre of gravity. HS_BLEND says which target, HS_MERGED that casters were there before:
// 0: share that the caster and those before it both occlude, to be kept until the other targets are merged;
// 1: share, less what both occlude, to be added;
// 2: sides of quadrant HS_QUADRANT, as (1 - left, right, 1 - bottom, top), so that the larger byte is farther out: the
//    largest by blending, by framebuffer fetch, or with HS_MERGED what they exceed those before by;
// 3, 4: centre along a and b.
#include "receiver/tap_count.glsl"
#include "list/vbuffer_edges.glsl"
#include "list/vbuffer_merge.glsl"
#include "screen/receiver_position.glsl"
#include "list/list_vertices.glsl"
#include "list/caster_fragment.glsl"
#include "list/vbuffer_walk.glsl"
#include "list/vbuffer_targets.glsl"

#if HS_BLEND >= 3
uniform HS_HIGHP float u_keepAll;  // 1 while the program is proven to draw
#endif

HS_Occlusion hs_ofCaster() {
  HS_HIGHP vec2 at;
  HS_HIGHP vec3 origin;
  bool reaches = hs_casterReaches(at, origin);
  HS_CasterWalk walk;
  hs_startCasterWalk(walk);
  HS_Sums sums;
  hs_clearSums(sums);
#ifdef HS_SIDES
  HS_Occlusion firstSide = hs_nothing();
#endif
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!reaches) break;
    HS_Tags tags;
    HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
    hs_casterWalk(walk, sums, projected, tags);
#ifdef HS_SIDES
    if (tags.firstSide > 0.5) {
      firstSide = hs_occlusion(sums);
      hs_clearSums(sums);
      continue;
    }
#endif
    if (tags.ends > 0.5) break;
  }
#ifdef HS_SIDES
  return hs_largerOf(firstSide, hs_occlusion(sums));
#else
  return hs_occlusion(sums);
#endif
}

// Rounded here, and stored an eighth above the step, as on truncating targets.
HS_HIGHP vec4 hs_nearest(HS_HIGHP vec4 value) { return (floor(value * 255.0 + 0.5) + 0.125) / 255.0; }
// Sides are rounded outward.
HS_HIGHP vec4 hs_outward(HS_HIGHP vec4 value) { return (ceil(value * 255.0 - 0.01) + 0.125) / 255.0; }

void main() {
  HS_Occlusion caster = hs_ofCaster();
#if HS_BLEND == 0
  HS_Occlusion before = hs_storedOcclusion();
  HS_HIGHP vec4 both = clamp(hs_overlap(before, caster), max(before.share + caster.share - 1.0, 0.0),
                             min(before.share, caster.share));
  gl_FragColor = hs_nearest(both);
#elif HS_BLEND == 1
  HS_HIGHP vec4 share = caster.share;
#ifdef HS_MERGED
  share -= texture2D(u_both, hs_windowPlace());
#endif
  gl_FragColor = hs_nearest(max(share, 0.0));
#elif HS_BLEND == 2
  HS_HIGHP vec4 sides = hs_outward(hs_sidesOf(caster));
#ifdef HS_USE_FETCH
  sides = max(sides, HS_LAST_COLOR + 0.125 / 255.0);
#endif
#ifdef HS_MERGED
  sides = floor(sides * 255.0) - floor(texture2D(u_sides0, hs_windowPlace()) * 255.0 + 0.5);
  sides = (max(sides, 0.0) + 0.125) / 255.0;
#endif
  gl_FragColor = sides;
#else
  // Volumes of other casters lie before the same receivers.
  if (max(max(caster.share.x, caster.share.y), max(caster.share.z, caster.share.w)) <= -u_keepAll) discard;
#ifdef HS_MERGED
  caster = hs_mergedCentre(caster);
#endif
#if HS_BLEND == 3
  gl_FragColor = hs_nearest(caster.centreX);
#else
  gl_FragColor = hs_nearest(caster.centreY);
#endif
#endif
}
