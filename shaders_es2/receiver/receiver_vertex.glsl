// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A receiver vertex's place in the light's map, for the engine's own vertex shader and for those of hosts.
// (s·z, t·z, d·z, z): map coordinates and stored depth, times the distance along the light's axis.
uniform highp mat4 u_mapFromObject;
varying highp vec4 v_map;
#ifdef HS_DEPTH_PACKED16
varying highp vec3 v_ramp;
#endif
#if defined(HS_FACET_NORMAL) && defined(HS_LISTS)
// Rows of the facet's plane in (t, i), in object space: there a wide facet's plane is as exact as its corners are.
uniform highp vec3 u_facetT0, u_facetT1;
uniform highp vec4 u_facetI, u_facetOne;  // xyz + w times the vertex
varying highp vec4 v_facetPlane;
#elif defined(HS_FACET_NORMAL)
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
#if defined(HS_FACET_NORMAL) && defined(HS_LISTS)
  v_facetPlane = vec4(dot(facetNormal, u_facetT0), dot(facetNormal, u_facetT1),
                      dot(facetNormal, u_facetI.xyz + u_facetI.w * position.xyz),
                      dot(facetNormal, u_facetOne.xyz + u_facetOne.w * position.xyz));
#elif defined(HS_FACET_NORMAL)
  // The facet's plane in (s·z, t·z, z): 1/z = dot(n, (s, t, 1)) / k, hence the gradient of depth over the map.
  highp vec3 n = u_mapNormalFromObject * facetNormal;
  highp float k = dot(n, v_map.xyw);
  k = abs(k) < 1e-12 ? 1e-12 : k;
  v_gradient = clamp(-u_vertexPlane.x * n.xy / (k * u_vertexPlane.yz), -u_vertexPlane.w, u_vertexPlane.w);
#endif
}
