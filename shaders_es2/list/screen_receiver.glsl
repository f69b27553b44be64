// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The receiver that an earlier pass left in this pixel, for lists that are walked on the screen: where it stands, and the
// plane of its facet. Needs list_vertices.glsl and receiver_position.glsl, whose coordinates here are the world's axes
// relative to the eye.
uniform HS_HIGHP sampler2D u_receiverFacets;
uniform HS_HIGHP float u_receiverNumber;  // of the object whose lists these are
uniform HS_HIGHP float u_facetRounding;   // of components of its facets' normals, where they come from derivatives
uniform HS_HIGHP mat4 u_mapFromRelative;
uniform HS_HIGHP mat4 u_planeFromFacet;   // columns: of the facet's normal, and of its plane's distance to the eye
uniform HS_HIGHP vec4 u_eyeLight;         // the eye, like hs_map

// Of what is stored: distances have 20 bits beyond the nearest, which has those of a float; normals 16 a side of the
// octahedron.
#define HS_DISTANCE_ROUNDING 1e-6
#define HS_NEAREST_ROUNDING 1.5e-7
#define HS_SIDE_ROUNDING 1.6e-5

HS_HIGHP vec4 hs_map = vec4(0.0);         // (t, i) = xyz / w, w: the height over the light
HS_HIGHP vec4 hs_facetPlane = vec4(0.0);  // dot(hs_facetPlane, hs_map) = 0 on the facet
// How far (t, i) may be from where the receiver is. It is not lifted by as much: its own facet tells itself apart by it, and
// others would lose a part of what they hide near by.
HS_HIGHP vec3 hs_placeRounding = vec3(0.0);

HS_HIGHP vec3 hs_octahedral(HS_HIGHP vec4 stored) {
  HS_HIGHP vec4 bytes = floor(stored * 255.0 + 0.5);
  HS_HIGHP vec2 side = (bytes.xz * 256.0 + bytes.yw - 32767.0) / 32767.0;
  HS_HIGHP vec3 n = vec3(side, 1.0 - abs(side.x) - abs(side.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(side.yx)) * vec2(side.x < 0.0 ? -1.0 : 1.0, side.y < 0.0 ? -1.0 : 1.0);
  return n;
}

// False where another object is seen.
bool hs_readReceiver() {
  HS_HIGHP vec4 stored = hs_storedReceiver();
  HS_HIGHP vec3 relative = hs_positionOf(stored);
  HS_HIGHP vec3 n = hs_octahedral(texture2D(u_receiverFacets, gl_FragCoord.xy * vec2(u_receiverRayX.w, u_receiverRayY.w)));
  HS_HIGHP vec4 fromEye = u_mapFromRelative * vec4(relative, 0.0);
  hs_map = u_eyeLight + fromEye;
  HS_HIGHP vec3 place = hs_map.xyz / max(hs_map.w, u_listPlace.x);
  HS_HIGHP float nearShare = u_receiverRay.w / max(hs_distanceOf(stored), HS_SMALL);
  HS_HIGHP float rounding = HS_DISTANCE_ROUNDING * (1.0 - nearShare) + HS_NEAREST_ROUNDING;
  hs_placeRounding = rounding * abs(fromEye.xyz - place * fromEye.w) / max(hs_map.w, u_listPlace.x);
  hs_facetPlane = u_planeFromFacet * vec4(n, -dot(n, relative));
  HS_HIGHP vec3 x = u_planeFromFacet[0].xyz - u_planeFromFacet[3].xyz * relative.x;
  HS_HIGHP vec3 y = u_planeFromFacet[1].xyz - u_planeFromFacet[3].xyz * relative.y;
  HS_HIGHP vec3 z = u_planeFromFacet[2].xyz - u_planeFromFacet[3].xyz * relative.z;
  hs_planeTurn = (HS_SIDE_ROUNDING + u_facetRounding) * (abs(x) + abs(y) + 2.0 * abs(z));
  return abs(floor(stored.a * 255.0 + 0.5) - u_receiverNumber) < 0.5;
}
