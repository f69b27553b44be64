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
  /// Valid until forget(). Errors: outOfMemory.
  Result<const gl::Texture*> get(gl::Context& context, const PlannedTexture& planned);
  void forget() { textures_.clear(); }

 private:
  std::map<std::string, gl::Texture, std::less<>> textures_;
};

}  // namespace halfshadow::techniques
