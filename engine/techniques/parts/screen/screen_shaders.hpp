// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of the receivers' depth on the screen.
#pragma once

#include "techniques/core/shader_families.hpp"

namespace halfshadow::techniques {

inline ShaderFamily receiverDepthShader() {
  return {"screen/receiver_depth.vert",
          "screen/receiver_depth.frag",
          {{{},
            {{"HS_FACET_NORMAL"}},
            {{"HS_FACETS", "HS_FACET_NORMAL"}},
            {{"HS_FACETS"}, {"HS_DERIVATIVES", "!HS_NO_HIGHP"}}},
           alphaAxis()}};
}

inline ShaderFamily receiverFacetShader() {
  return {"screen/receiver_depth.vert",
          "screen/receiver_facets.frag",
          {{{{"HS_FACET_NORMAL"}}, {{"HS_FACETS"}, {"HS_DERIVATIVES", "!HS_NO_HIGHP"}}}, alphaAxis()}};
}

}  // namespace halfshadow::techniques
