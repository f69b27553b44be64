// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A receiver's vertex P with the eight vertices E of a piece of silhouette projected from it onto the light's plane:
// (hP E.ab - hE P.ab, hP - hE), over the size of the piece's caster, is linear in P, so that interpolation is exact.
// Places are (a, b, h - 1), small near the casters.
#ifdef HS_WEDGE_FOOTPRINT
attribute highp vec4 a_position;  // w: 1 / size
#else
attribute highp vec3 a_position;
#endif
uniform highp mat4 u_clipFromObject;
varying highp vec4 v_pieceX0;
varying highp vec4 v_pieceX1;
varying highp vec4 v_pieceY0;
varying highp vec4 v_pieceY1;
varying highp vec4 v_pieceW0;
varying highp vec4 v_pieceW1;
#ifdef HS_WEDGE_FOOTPRINT
// Of the part of the receiver that the piece can shadow, projected once for all frames.
attribute highp vec4 a_extra0;
attribute highp vec4 a_extra1;
attribute highp vec4 a_extra2;
attribute highp vec4 a_extra3;
attribute highp vec4 a_extra4;
attribute highp vec4 a_normal;
#ifdef HS_WEDGE_EXACT
attribute highp vec4 a_texcoord;
uniform highp mat4 u_lightFromObject;
varying highp vec4 v_place;  // w: 1 / size
varying highp vec4 v_facet;  // dot(xyz, place) = w
#endif
#else
uniform highp mat4 u_lightFromObject;
uniform highp vec4 u_piece[6];  // a, b and h - 1 of four vertices and four more
uniform highp float u_pieceInverseSize;
#endif
#if defined(HS_WEDGE_CLIP) && !defined(HS_WEDGE_EXACT)
varying highp float v_inverseSize;
#endif
// The same depth as that of the pass which finds the visible surface.
invariant gl_Position;

void main() {
  highp vec4 position = vec4(a_position.xyz, 1.0);
  gl_Position = u_clipFromObject * position;
#ifdef HS_WEDGE_FOOTPRINT
#if defined(HS_WEDGE_CLIP) && !defined(HS_WEDGE_EXACT)
  v_inverseSize = a_position.w;
#endif
  v_pieceX0 = a_extra0;
  v_pieceX1 = a_extra1;
  v_pieceY0 = a_extra2;
  v_pieceY1 = a_extra3;
  v_pieceW0 = a_extra4;
  v_pieceW1 = a_normal;
#ifdef HS_WEDGE_EXACT
  v_place = vec4((u_lightFromObject * position).xyz, a_position.w);
  v_facet = a_texcoord;
#endif
#else
#ifdef HS_WEDGE_CLIP
  v_inverseSize = u_pieceInverseSize;
#endif
  highp vec3 place = (u_lightFromObject * position).xyz;
  v_pieceX0 = (u_piece[0] - place.x + place.z * u_piece[0] - place.x * u_piece[4]) * u_pieceInverseSize;
  v_pieceX1 = (u_piece[1] - place.x + place.z * u_piece[1] - place.x * u_piece[5]) * u_pieceInverseSize;
  v_pieceY0 = (u_piece[2] - place.y + place.z * u_piece[2] - place.y * u_piece[4]) * u_pieceInverseSize;
  v_pieceY1 = (u_piece[3] - place.y + place.z * u_piece[3] - place.y * u_piece[5]) * u_pieceInverseSize;
  v_pieceW0 = (place.z - u_piece[4]) * u_pieceInverseSize;
  v_pieceW1 = (place.z - u_piece[5]) * u_pieceInverseSize;
#endif
}
