// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The files of shaders_es2/, compiled in, or read again from a directory while working on them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gl/program.hpp"

namespace halfshadow::gl {

/// Text of a shader file by its path below shaders_es2/, or null. Fits ShaderSourceProvider.
const char* embeddedShader(std::string_view fileName);
/// Names of all embedded files, sorted.
std::vector<std::string_view> embeddedShaderNames();

/// Reads files below `path` at every request, for reloading: clear the ProgramCache and shaders are read
/// anew. A returned text stays valid until the same file is asked for again.
ShaderSourceProvider directoryShaders(std::string path);

}  // namespace halfshadow::gl
