// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the silhouette vertices that matter for the fragment's tile of its receiver. The including file defines
// HS_SUB_LIGHTS, the number of sub-lights. Needs list_vertices.glsl and half_plane.glsl.
// HS_ON_SCREEN: of the receiver that an earlier pass left on the screen; needs screen_receiver.glsl, too.
#ifdef HS_ON_SCREEN
#define HS_PLANE hs_facetPlane
bool hs_onReceiver = false;  // the object's own pixel
#else
#ifdef HS_FACET_NORMAL
varying HS_HIGHP vec4 v_facetPlane;  // dot(v_facetPlane, v_map) = 0 on the facet
#define HS_PLANE v_facetPlane
#ifndef HS_NO_HIGHP
#define HS_EXACT_PLACE
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
// Direction of a pixel's ray, like v_map: u_rayX · x + u_rayY · y + u_rayOrigin, x and y from 0 to 1.
uniform HS_HIGHP vec4 u_rayX;
uniform HS_HIGHP vec4 u_rayY;
uniform HS_HIGHP vec4 u_rayOrigin;
#endif
#endif
uniform HS_HIGHP vec4 u_eyeLight;  // the eye, like v_map
varying HS_HIGHP vec4 v_map;       // (t, i) = xyz / w, w: the height over the light
#endif
uniform HS_HIGHP sampler2D u_cellTiles;
uniform HS_HIGHP vec2 u_tileSqueeze;    // of tangents, so that endless ones have a tile
uniform HS_HIGHP vec4 u_tileOfTangent;  // tile = squeezed tangent · xy + zw
uniform HS_HIGHP vec4 u_tileAtlas;      // xy: columns and rows of the receiver's tiles, zw: first texel
#if defined(HS_CASTING_RECEIVER) && (defined(HS_PLANE) || defined(HS_DERIVATIVES))
#define HS_LIFTED
#ifndef HS_NO_HIGHP
#define HS_LIMITED  // by the facet: half precision does not know its plane well enough
#endif
#endif

HS_HIGHP vec3 hs_receiver = vec3(0.0);  // (t, i)
HS_HIGHP vec3 hs_away = vec3(0.0);      // signs of the directions in which it leaves its facet
HS_HIGHP vec4 hs_head = vec4(0.0);      // xyz: where the list begins
HS_HIGHP float hs_lit = 0.0;            // of HS_SUB_LIGHTS, those that nothing covers
bool hs_outside = false;                // of all shadows
bool hs_listed = false;
bool hs_apart = false;  // no two casters of the list overlap
#ifdef HS_AMONG_RECEIVERS
bool hs_among = false;  // some vertices may lie beside or behind the receiver
#endif
#ifdef HS_LIMITED
// Of the light, the share that lies before the receiver's own facet; no more of it is seen. The lists alone let a receiver
// that stands a step off its facet look past the facet's edge.
HS_HIGHP float hs_beforeFacet = 1.0;
HS_HIGHP float hs_facetSlack = 0.0;  // what differences of places may turn hs_facet by, which is no shadow
#ifdef HS_HALF
#define HS_LIGHT_PART hs_lightRow(float(HS_HALF))
#else
#define HS_LIGHT_PART vec4(0.0, 0.0, 2.0, 2.0)
#endif
// Middle and sides of the light's lower or upper half.
HS_HIGHP vec4 hs_lightRow(HS_HIGHP float row) { return vec4(0.0, row - 0.5, 2.0, 1.0); }

// Of that part of the light.
HS_HIGHP float hs_shareBefore(HS_HIGHP vec4 part) {
  HS_HIGHP vec3 size = abs(hs_facet);
  HS_HIGHP float unit = 1.0 / max(max(size.x, size.y), max(size.z, HS_SMALL));
  HS_HIGHP float above = dot(hs_facet, vec3(part.xy, 1.0)) + hs_facetSlack;
  return hs_shareInside(unit * above, unit * part.zw * size.xy);
}
#endif

// Finds the fragment's tile, and where it stands.
void hs_findList() {
#ifdef HS_ON_SCREEN
  HS_HIGHP vec4 position = hs_map;
#else
  HS_HIGHP vec4 position = v_map;
#endif
#ifdef HS_EXACT_PLACE
  // Rasterisers snap vertices, some to a sixteenth of a pixel, and interpolate to match: a narrow penumbra shows
  // that. The pixel's own ray meets the facet's plane where it should.
  HS_HIGHP vec2 window = gl_FragCoord.xy * u_viewport.xy + u_viewport.zw;
  HS_HIGHP vec4 ray = window.x * u_rayX + window.y * u_rayY + u_rayOrigin;
  HS_HIGHP float across = dot(v_facetPlane, ray);
  HS_HIGHP float along = -dot(v_facetPlane, u_eyeLight) / (abs(across) < HS_SMALL ? HS_SMALL : across);
  HS_HIGHP vec4 met = u_eyeLight + along * ray;
  // By no more than half a pixel: what is farther off is a neighbour's fragment, or numbers that cancelled.
  HS_HIGHP vec4 moved = abs(met - position), pixel = abs(along * u_viewport.x * u_rayX);
  HS_HIGHP float alongHeight =
      (across - dot(v_facetPlane.xy, ray.xy)) / (abs(ray.w) < HS_SMALL ? HS_SMALL : ray.w);
  HS_HIGHP float slant = min(
      length(vec3(v_facetPlane.xy, alongHeight)) * length(ray.xyw) / max(abs(across), HS_SMALL), 8.0);
  if (max(max(moved.x, moved.y), moved.w) < 0.5 * slant * max(max(pixel.x, pixel.y), pixel.w)) position = met;
#endif
  HS_HIGHP float reciprocal = 1.0 / max(position.w, u_listPlace.x);
  hs_receiver = position.xyz * reciprocal;
  HS_HIGHP vec2 squeezed = hs_receiver.xy / (1.0 + abs(hs_receiver.xy) * u_tileSqueeze);
  HS_HIGHP vec2 tile = floor(squeezed * u_tileOfTangent.xy + u_tileOfTangent.zw);
  hs_outside = position.w < u_listPlace.x || min(tile.x, tile.y) < 0.0 || tile.x >= u_tileAtlas.x ||
                 tile.y >= u_tileAtlas.y;
#ifdef HS_ON_SCREEN
  // Loops end where nothing is listed; a discarded fragment may go on with those beside it.
  hs_outside = hs_outside || !hs_onReceiver;
#endif
  HS_COUNT(1);
  hs_head = floor(texture2D(u_cellTiles, (tile + u_tileAtlas.zw + 0.5) * u_cellTexel.xy) * 255.0 + 0.5);
  // Alpha: sub-lights that nothing covers, 16 where there is a list, 32 where its casters are apart, 64 where vertices
  // lie among the receivers.
#ifdef HS_AMONG_RECEIVERS
  hs_among = !hs_outside && hs_head.a > 63.5;
#endif
  hs_head.a = mod(hs_head.a, 64.0);
  hs_listed = !hs_outside && hs_head.a > 15.5;
  hs_apart = !hs_outside && hs_head.a > 31.5;
  hs_lit = hs_outside ? HS_SUB_LIGHTS : mod(hs_head.a, 16.0);
#ifdef HS_LIFTED
  // A surface must not be cut by the silhouettes of its own edges. Planes stay planes in (t, i).
#ifdef HS_PLANE
  HS_HIGHP vec3 n = HS_PLANE.xyz;
  hs_receiver -= n * ((dot(n, hs_receiver) + HS_PLANE.w) / max(dot(n, n), HS_SMALL));
#else
  HS_HIGHP vec3 alongX = dFdx(hs_receiver), alongY = dFdy(hs_receiver);
  HS_HIGHP vec3 n = cross(alongX, alongY);
#ifdef HS_LIMITED
  HS_HIGHP vec3 turn = abs(alongX) + abs(alongY), place = u_listPlace.w * abs(hs_receiver);
  hs_facetSlack = dot(place.yzx * turn.zxy + place.zxy * turn.yzx, vec3(1.0));
#endif
#endif
  // Towards the eye: that side of the surface is seen.
  n *= dot(n, u_eyeLight.xyz - u_eyeLight.w * hs_receiver) < 0.0 ? -1.0 : 1.0;
  hs_away = sign(n);
  hs_facet = n;
  // No light falls on this side of a facet that all of it lies behind.
  if (!hs_outside && n.z < -abs(n.x) - abs(n.y)) {
    hs_listed = hs_apart = false;
    hs_lit = 0.0;
  }
#ifdef HS_LIMITED
  if (!hs_outside) hs_beforeFacet = hs_shareBefore(HS_LIGHT_PART);
#endif
#endif
}

// Visible sub-lights as far as the receiver's own facet lets them be seen.
HS_HIGHP float hs_limitedLight(HS_HIGHP float visible) {
#ifdef HS_LIMITED
#ifdef HS_HALF
  return min(visible, 0.5 + 0.5 * hs_beforeFacet);
#else
  return min(visible, HS_SUB_LIGHTS * hs_beforeFacet);
#endif
#else
  return visible;
#endif
}

#ifdef HS_ONE_SIDED
void hs_roundFacet() {
  HS_HIGHP vec3 rounding = 4.0 * hs_step + HS_PLANE_ROUNDING * u_listPlace.w * abs(hs_receiver);
#ifdef HS_ON_SCREEN
  rounding += hs_placeRounding;
#endif
  hs_facetRounding = dot(abs(hs_facet), rounding);
}
#endif

// Goes to the first vertex of the fragment's list. Returns what hs_nextVertex() adds to its vertices.
HS_HIGHP vec3 hs_enterList(out HS_HIGHP vec2 at) {
  at = hs_vertexAt(hs_head.r, hs_head.g + 256.0 * hs_head.b);
  HS_HIGHP vec3 center = hs_beginList(at);
#ifdef HS_ONE_SIDED
  hs_roundFacet();
#endif
  return hs_originFrom(center, hs_receiver, hs_away);
}
