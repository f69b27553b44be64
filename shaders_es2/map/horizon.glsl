// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Share of a light above the horizon of the fragment's facet. What is below it, a closed caster hides itself, since the
// way there begins inside, and an open one as far as it is a body. Maps cannot tell: there the caster is thinner than
// any bias.
// Receivers that are no casters have none, and HS_SHORT leaves it out.
#if defined(HS_CASTING_RECEIVER) && !defined(HS_SHORT)
#define HS_HORIZON
#endif
uniform HS_HIGHP vec4 u_lightSides;  // texels per unit of depth from one side of the light to the other, xy along u, zw along v
uniform HS_HIGHP vec4 u_receiver;    // x: solidity of a caster, 1 for a closed one; else 0

// above: how far its centre is above the horizon, 1 for a light that faces the facet's own gradient; share: of the
// light's sides. Needs half_plane.glsl.
float hs_shareAbove(HS_HIGHP vec2 gradient, HS_HIGHP float above, HS_HIGHP vec2 share) {
  return hs_shareInside(above, abs(vec2(dot(gradient, u_lightSides.xy), dot(gradient, u_lightSides.zw))) * share);
}

// Of the whole light.
float hs_lightAbove() {
#ifndef HS_HORIZON
  return 1.0;
#else
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 gradient = hs_centerGradient;
#else
  HS_HIGHP vec2 gradient = hs_gradient;
#endif
  return u_receiver.x > 0.0 ? 1.0 - u_receiver.x * (1.0 - hs_shareAbove(gradient, 1.0, vec2(1.0))) : 1.0;
#endif
}

#ifdef HS_SUB_LIGHTS_U
// Of the sub-light that was entered.
float hs_subLightAbove() {
#ifndef HS_HORIZON
  return 1.0;
#else
  if (u_receiver.x <= 0.0) return 1.0;
  HS_HIGHP vec2 share = vec2(1.0 / float(HS_SUB_LIGHTS_U), 1.0 / float(HS_SUB_LIGHTS_V));
  return 1.0 - u_receiver.x * (1.0 - hs_shareAbove(hs_centerGradient, hs_turned, share));
#endif
}
#endif
