// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A receiver vertex's place in the light's map, for the engine's own vertex shader and for those of hosts.
// (s·z, t·z, d·z, z): map coordinates and stored depth, times the distance along the light's axis.
uniform highp mat4 u_mapFromObject;
varying highp vec4 v_map;
#ifdef HS_DEPTH_PACKED16
varying highp vec3 v_ramp;
#endif
#ifdef HS_FACET_NORMAL
uniform highp mat3 u_mapNormalFromObject;
uniform highp vec4 u_vertexPlane;  // x: near distance in depth units, yz: map size in texels, w: largest gradient
varying highp vec2 v_gradient;
#endif

// position: object space, w = 1; facetNormal: of the triangle, object space, read only with HS_FACET_NORMAL.
void halfshadow_receive(highp vec4 position, highp vec3 facetNormal) {
  v_map = u_mapFromObject * position;
#ifdef HS_DEPTH_PACKED16
  v_ramp = vec3(v_map.z, 256.0 * v_map.z, v_map.w);
#endif
#ifdef HS_FACET_NORMAL
  // The facet's plane in (s·z, t·z, z): 1/z = dot(n, (s, t, 1)) / k, hence the gradient of depth over the map.
  highp vec3 n = u_mapNormalFromObject * facetNormal;
  highp float k = dot(n, v_map.xyw);
  k = abs(k) < 1e-12 ? 1e-12 : k;
  v_gradient = clamp(-u_vertexPlane.x * n.xy / (k * u_vertexPlane.yz), -u_vertexPlane.w, u_vertexPlane.w);
#endif
}
