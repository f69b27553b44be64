// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// HS_ONE_SEARCH: the whole light's penumbra in the map of the sub-light in its middle gives the width that each begins
// with; where what its taps find asks for another, they are taken again. A search in each would cost several times as much.
//
// One loop over the taps of all sub-lights, four a turn: fragments that are drawn together need not wait for each other
// at every sub-light, and a program holds the taps once. They are taken from the rim inward: where the outer half of them
// agree, so will the others. Needs spread_places.glsl, spread_taps.glsl, penumbra_bounds.glsl and horizon.glsl.
#if defined(HS_ONE_SEARCH) && !defined(HS_SHORT)
// Of a sub-light's penumbra that is so much wider or narrower than the one that was looked at, its taps still tell the
// share; beyond the second, only those of its own do.
#define HS_WIDTH_STANDS 0.1
#define HS_WIDTH_FAILS 0.2
// More than twice the turns of all sub-lights.
#define HS_MOST_STEPS 2048

// gap: mean distance in depth units from the blockers to the fragment.
float hs_meanOverSubLights(HS_HIGHP float gap) {
  const float subLights = float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V);
  // As in spread_places.glsl, of a number that compilers know: they then keep none of it in registers.
  const HS_HIGHP float taps = float(HS_SPREAD_KERNEL * HS_SPREAD_KERNEL);
  const HS_HIGHP float spacing = 1.0 / taps, turns = floor(0.25 * taps), center = taps - 4.0 * turns;
  const HS_HIGHP float low = 0.5 * center * spacing, range = 2.0 * spacing * turns;
  const HS_HIGHP float telling = floor(0.5 * turns + 0.25);
  float sum = 0.0, seen = 0.0, all = 0.0;
  float above = 1.0;
  float before = -1.0;  // share that the first taps found, where they are taken again
  float trust = 0.0;    // in those that are
  HS_HIGHP float index = 0.0, turn = 0.0;
  HS_HIGHP vec2 found = vec2(0.0);
  HS_HIGHP vec2 place = vec2(0.0);
  for (int i = 0; i < HS_MOST_STEPS; ++i) {
    if (index > subLights - 0.5) break;
    bool counts = true;
    // At the rim.
    if (turn < 0.5) {
      place = vec2(low + (2.0 * turns - 1.5) * spacing, 0.31315 + 0.6263 * (turns - 1.0));
      place.y = low + range * fract(place.y);
      found = vec2(0.0);
    }
    if (turn < 0.5 && before < 0.0) {
      hs_enterSubLight(index);
      hs_beginTaps(max(u_penumbra.xy * u_subLightShare.xy * gap, vec2(1.0)), hs_spreadBias());
#ifdef HS_HORIZON
      above = hs_subLightAbove();
      all += above;
      // From below the horizon the caster's own body hides the fragment: what a part that reaches above it sees, the
      // others tell.
      counts = above > 0.0 && hs_turned * u_receiver.x >= 0.0;
#endif
    }
    HS_HIGHP float until = turn < telling - 0.5 ? telling - 0.5 : turns - 0.5;
    for (int k = 0; k < HS_MOST_TURNS; ++k) {
      if (turn > until) break;
      found += hs_blockingTaps(place);
      place -= vec2(2.0 * spacing, 0.6263 * range);
      place.y += step(place.y, low) * range;
      turn += 1.0;
    }
    bool uniformly = turn == telling && before < 0.0 && (found.x < 0.5 || found.x > 4.0 * telling - 0.5);
    if (!counts) {
      index += 1.0;
      turn = 0.0;
    } else if (uniformly || turn > turns - 0.5) {
      HS_HIGHP float count = 4.0 * turn;
      if (!uniformly && center > 0.5) {
        found += hs_blockingTap(vec2(0.0), 0.0);
        count += 1.0;
      }
      float lit = 1.0 - found.x / count;
      HS_HIGHP float own = -found.y / max(found.x, 1.0);
      float off = abs(own / gap - 1.0);
      if (before < 0.0 && off > HS_WIDTH_STANDS && lit > 0.0 && lit < 1.0) {
        before = lit;
        trust = clamp((off - HS_WIDTH_STANDS) * (1.0 / (HS_WIDTH_FAILS - HS_WIDTH_STANDS)), 0.0, 1.0);
        hs_beginTaps(max(u_penumbra.xy * u_subLightShare.xy * own, vec2(HS_NARROWEST)), hs_spreadBias());
      } else {
        sum += above * (before < 0.0 ? lit : mix(before, lit, trust));
        seen += above;
        before = -1.0;
        index += 1.0;
      }
      turn = 0.0;
    }
  }
#ifdef HS_HORIZON
  return sum * (all / (max(seen, 1e-3) * subLights));
#else
  return sum * (1.0 / subLights);
#endif
}
#endif
