// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The receiver of this pixel in the coordinates (a, b, h) of a light.
uniform HS_HIGHP sampler2D u_receiverDepth;
uniform HS_HIGHP vec4 u_receiverEye;
uniform HS_HIGHP vec4 u_receiverRay;
uniform HS_HIGHP vec4 u_receiverRayX;  // w: 1 / width
uniform HS_HIGHP vec4 u_receiverRayY;  // w: 1 / height

// Bytes as integers, then the distance in steps that every precision represents.
HS_HIGHP vec3 hs_receiverPosition() {
  HS_HIGHP vec2 window = gl_FragCoord.xy;
  HS_HIGHP vec4 stored = texture2D(u_receiverDepth, window * vec2(u_receiverRayX.w, u_receiverRayY.w));
  HS_HIGHP vec3 bytes = floor(stored.rgb * 255.0 + 0.5);
  HS_HIGHP float along = ((bytes.z * (1.0 / 256.0) + bytes.y) * (1.0 / 256.0) + bytes.x) * (1.0 / 256.0);
  HS_HIGHP vec3 ray = u_receiverRay.xyz + window.x * u_receiverRayX.xyz + window.y * u_receiverRayY.xyz;
  return u_receiverEye.xyz + along * ray;
}
