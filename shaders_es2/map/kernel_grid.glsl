// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer filtering over HS_KERNEL x HS_KERNEL neighbouring texels, all taps at texel centres, so
// that the receiver plane is compared exactly where depth was sampled.
// Based on: Reeves, Salesin, Cook, "Rendering Antialiased Shadows with Depth Maps", 1987, section 4.
#if HS_KERNEL == 4
// Few taps are fetched whether they are needed or not: inside an `if` they would cost some compilers a thread.
#define HS_FETCHES_ALWAYS
#endif

#if HS_KERNEL == 4 && !defined(HS_SUB_LIGHTS_U)
// Row by row; what all taps of a row have in common is added up once.
#define HS_ROWS
#ifdef HS_DEPTH_PACKED16
#define HS_RowPlane HS_HIGHP vec4  // of each tap
HS_RowPlane hs_firstRow(HS_HIGHP float planeFirst, HS_HIGHP float bias) {
  return planeFirst + hs_gradient.x * vec4(0.0, 1.0, 2.0, 3.0);
}
// Tap by tap: one sum of a row keeps all its fetches, more than some devices have registers for.
void hs_addRow(inout float lit, HS_HIGHP vec2 uv, HS_RowPlane plane, HS_HIGHP float bias) {
  vec4 least = min(plane, 0.0) - bias;
  lit += step(least.x, hs_gap(texture2D(u_depthMap, uv), hs_receiver));
  lit += step(least.y, hs_gap(texture2D(u_depthMap, uv + vec2(u_map.y, 0.0)), hs_receiver));
  lit += step(least.z, hs_gap(texture2D(u_depthMap, uv + vec2(2.0 * u_map.y, 0.0)), hs_receiver));
  lit += step(least.w, hs_gap(texture2D(u_depthMap, uv + vec2(3.0 * u_map.y, 0.0)), hs_receiver));
}
#else
// The receiver's depth is added to what texels are compared with, once, not taken from each of them.
#define HS_RowPlane HS_HIGHP float  // of the first tap, with what every tap is compared with
HS_RowPlane hs_firstRow(HS_HIGHP float planeFirst, HS_HIGHP float bias) {
  return planeFirst + (hs_receiver - bias);
}
void hs_addRow(inout float lit, HS_HIGHP vec2 uv, HS_RowPlane plane, HS_HIGHP float bias) {
  HS_HIGHP float least = hs_receiver - bias;
  HS_HIGHP vec3 next = plane + hs_gradient.x * vec3(1.0, 2.0, 3.0);
  lit += step(min(plane, least), hs_depthValue(texture2D(u_depthMap, uv)));
  lit += step(min(next.x, least), hs_depthValue(texture2D(u_depthMap, uv + vec2(u_map.y, 0.0))));
  lit += step(min(next.y, least), hs_depthValue(texture2D(u_depthMap, uv + vec2(2.0 * u_map.y, 0.0))));
  lit += step(min(next.z, least), hs_depthValue(texture2D(u_depthMap, uv + vec2(3.0 * u_map.y, 0.0))));
}
#endif
#endif

// Centre of the first texel of the kernel that is centred on the receiver; what all taps are biased by, and how much
// deeper the receiver's plane is at that texel than at the receiver.
HS_HIGHP vec2 hs_firstTexel(out HS_HIGHP float bias, out HS_HIGHP float planeFirst) {
  bias = u_bias.x + u_bias.y * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 first = floor(hs_texel - 0.5 * float(HS_KERNEL) + 0.5) + 0.5;
  planeFirst = dot(hs_gradient, first - hs_texel);
  return first;
}

float hs_pcfGrid() {
  HS_HIGHP float bias, planeFirst;
  HS_HIGHP vec2 first = hs_firstTexel(bias, planeFirst);
  float lit = 0.0;
#ifdef HS_ROWS
  HS_HIGHP vec2 uv = first * u_map.y;
  HS_RowPlane plane = hs_firstRow(planeFirst, bias);
  for (int y = 0; y < 4; ++y) {
    hs_addRow(lit, uv, plane, bias);
    HS_COUNT(4);
    uv.y += u_map.y;
    plane += hs_gradient.y;
  }
#elif HS_KERNEL <= 8
  for (int y = 0; y < HS_KERNEL; ++y) {
    for (int x = 0; x < HS_KERNEL; ++x) {
      HS_HIGHP vec2 offset = vec2(float(x), float(y));
      lit += hs_lit(first + offset, hs_receiver, planeFirst + dot(hs_gradient, offset), bias);
    }
  }
#else
  // One flat loop: nested ones are unrolled by mobile compilers and no longer fit.
  HS_HIGHP vec2 offset = vec2(0.0);
  for (int i = 0; i < HS_KERNEL * HS_KERNEL; ++i) {
    lit += hs_lit(first + offset, hs_receiver, planeFirst + dot(hs_gradient, offset), bias);
    offset.x += 1.0;
    float wrapped = step(float(HS_KERNEL) - 0.5, offset.x);
    offset += wrapped * vec2(-float(HS_KERNEL), 1.0);
  }
#endif
  return lit * (1.0 / float(HS_KERNEL * HS_KERNEL));
}

// The same sum in one loop that ends after `count` taps (0 or all): drivers that evaluate both sides of an
// `if` still leave a loop early.
float hs_pcfGridBounded(float count) {
  HS_HIGHP float bias, planeFirst;
  HS_HIGHP vec2 first = hs_firstTexel(bias, planeFirst);
  float lit = 0.0;
#ifdef HS_ROWS
  HS_HIGHP vec2 uv = first * u_map.y;
  HS_RowPlane plane = hs_firstRow(planeFirst, bias);
  for (int y = 0; y < 4; ++y) {
    if (float(4 * y) >= count) break;
    hs_addRow(lit, uv, plane, bias);
    HS_COUNT(4);
    uv.y += u_map.y;
    plane += hs_gradient.y;
  }
#else
  HS_HIGHP vec2 offset = vec2(0.0);
  for (int i = 0; i < HS_KERNEL * HS_KERNEL; ++i) {
    if (float(i) >= count) break;
    lit += hs_lit(first + offset, hs_receiver, planeFirst + dot(hs_gradient, offset), bias);
    offset.x += 1.0;
    float wrapped = step(float(HS_KERNEL) - 0.5, offset.x);
    offset += wrapped * vec2(-float(HS_KERNEL), 1.0);
  }
#endif
  return lit * (1.0 / float(HS_KERNEL * HS_KERNEL));
}
