// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Small constant textures that several techniques read, made on first use.
#pragma once

#include "gl/objects.hpp"

namespace halfshadow::techniques {

class SharedTextures {
 public:
  /// 512 x 256 texels that turn (d, 256·d) into the two bytes of d, for fragment shaders without highp.
  Result<const gl::Texture*> byteRamp(gl::Context& context);
  void forget() { byteRamp_ = {}; }

 private:
  gl::Texture byteRamp_;
};

}  // namespace halfshadow::techniques
