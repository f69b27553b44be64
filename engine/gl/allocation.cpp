// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/allocation.hpp"

namespace halfshadow::gl {

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

Status allocationStatus(Context& context, const std::string& what) {
  const GLenum error = context.takeError();
  if (context.lost()) return noNameError(context, what);
  if (error == GL_NO_ERROR) return {};
  for (int i = 0; i < 32 && context.takeError() != GL_NO_ERROR; ++i) {
  }
  if (error == GL_OUT_OF_MEMORY) {
    return Error{ErrorCode::outOfMemory,
                 what + " does not fit into the driver's memory; ask for a smaller one."};
  }
  return Error{ErrorCode::capabilityMissing, what + " is refused by this driver (GL error " +
                                                 std::to_string(error) + "); choose another format."};
}

Error noNameError(const Context& context, const std::string& what) {
  if (context.lost()) {
    return {ErrorCode::contextLost,
            what +
                " cannot be made: the context was lost; make a new one current and call "
                "contextRestored()."};
  }
  return {ErrorCode::outOfMemory,
          what + " cannot be made: the driver gives no name for it; free some objects."};
}

}  // namespace halfshadow::gl
