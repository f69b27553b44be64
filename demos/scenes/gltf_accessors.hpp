// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Numbers out of glTF accessors: every byte range is checked before it is read (internal).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

/// `count` elements of `components` numbers, zeros where the accessor has no bytes; normalised integers are
/// already divided out, all are finite.
struct AccessorValues {
  std::size_t count = 0;
  std::size_t components = 1;
  std::vector<double> numbers;
  const double* operator[](std::size_t element) const { return numbers.data() + element * components; }
};

/// Which accessors a use allows.
struct AccessorUse {
  std::string name;            ///< for messages, e.g. "POSITION of mesh 2"
  std::size_t components = 1;  ///< 16 = a 4×4 matrix by columns
  bool integersOnly = false;   ///< indices and joints: unsigned and not normalised
};

Result<AccessorValues> readAccessor(const tinygltf::Model& model, int index, const AccessorUse& use);

/// [begin, end) of a buffer view's bytes, or an error when it overruns its buffer.
struct ByteRange {
  const unsigned char* begin = nullptr;
  std::size_t size = 0;
};
Result<ByteRange> bytesOfView(const tinygltf::Model& model, int viewIndex);

/// What an extension names by its number; -1, which nothing has, where it is no whole number from 0 that an
/// int holds.
int indexIn(const tinygltf::Value& number);

}  // namespace halfshadow::scenes
