// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A fragment of a caster's volume: the receiver behind it, and the caster's list of silhouette vertices. Receivers
// are split by height: those behind the whole caster, and with HS_CASTING_RECEIVER the others, for which loops must be
// cut at the receiver's height. Each volume answers for one kind. Needs receiver_position.glsl and list_vertices.glsl.
varying HS_HIGHP vec3 v_casterList;   // column and row of the list; i that splits receivers, in steps: whole numbers
varying HS_HIGHP vec4 v_casterSides;  // low a and b, high a and b: change over height of where shadows end
uniform HS_HIGHP mat3 u_facetLift;    // (a, b, h) by which a facet that faces along an axis of the world is lifted
uniform HS_HIGHP vec4 u_casterLight;  // low and high corner of the part of the light that is meant

// False where the caster shadows nothing, or another volume answers.
bool hs_casterReaches(out HS_HIGHP vec2 at, out HS_HIGHP vec3 origin) {
  HS_HIGHP vec4 stored = hs_storedReceiver();
  HS_HIGHP vec3 position = hs_positionOf(stored);
  // A surface must not be cut by the silhouettes of its own edges.
  position += u_facetLift * hs_facetOf(stored);
  HS_HIGHP float reciprocal = 1.0 / max(position.z, u_listCenter.w);
  HS_HIGHP vec3 receiver = vec3(position.xy * reciprocal, reciprocal);
  HS_HIGHP vec3 list = floor(v_casterList + 0.5);
  at = hs_vertexAt(list.x, list.y);
  origin = hs_originFrom(receiver);
  bool behind = reciprocal <= u_listCenter.z + list.z * u_listScale.z;
#ifdef HS_CASTING_RECEIVER
  behind = !behind;
#endif
  HS_HIGHP vec4 inside = vec4(receiver.xy - reciprocal * u_casterLight.zw - v_casterSides.xy,
                              v_casterSides.zw - receiver.xy + reciprocal * u_casterLight.xy);
  return behind && position.z > u_listCenter.w && min(min(inside.x, inside.y), min(inside.z, inside.w)) > 0.0;
}
