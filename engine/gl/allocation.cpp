// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/allocation.hpp"

namespace halfshadow::gl {

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void drainErrors(const Functions& gl) {
  for (int i = 0; i < 32 && gl.getError() != GL_NO_ERROR; ++i) {
  }
}

Status allocationStatus(const Functions& gl, const std::string& what) {
  const GLenum error = gl.getError();
  if (error == GL_NO_ERROR) return {};
  drainErrors(gl);
  if (error == GL_OUT_OF_MEMORY) {
    return Error{ErrorCode::outOfMemory,
                 what + " does not fit into the driver's memory; ask for a smaller one."};
  }
  return Error{ErrorCode::capabilityMissing, what + " is refused by this driver (GL error " +
                                                 std::to_string(error) + "); choose another format."};
}

Error lostError(const std::string& what) {
  return {ErrorCode::contextLost, what + " cannot be made: the context was lost; create a new one."};
}

}  // namespace halfshadow::gl
