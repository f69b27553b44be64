// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "receiver/tap_count.glsl"
float halfshadow_visibility() { return 1.0; }
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
