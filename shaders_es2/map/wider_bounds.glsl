// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Bounds in bytes, whole numbers: xy the smallest depth, zw the largest, the high byte first.

// What holds both: of each bound the high bytes decide, unless they are equal.
vec4 hs_wider(vec4 a, vec4 b) {
  vec4 away = b - a;
  vec4 order = clamp(away, -1.0, 1.0) * vec4(-2.0, -1.0, 2.0, 1.0);
  return a + step(0.5, order.xz + order.yw).xxyy * away;
}
