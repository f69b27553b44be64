// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a host's vertex shader needs to receive shadows forward.
#include "receiver/receiver_vertex.glsl"
