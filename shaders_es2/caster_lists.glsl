// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the silhouette vertices that matter for the fragment's tile of its receiver. The including file defines
// HS_SUB_LIGHTS, the number of sub-lights. Needs list_vertices.glsl.
#ifdef HS_FACET_NORMAL
varying HS_HIGHP vec2 v_gradient;
#ifndef HS_NO_HIGHP
#define HS_EXACT_PLACE
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP mat3 u_rayLight;  // direction of a pixel's ray in (a, b, h) from (x, y, 1), both 0 to 1
#endif
#endif
uniform HS_HIGHP vec3 u_eyeLight;  // the eye in (a, b, h)
varying HS_HIGHP vec4 v_map;       // (a, b, -, h) in the light's coordinates
uniform HS_HIGHP sampler2D u_cellTiles;
uniform HS_HIGHP vec4 u_tileOfTangent;  // tile = tangent · xy + zw
uniform HS_HIGHP vec4 u_tileAtlas;      // xy: columns and rows of the receiver's tiles, zw: first texel
#if defined(HS_CASTING_RECEIVER) && (defined(HS_FACET_NORMAL) || defined(HS_DERIVATIVES))
#define HS_LIFTED
uniform HS_HIGHP mat3 u_lift;  // lift² times the inner product of gradients in (a, b, h)
#endif

HS_HIGHP vec3 hs_receiver = vec3(0.0);  // (t, i)
HS_HIGHP vec4 hs_head = vec4(0.0);      // xyz: where the list begins
HS_HIGHP float hs_lit = 0.0;            // of HS_SUB_LIGHTS, those that nothing covers
bool hs_outside = false;                // of all shadows
bool hs_listed = false;
bool hs_apart = false;  // no two casters of the list overlap

// Finds the fragment's tile, then where it stands once lifted.
void hs_findList() {
  HS_HIGHP vec3 position = v_map.xyw;
  HS_HIGHP float reciprocal = 1.0 / max(position.z, u_listCenter.w);
#ifdef HS_FACET_NORMAL
  // i = 1 / h has the gradient v_gradient over (a, b) / h: the plane is dot(n, (a, b, h)) = 1.
  HS_HIGHP vec3 n = vec3(v_gradient, reciprocal - reciprocal * dot(v_gradient, position.xy));
#endif
#ifdef HS_EXACT_PLACE
  // Rasterisers snap vertices, some to a sixteenth of a pixel, and interpolate to match: a narrow penumbra shows
  // that. The pixel's own ray meets the facet's plane where it should.
  HS_HIGHP vec3 ray = u_rayLight * vec3(gl_FragCoord.xy * u_viewport.xy + u_viewport.zw, 1.0);
  HS_HIGHP float across = dot(n, ray);
  HS_HIGHP float along = (1.0 - dot(n, u_eyeLight)) / (abs(across) < 1e-12 ? 1e-12 : across);
  HS_HIGHP vec3 met = u_eyeLight + along * ray;
  // By no more than half a pixel: what is farther off is a neighbour's fragment, or numbers that cancelled.
  HS_HIGHP vec3 moved = abs(met - position), pixel = abs(along * u_viewport.x * u_rayLight[0]);
  HS_HIGHP float slant = min(length(n) * length(ray) / max(abs(across), 1e-12), 8.0);
  if (max(max(moved.x, moved.y), moved.z) < 0.5 * slant * max(max(pixel.x, pixel.y), pixel.z)) {
    position = met;
    reciprocal = 1.0 / max(position.z, u_listCenter.w);
  }
#endif
  HS_HIGHP vec2 tile = floor(position.xy * reciprocal * u_tileOfTangent.xy + u_tileOfTangent.zw);
  hs_outside = position.z < u_listCenter.w || min(tile.x, tile.y) < 0.0 || tile.x >= u_tileAtlas.x ||
                 tile.y >= u_tileAtlas.y;
  HS_COUNT(1);
  hs_head = floor(texture2D(u_cellTiles, (tile + u_tileAtlas.zw + 0.5) * u_cellTexel.xy) * 255.0 + 0.5);
  // Alpha: sub-lights that nothing covers, 16 where there is a list, 32 where its casters are apart.
  hs_listed = !hs_outside && hs_head.a > 15.5;
  hs_apart = !hs_outside && hs_head.a > 31.5;
  hs_lit = hs_outside ? HS_SUB_LIGHTS : mod(hs_head.a, 16.0);
#ifdef HS_LIFTED
  // A surface must not be cut by the silhouettes of its own edges.
#ifndef HS_FACET_NORMAL
  HS_HIGHP vec3 n = cross(dFdx(position), dFdy(position));
#endif
  // Towards the eye: that side of the surface is seen.
  n *= dot(n, u_eyeLight - position) < 0.0 ? -1.0 : 1.0;
  HS_HIGHP vec3 lift = u_lift * n;
  position += lift * inversesqrt(max(dot(n, lift), HS_SMALL));
#endif
  reciprocal = 1.0 / max(position.z, u_listCenter.w);
  hs_receiver = vec3(position.xy * reciprocal, reciprocal);
}

// Where the fragment's list begins, and what hs_nextVertex() adds to its vertices.
HS_HIGHP vec2 hs_firstVertex() { return hs_vertexAt(hs_head.r, hs_head.g + 256.0 * hs_head.b); }
HS_HIGHP vec3 hs_listOrigin() { return hs_originFrom(hs_receiver); }
