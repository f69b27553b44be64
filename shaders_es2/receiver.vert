// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Receivers as the camera sees them, with their place in the light's map.
attribute highp vec3 a_position;
uniform highp mat4 u_clipFromObject;
// (s·z, t·z, d·z, z): map coordinates and stored depth, times the distance along the light's axis.
uniform highp mat4 u_mapFromObject;
varying highp vec4 v_map;
#ifdef HS_DEPTH_PACKED16
varying highp vec3 v_ramp;
#endif
#ifdef HS_FACET_NORMAL
attribute highp vec3 a_normal;
uniform highp mat3 u_mapNormalFromObject;
uniform highp vec4 u_vertexPlane;  // x: near distance in depth units, yz: map size in texels, w: largest gradient
varying highp vec2 v_gradient;
#endif
#ifdef HS_SHADED
#ifndef HS_FACET_NORMAL
attribute highp vec3 a_normal;
#endif
attribute highp vec2 a_texcoord;
uniform highp mat4 u_shadeFromObject;  // relative to the light's centre, world axes
uniform highp mat3 u_worldNormalFromObject;
varying highp vec3 v_shadePosition;
varying highp vec3 v_shadeNormal;
varying highp vec2 v_texcoord;
#endif
invariant gl_Position;

void main() {
  highp vec4 position = vec4(a_position, 1.0);
  gl_Position = u_clipFromObject * position;
  v_map = u_mapFromObject * position;
#ifdef HS_DEPTH_PACKED16
  v_ramp = vec3(v_map.z, 256.0 * v_map.z, v_map.w);
#endif
#ifdef HS_FACET_NORMAL
  // The facet's plane in (s·z, t·z, z): 1/z = dot(n, (s, t, 1)) / k, hence the gradient of depth over the map.
  highp vec3 n = u_mapNormalFromObject * a_normal;
  highp float k = dot(n, v_map.xyw);
  k = abs(k) < 1e-12 ? 1e-12 : k;
  v_gradient = clamp(-u_vertexPlane.x * n.xy / (k * u_vertexPlane.yz), -u_vertexPlane.w, u_vertexPlane.w);
#endif
#ifdef HS_SHADED
  v_shadePosition = (u_shadeFromObject * position).xyz;
  v_shadeNormal = u_worldNormalFromObject * a_normal;
  v_texcoord = a_texcoord;
#endif
}
