// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "receiver/alpha_mask.glsl"
#ifdef HS_DEPTH_PACKED16
varying HS_HIGHP vec3 v_ramp;
uniform HS_HIGHP sampler2D u_byteRamp;
void main() {
  gl_FragColor = texture2DProj(u_byteRamp, v_ramp);
  hs_cut();
}
#elif defined(HS_DEPTH_PACKED24)
varying HS_HIGHP vec2 v_depth;
void main() {
  // Split into bytes by integer arithmetic and stored a quarter above the step, so that targets which round
  // and targets which truncate keep all 24 bits.
  HS_HIGHP float scaled = floor(clamp(v_depth.x / v_depth.y, 0.0, 1.0) * 16777215.0);
  HS_HIGHP float high = floor(scaled / 65536.0);
  HS_HIGHP float middle = floor((scaled - high * 65536.0) / 256.0);
  HS_HIGHP float low = scaled - high * 65536.0 - middle * 256.0;
  gl_FragColor = vec4((vec3(high, middle, low) + 0.25) / 255.0, 1.0);
  hs_cut();
}
#else
void main() {
  gl_FragColor = vec4(1.0);
  hs_cut();
}
#endif
