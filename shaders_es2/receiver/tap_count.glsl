// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Counts the fetches of the visibility function, in the variant that measures them.
#ifdef HS_COUNT_TAPS
float hs_taps = 0.0;
#define HS_COUNT(n) hs_taps += float(n)
#else
#define HS_COUNT(n)
#endif
