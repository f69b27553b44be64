// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Depth of casters as seen from the light: 1 - near/z, affine in reciprocal depth, so that planes stay planes.
#include "receiver/alpha_mask_vertex.glsl"
attribute highp vec3 a_position;
uniform highp mat4 u_mapClipFromObject;
#ifdef HS_DEPTH_PACKED16
// (d·z, 256·d·z, z): a projective fetch of the ramp turns it into the bytes of d without arithmetic.
varying highp vec3 v_ramp;
uniform highp vec2 u_depthOfDistance;  // depth times z is x z - y
#elif defined(HS_DEPTH_PACKED24)
varying highp vec2 v_depth;
uniform highp vec2 u_depthOfDistance;
#endif

void main() {
  hs_passSurface();
  gl_Position = u_mapClipFromObject * vec4(a_position, 1.0);
#ifdef HS_DEPTH_PACKED16
  highp float depthTimesZ = u_depthOfDistance.x * gl_Position.w - u_depthOfDistance.y;
  v_ramp = vec3(depthTimesZ, 256.0 * depthTimesZ, gl_Position.w);
#elif defined(HS_DEPTH_PACKED24)
  v_depth = vec2(u_depthOfDistance.x * gl_Position.w - u_depthOfDistance.y, gl_Position.w);
#endif
}
