// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Shader files that exist only in memory.
#pragma once

#include <map>
#include <string>

#include "gl/program.hpp"

namespace halfshadow::test {

using ShaderFiles = std::map<std::string, std::string, std::less<>>;

/// paint.vert (a_position at depth u_z), paint.frag (u_color), show.frag (u_texture at the pixel of a 4x4
/// target).
inline ShaderFiles paintFiles() {
  return {{"paint.vert",
           "attribute vec2 a_position;\nuniform float u_z;\n"
           "void main() { gl_Position = vec4(a_position, u_z, 1.0); }\n"},
          {"paint.frag", "uniform vec4 u_color;\nvoid main() { gl_FragColor = u_color; }\n"},
          {"show.frag",
           "uniform HS_HIGHP sampler2D u_texture;\n"
           "void main() { gl_FragColor = texture2D(u_texture, gl_FragCoord.xy / 4.0); }\n"}};
}

inline gl::ShaderSourceProvider provide(ShaderFiles files) {
  return [files = std::move(files)](std::string_view name) -> const char* {
    const auto found = files.find(name);
    return found == files.end() ? nullptr : found->second.c_str();
  };
}

}  // namespace halfshadow::test
