// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Split into bytes by integer arithmetic and stored a quarter above the step, so that targets which round and
// targets which truncate keep all bits that the arithmetic has.
varying HS_HIGHP float v_distance;
void main() {
  HS_HIGHP float scaled = clamp(v_distance, 0.0, 0.9999999) * 256.0;
  HS_HIGHP float high = floor(scaled);
  scaled = (scaled - high) * 256.0;
  HS_HIGHP float middle = floor(scaled);
  HS_HIGHP float low = floor((scaled - middle) * 256.0);
  gl_FragColor = vec4((vec3(min(high, 255.0), middle, low) + 0.25) / 255.0, 1.0);
}
