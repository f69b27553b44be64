// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One step of exact prefix sums: four partial sums, u_step apart, added byte by byte with carries.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;  // x: texels per side, y: 1 / x
uniform HS_HIGHP vec4 u_step;        // xy: distance of the partial sums in texels, z: side of a channel's part
uniform HS_HIGHP vec4 u_quantum;     // x: count of a full texel
#ifdef HS_TILED
// Several maps in rows, each summed up for itself.
uniform HS_HIGHP vec4 u_tiles;  // xy: columns and rows, zw: texels of a map
#endif

void main() {
  HS_HIGHP vec2 place = floor(v_uv * (2.0 * u_step.z));
  HS_HIGHP vec2 tile = step(vec2(u_step.z), place);
  HS_HIGHP vec2 local = place - tile * u_step.z;
#ifdef HS_FIRST_STEP
  vec4 channel = vec4((1.0 - tile.y) * vec2(1.0 - tile.x, tile.x), tile.y * vec2(1.0 - tile.x, tile.x));
#endif
#ifdef HS_TILED
  HS_HIGHP vec2 origin = floor((local + 0.5) / u_tiles.zw) * u_tiles.zw;
  local -= origin;
#else
  const vec2 origin = vec2(0.0);
#endif
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    float inside = step(0.0, min(local.x, local.y));
#ifdef HS_FIRST_STEP
    float value = dot(texture2D(u_source, (local + origin + 0.5) * u_sourceSize.y), channel);
    sum.z += inside * floor(value * u_quantum.x + 0.5);
#else
    vec3 bytes = floor(texture2D(u_source, (local + origin + tile * u_step.z + 0.5) * u_sourceSize.y).rgb * 255.0 + 0.5);
    sum += inside * bytes;
#endif
    local -= u_step.xy;
  }
  float carry = floor(sum.z * (1.0 / 256.0));
  sum.z -= 256.0 * carry;
  sum.y += carry;
  carry = floor(sum.y * (1.0 / 256.0));
  sum.y -= 256.0 * carry;
  sum.x += carry;
  gl_FragColor = vec4((sum + 0.25) / 255.0, 1.0);
}
