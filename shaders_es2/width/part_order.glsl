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

// Column and row, from 0, of the part that is asked at a turn, from 0.
HS_HIGHP vec2 hs_partAt(HS_HIGHP float turn) {
  // Along rows, two fields at a time; in rows of even length every second row begins with the other colour.
  HS_HIGHP float second = step(float((HS_PARTS + 1) / 2) - 0.5, turn);
  HS_HIGHP float field = 2.0 * (turn - second * float((HS_PARTS + 1) / 2)) + second;
  HS_HIGHP float row = floor((field + 0.5) * (1.0 / float(HS_SUB_LIGHTS_U)));
  HS_HIGHP float column = field - row * float(HS_SUB_LIGHTS_U);
#if HS_SUB_LIGHTS_U == 2 || HS_SUB_LIGHTS_U == 4
  HS_HIGHP float odd = row - 2.0 * floor(0.5 * row);
  column += odd * (1.0 - 2.0 * second);
#endif
  return vec2(column, row);
}
