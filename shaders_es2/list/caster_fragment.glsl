// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A fragment of a caster's volume: the receiver behind it, and the caster's list of silhouette vertices. Receivers
// are split by height: those behind the whole caster, and with HS_CASTING_RECEIVER the others, for which loops must be
// cut at the receiver's height. Each volume answers for one kind. Needs receiver_position.glsl and list_vertices.glsl.
varying HS_HIGHP vec3 v_casterList;   // column and row of the list; i that splits receivers, in steps: whole numbers
varying HS_HIGHP vec4 v_casterSides;  // low a and b, high a and b: change over height of where shadows end
varying HS_HIGHP vec2 v_casterStage;  // other volumes answer for receivers with an i above x, or not above y
uniform HS_HIGHP vec4 u_casterLight;  // low and high corner of the part of the light that is meant
// Of the receiver's place, whose last coordinate is its height, or z of homogeneous (t, i) where heights are about equal:
// height = x + y · last, z = z + w · last.
uniform HS_HIGHP vec4 u_casterPlace;
uniform HS_HIGHP mat3 u_facetLift;  // the place's change over a distance of 1 along each axis of the world
uniform HS_HIGHP vec4 u_liftSize;   // world lengths of a unit of each coordinate; rounding of a distance, as a share
uniform HS_HIGHP float u_lightUnit; // world length by which heights are counted

#ifdef HS_CASTING_RECEIVER
#define HS_CasterWalk HS_CutWalk
#define hs_startCasterWalk hs_startCutWalk
#define hs_casterWalk hs_cutWalk
#else
#define HS_CasterWalk HS_Walk
#define hs_startCasterWalk hs_startWalk
#define hs_casterWalk hs_walk
#endif

// False where the caster shadows nothing, or another volume answers.
bool hs_casterReaches(out HS_HIGHP vec2 at, out HS_HIGHP vec3 origin) {
  HS_HIGHP vec4 stored = hs_storedReceiver();
  HS_HIGHP vec3 position = hs_positionOf(stored);
  HS_HIGHP vec3 list = floor(v_casterList + 0.5);
  at = hs_vertexAt(list.x, list.y);
  HS_HIGHP vec3 center = hs_beginList(at);
  // A surface must not be cut by the silhouettes of its own edges, whose vertices are known to half a step.
  HS_HIGHP float height = max(u_casterPlace.x + u_casterPlace.y * position.z, 0.0);
  HS_HIGHP float plain = (u_casterPlace.z + u_casterPlace.w * position.z) / max(height, u_listPlace.x);
  bool staged = plain <= v_casterStage.x && plain > v_casterStage.y;
  HS_HIGHP vec2 beside = (abs(position.xy) + hs_step.x / hs_step.z) * u_liftSize.xy;
  HS_HIGHP float stepSize = hs_step.z * height * (beside.x + beside.y + height * u_lightUnit);
  HS_HIGHP float rounding = u_liftSize.w * dot(abs(position - u_receiverEye.xyz), u_liftSize.xyz);
  position += (u_listPlace.z * (stepSize + rounding)) * (u_facetLift * hs_facetOf(stored));
  height = u_casterPlace.x + u_casterPlace.y * position.z;
  HS_HIGHP float reciprocal = 1.0 / max(height, u_listPlace.x);
  HS_HIGHP vec3 receiver = vec3(position.xy, u_casterPlace.z + u_casterPlace.w * position.z) * reciprocal;
  origin = hs_originFrom(center, receiver, vec3(0.0));
  bool behind = receiver.z <= center.z + list.z * hs_step.z;
#ifdef HS_CASTING_RECEIVER
  behind = !behind;
#endif
  HS_HIGHP vec4 inside = vec4(receiver.xy - receiver.z * u_casterLight.zw - v_casterSides.xy,
                              v_casterSides.zw - receiver.xy + receiver.z * u_casterLight.xy);
  return staged && behind && height > u_listPlace.x && min(min(inside.x, inside.y), min(inside.z, inside.w)) > 0.0;
}
