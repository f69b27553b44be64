// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Hosts may be older than the engine: the public headers compile alone, as C++17.
#include "halfshadow/halfshadow.hpp"

static_assert(sizeof(halfshadow::ObjectId) == 4);
