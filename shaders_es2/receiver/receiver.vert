// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Receivers as the camera sees them, with their place in the light's map.
#include "receiver/receiver_vertex.glsl"
#include "receiver/alpha_mask_vertex.glsl"
attribute highp vec3 a_position;
uniform highp mat4 u_clipFromObject;
#if defined(HS_FACET_NORMAL) || defined(HS_SHADED)
attribute highp vec3 a_normal;
#endif
#ifdef HS_SHADED
uniform highp mat4 u_shadeFromObject;  // relative to the light's centre, world axes
uniform highp mat3 u_worldNormalFromObject;
varying highp vec3 v_shadePosition;
varying highp vec3 v_shadeNormal;
#endif
invariant gl_Position;

void main() {
  highp vec4 position = vec4(a_position, 1.0);
  gl_Position = u_clipFromObject * position;
  hs_passSurface();
#ifdef HS_FACET_NORMAL
  halfshadow_receive(position, a_normal);
#else
  halfshadow_receive(position, vec3(0.0));
#endif
#ifdef HS_SHADED
  v_shadePosition = (u_shadeFromObject * position).xyz;
  // About of unit length, so that fragments need not scale it; 0 where the mesh has no normals.
  highp vec3 n = u_worldNormalFromObject * a_normal;
  v_shadeNormal = n / max(max(max(abs(n.x), abs(n.y)), abs(n.z)), 1e-30);
#endif
}
