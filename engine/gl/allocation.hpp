// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Errors of making an object, said alike for all kinds. Internal to the object sources.
#pragma once

#include <string>

#include "gl/context.hpp"

namespace halfshadow::gl {

std::string sizeText(int width, int height);
/// Errors that earlier calls left must not be blamed on the next one.
void drainErrors(const Functions& gl);
/// What glGetError says about the storage just asked for. Errors: outOfMemory, capabilityMissing.
Status allocationStatus(const Functions& gl, const std::string& what);
Error lostError(const std::string& what);

}  // namespace halfshadow::gl
