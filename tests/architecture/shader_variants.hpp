// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Which shader variants the engine may ask for: the one table to extend when a shader or a define is added.
#pragma once

#include <string>
#include <vector>

namespace halfshadow::architecture {

using Defines = std::vector<std::string>;

/// A pair of shader files with the define sets that the engine combines with it.
struct ShaderFamily {
  enum class Depth { independent, perStorage };  ///< whether the variants exist once per way to store depth
  enum class Kind {
    pass,
    receiver
  };  ///< receivers exist once per output, facets with and without derivatives
  std::string vertexFile, fragmentFile;
  Depth depth = Depth::independent;
  Kind kind = Kind::pass;
  std::vector<Defines> defineSets{{}};
  /// Receivers whose mask is evaluated in a draw of its own.
  bool twoDraws = false;
};
const std::vector<ShaderFamily>& shaderFamilies();

/// One variant as a driver would get it.
struct ShaderVariant {
  std::string vertexFile, fragmentFile;
  Defines defines;
  bool highp = true, derivatives = true;
};
/// All variants of all families.
std::vector<ShaderVariant> shaderVariants();

}  // namespace halfshadow::architecture
