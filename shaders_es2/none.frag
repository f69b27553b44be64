// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "depth_storage.glsl"
#include "receiver_inputs.glsl"
float halfshadow_visibility() { return 1.0; }
#include "receiver_main.glsl"
