// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Constant textures that all lights read, made on first use.
#pragma once

#include <map>
#include <string>

#include "gl/objects.hpp"
#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

class SharedTextures {
 public:
  /// Between these two, what no light asks for is found out, and freed.
  void beginFrame();
  void endFrame();
  /// Valid until endFrame() of a frame that does not ask for it, or forget(). Errors: outOfMemory.
  Result<const gl::Texture*> get(gl::Context& context, const PlannedTexture& planned);
  void forget() { textures_.clear(); }

 private:
  struct Shared {
    gl::Texture texture;
    bool used = false;
  };
  std::map<std::string, Shared, std::less<>> textures_;
};

}  // namespace halfshadow::techniques
