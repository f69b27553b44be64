// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What targets hold of all casters before. Needs vbuffer_edges.glsl and receiver_position.glsl.
uniform HS_HIGHP sampler2D u_both;
uniform HS_HIGHP sampler2D u_share;
uniform HS_HIGHP sampler2D u_sides0;
uniform HS_HIGHP sampler2D u_sides1;
uniform HS_HIGHP sampler2D u_sides2;
uniform HS_HIGHP sampler2D u_sides3;
uniform HS_HIGHP sampler2D u_centreX;
uniform HS_HIGHP sampler2D u_centreY;

HS_HIGHP vec2 hs_windowPlace() { return gl_FragCoord.xy * vec2(u_receiverRayX.w, u_receiverRayY.w); }

HS_Occlusion hs_storedRectangle() {
  HS_HIGHP vec2 at = hs_windowPlace();
  HS_HIGHP vec4 q0 = texture2D(u_sides0, at), q1 = texture2D(u_sides1, at);
#ifdef HS_HALVES
  // Two quadrants at a time, whichever the colour mask leaves open: more do not fit in eight texture units.
  HS_HIGHP vec4 q2 = q0, q3 = q1;
#else
  HS_HIGHP vec4 q2 = texture2D(u_sides2, at), q3 = texture2D(u_sides3, at);
#endif
  HS_Occlusion q = hs_nothing();
  q.left = 1.0 - vec4(q0.x, q1.x, q2.x, q3.x);
  q.right = vec4(q0.y, q1.y, q2.y, q3.y);
  q.bottom = 1.0 - vec4(q0.z, q1.z, q2.z, q3.z);
  q.top = vec4(q0.w, q1.w, q2.w, q3.w);
  return q;
}

HS_Occlusion hs_storedOcclusion() {
  HS_HIGHP vec2 at = hs_windowPlace();
  HS_Occlusion q = hs_storedRectangle();
  q.share = texture2D(u_share, at);
#if defined(HS_CENTRES) && HS_BLEND == 0
  q.centreX = clamp(texture2D(u_centreX, at), q.left, max(q.left, q.right));
  q.centreY = clamp(texture2D(u_centreY, at), q.bottom, max(q.bottom, q.top));
#endif
  return q;
}

#if HS_BLEND >= 3
// The centre along one axis as hs_merge() has it; what both occlude counts once, in the middle of the common rectangle.
HS_HIGHP vec4 hs_commonCentre(HS_HIGHP vec4 shareA, HS_HIGHP vec4 centreA, HS_HIGHP vec4 shareB, HS_HIGHP vec4 centreB,
                              HS_HIGHP vec4 low, HS_HIGHP vec4 high) {
  HS_HIGHP vec4 both = texture2D(u_both, hs_windowPlace());
  HS_HIGHP vec4 sum = shareA * centreA + shareB * centreB - 0.5 * both * (low + high);
  return clamp(sum / max(shareA + shareB - both, 1e-3), 0.0, 1.0);
}
HS_Occlusion hs_mergedCentre(HS_Occlusion caster) {
  HS_Occlusion before = hs_storedOcclusion();
#ifdef HS_USE_FETCH
  HS_HIGHP vec4 centre = HS_LAST_COLOR;
#elif HS_BLEND == 3
  HS_HIGHP vec4 centre = texture2D(u_centreX, hs_windowPlace());
#else
  HS_HIGHP vec4 centre = texture2D(u_centreY, hs_windowPlace());
#endif
#if HS_BLEND == 3
  caster.centreX = hs_commonCentre(before.share, centre, caster.share, caster.centreX, max(before.left, caster.left),
                                   min(before.right, caster.right));
#else
  caster.centreY = hs_commonCentre(before.share, centre, caster.share, caster.centreY, max(before.bottom, caster.bottom),
                                   min(before.top, caster.top));
#endif
  return caster;
}
#endif

#if HS_BLEND == 2
HS_HIGHP vec4 hs_sidesOf(HS_Occlusion q) {
#if HS_QUADRANT == 0
  return vec4(1.0 - q.left.x, q.right.x, 1.0 - q.bottom.x, q.top.x);
#elif HS_QUADRANT == 1
  return vec4(1.0 - q.left.y, q.right.y, 1.0 - q.bottom.y, q.top.y);
#elif HS_QUADRANT == 2
  return vec4(1.0 - q.left.z, q.right.z, 1.0 - q.bottom.z, q.top.z);
#else
  return vec4(1.0 - q.left.w, q.right.w, 1.0 - q.bottom.w, q.top.w);
#endif
}
#endif
