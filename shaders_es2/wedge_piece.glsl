// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The share of the light's square that one piece of silhouette covers as a receiver sees it: the integral of
// x dy along the projected polygon, with x and y clamped to the square. Exact, continuous in the receiver's
// position, and additive: pieces that share a chord cancel along it.
varying HS_HIGHP vec4 v_pieceA0;
varying HS_HIGHP vec4 v_pieceA1;
varying HS_HIGHP vec4 v_pieceB0;
varying HS_HIGHP vec4 v_pieceB1;
varying HS_HIGHP vec4 v_pieceK0;
varying HS_HIGHP vec4 v_pieceK1;

// Distance along 1/h below which a vertex is not nearer to the light than the receiver; projected positions
// stay within what the precision holds.
#ifdef HS_NO_HIGHP
#define HS_WEDGE_NEAR 1e-3
#define HS_WEDGE_FAR 60.0
#define HS_WEDGE_FLAT 1e-2
#else
#define HS_WEDGE_NEAR 1e-5
#define HS_WEDGE_FAR 1e6
#define HS_WEDGE_FLAT 1e-4
#endif

// Four edges (xa, ya) -> (xb, yb): the integral of clamp(x) dy between the clamped ends.
HS_HIGHP float hs_edgeIntegrals(HS_HIGHP vec4 xa, HS_HIGHP vec4 ya, HS_HIGHP vec4 xb, HS_HIGHP vec4 yb) {
  HS_HIGHP vec4 clampedA = clamp(ya, -1.0, 1.0);
  HS_HIGHP vec4 clampedB = clamp(yb, -1.0, 1.0);
  HS_HIGHP vec4 rise = yb - ya;
  // Where the edge is level the clamped ends are, too, and whatever the slope the integral is 0.
  HS_HIGHP vec4 slope = (xb - xa) / (rise + (vec4(1.0) - step(1e-6, abs(rise))));
  HS_HIGHP vec4 xFrom = xa + (clampedA - ya) * slope;
  HS_HIGHP vec4 xTo = xb + (clampedB - yb) * slope;
  HS_HIGHP vec4 from = clamp(xFrom, -1.0, 1.0);
  HS_HIGHP vec4 to = clamp(xTo, -1.0, 1.0);
  // The mean of clamp(x) for x from xFrom to xTo, by its primitive c x - c c / 2.
  HS_HIGHP vec4 run = xTo - xFrom;
  HS_HIGHP vec4 flat_ = vec4(1.0) - step(HS_WEDGE_FLAT, abs(run));
  HS_HIGHP vec4 primitive = to * (xTo - 0.5 * to) - from * (xFrom - 0.5 * from);
  HS_HIGHP vec4 mean = mix(primitive / (run + flat_), 0.5 * (from + to), flat_);
  return dot(mean, clampedB - clampedA);
}

HS_HIGHP float hs_pieceCoverage(HS_HIGHP vec3 receiver) {
  HS_HIGHP float k = 1.0 / max(receiver.z, 1e-3);
  HS_HIGHP vec2 p = receiver.xy * k;
  HS_HIGHP vec4 w0 = v_pieceK0 - k, w1 = v_pieceK1 - k;
  HS_HIGHP vec4 inside0 = step(HS_WEDGE_NEAR, w0), inside1 = step(HS_WEDGE_NEAR, w1);
  HS_HIGHP vec4 a0 = v_pieceA0 - p.x, a1 = v_pieceA1 - p.x, b0 = v_pieceB0 - p.y, b1 = v_pieceB1 - p.y;
  HS_HIGHP vec4 scale0 = 1.0 / max(w0, HS_WEDGE_NEAR), scale1 = 1.0 / max(w1, HS_WEDGE_NEAR);
  HS_HIGHP vec4 x0 = clamp(a0 * scale0, -HS_WEDGE_FAR, HS_WEDGE_FAR);
  HS_HIGHP vec4 x1 = clamp(a1 * scale1, -HS_WEDGE_FAR, HS_WEDGE_FAR);
  HS_HIGHP vec4 y0 = clamp(b0 * scale0, -HS_WEDGE_FAR, HS_WEDGE_FAR);
  HS_HIGHP vec4 y1 = clamp(b1 * scale1, -HS_WEDGE_FAR, HS_WEDGE_FAR);
  HS_HIGHP float sum = hs_edgeIntegrals(x0, y0, vec4(x0.yzw, x1.x), vec4(y0.yzw, y1.x)) +
                       hs_edgeIntegrals(x1, y1, vec4(x1.yzw, x0.x), vec4(y1.yzw, y0.x));
  // Behind the light there is no light to cover.
  return 0.25 * sum * step(1e-3, receiver.z) * step(3.5, dot(inside0 * inside1, vec4(1.0)));
}
