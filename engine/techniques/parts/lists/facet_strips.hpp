// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The facets of a tree's leaf in strips, so that most of them take one vertex in place of three.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "outlines/facet_tree.hpp"

namespace halfshadow::techniques {

/// A vertex, and the facet that it makes with the two before it or, where it `turns`, with the two before it
/// but one.
struct StripVertex {
  enum class Facet {
    none,   ///< a strip begins
    along,  ///< its corners in the order in which they came are counter-clockwise, as those of a loop
    against
  };
  glm::vec3 ti{0.0f};
  bool turns = false;
  Facet facet = Facet::none;
};

/// Makes strips of one leaf after another.
class FacetStrips {
 public:
  /// Appends the facets of a leaf of the tree, each once.
  void append(const outlines::FacetTree& tree, const outlines::FacetTree::Node& leaf,
              std::vector<StripVertex>& vertices);

 private:
  /// One that begins with the first facet left, at one of its corners, as far as it goes.
  struct Strip {
    std::vector<StripVertex> vertices;
    std::vector<std::uint32_t> loops;  ///< of the facets that it takes
  };
  void extend(const outlines::FacetTree& tree, Strip& strip, std::size_t rotation) const;

  std::vector<std::uint32_t> left_;  ///< loops of facets that no strip has yet
  Strip strips_[3];
};

}  // namespace halfshadow::techniques
