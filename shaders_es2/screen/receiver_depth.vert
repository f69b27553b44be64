// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Receivers' distance along the view axis, 1 = the farthest. HS_FACETS: where their facets face; HS_FACET_NORMAL: their
// facets' planes are known.
#include "receiver/alpha_mask_vertex.glsl"
attribute highp vec3 a_position;
uniform highp mat4 u_clipFromObject;
uniform highp float u_inverseFarthest;
varying highp float v_distance;
#if defined(HS_FACETS) || defined(HS_FACET_NORMAL)
uniform highp mat4 u_relativeFromObject;  // relative to the eye, world axes, 1 = the farthest
#endif
#ifdef HS_FACET_NORMAL
attribute highp vec3 a_normal;
uniform highp mat3 u_worldNormalFromObject;
varying highp vec4 v_facet;  // dot(xyz, relative) = w, towards the eye
#elif defined(HS_FACETS)
varying highp vec3 v_relative;
#endif
invariant gl_Position;

void main() {
  hs_passSurface();
  highp vec4 position = vec4(a_position, 1.0);
  gl_Position = u_clipFromObject * position;
  v_distance = gl_Position.w * u_inverseFarthest;
#if defined(HS_FACETS) || defined(HS_FACET_NORMAL)
  highp vec3 relative = (u_relativeFromObject * vec4(a_position, 1.0)).xyz;
#endif
#ifdef HS_FACET_NORMAL
  highp vec3 n = u_worldNormalFromObject * a_normal;
  highp float offset = dot(n, relative);
  v_facet = offset > 0.0 ? -vec4(n, offset) : vec4(n, offset);
#elif defined(HS_FACETS)
  v_relative = relative;
#endif
}
