// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Order in which a split light's parts are asked: every second one first, as the white fields of a chess board, corners
// among them; then the others. Where the first half agrees on all or nothing, what lies between is taken to agree too.
#define HS_PARTS (HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V)
#if HS_PARTS > 4
#define HS_TELLING_PARTS ((HS_PARTS + 1) / 2)
#else
// So few that half of them tell nothing.
#define HS_TELLING_PARTS HS_PARTS
#endif
// Sums of their visibility that are none or all of it: within what 8 bits tell.
#define HS_ALL_DARK 0.004
#define HS_ALL_LIT (float(HS_TELLING_PARTS) - 0.004)

// Column and row, from 0, of the part that is asked after `part`; the first is in the corner. turn: how many were asked. Along
// rows, two fields at a time; in rows of even length every second row begins with the other colour.
HS_HIGHP vec2 hs_partAfter(HS_HIGHP vec2 part, HS_HIGHP float turn) {
  const HS_HIGHP float columns = float(HS_SUB_LIGHTS_U), whites = float((HS_PARTS + 1) / 2);
  part.x += 2.0;
  HS_HIGHP float over = step(columns - 0.5, part.x);
#if HS_SUB_LIGHTS_U == 2 || HS_SUB_LIGHTS_U == 4
  part += over * vec2(1.0 + columns - 2.0 * part.x, 1.0);
#elif HS_SUB_LIGHTS_U == 1
  part = vec2(0.0, part.y + 2.0);
#else
  part += over * vec2(-columns, 1.0);
#endif
#if HS_SUB_LIGHTS_U == 1
  return turn == whites ? vec2(0.0, 1.0) : part;
#else
  return turn == whites ? vec2(1.0, 0.0) : part;
#endif
}
