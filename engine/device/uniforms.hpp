// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Uniforms as data: set by preparation, sent when a program is drawn with. No GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace halfshadow::device {

/// FNV-1a of a uniform's name. Array uniforms use the name without "[0]".
struct UniformKey {
  std::uint32_t hash = 0;
  consteval UniformKey(const char* name) : hash(hashOf(name)) {}
  static constexpr std::uint32_t hashOf(std::string_view name) {
    std::uint32_t h = 2166136261u;
    for (const char c : name) h = (h ^ static_cast<std::uint8_t>(c)) * 16777619u;
    return h;
  }
  bool operator==(const UniformKey&) const = default;
};

/// An array of the shader. No bare std::vector: where an alternative's copy throws, libstdc++ 12 destroys
/// what was never made, unless a variant has an alternative like this one, of which it does not know that
/// moving never throws.
template <typename Vector>
class UniformArray {
 public:
  UniformArray(std::vector<Vector> values) : values_(std::move(values)) {}
  const Vector* data() const { return values_.data(); }
  std::size_t size() const { return values_.size(); }
  bool operator==(const UniformArray&) const = default;

 private:
  std::vector<Vector> values_;
};

using UniformValue = std::variant<float, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::mat4,
                                  UniformArray<glm::vec2>, UniformArray<glm::vec4>>;

/// A program's uniforms; each once, the last value counts. What a program lacks is ignored.
class UniformList {
 public:
  struct Entry {
    UniformKey key;
    UniformValue value;
    bool operator==(const Entry&) const = default;
  };
  void set(UniformKey key, UniformValue value);
  void clear() { entries_.clear(); }
  const std::vector<Entry>& entries() const { return entries_; }
  bool operator==(const UniformList&) const = default;

 private:
  std::vector<Entry> entries_;
};

}  // namespace halfshadow::device
