// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The project's own files, for tests that read them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace halfshadow::architecture {

struct SourceFile {
  std::string path;  ///< below the project, with '/': "engine/gl/buffer.cpp"
  std::string text;
};

/// All text files of engine/, platform/, demos/, shaders_es2/, tests/ and profiles/, and the root's own;
/// sorted.
const std::vector<SourceFile>& sourceTree();

bool isCpp(const SourceFile& file);     ///< .cpp, .hpp, .c, .h
bool isShader(const SourceFile& file);  ///< .vert, .frag, .glsl

std::vector<std::string> linesOf(std::string_view text);
/// Without // and /* */ comments; line breaks stay. String contents stay.
std::string withoutComments(std::string_view text);

}  // namespace halfshadow::architecture
