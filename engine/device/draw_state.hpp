// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How a draw meets what its target holds, and where its vertices come from, as data. No GL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "base/rect.hpp"

namespace halfshadow::device {

enum class Compare { never, less, lequal, equal, greater, gequal, notEqual, always };
enum class Cull { none, back, front };
enum class BlendFactor {
  zero,
  one,
  srcColor,
  oneMinusSrcColor,
  dstColor,
  oneMinusDstColor,
  srcAlpha,
  oneMinusSrcAlpha,
  dstAlpha,
  oneMinusDstAlpha
};
enum class BlendEquation { add, subtract, reverseSubtract, min, max };
enum class StencilOp { keep, zero, replace, incrWrap, decrWrap, incr, decr, invert };

struct DepthState {
  Compare test = Compare::always;
  bool write = false;
  bool operator==(const DepthState&) const = default;
};
struct BlendState {
  bool enabled = false;
  BlendEquation equation = BlendEquation::add;
  BlendFactor source = BlendFactor::one, destination = BlendFactor::zero;
  bool operator==(const BlendState&) const = default;
};
struct StencilFace {
  Compare test = Compare::always;
  StencilOp stencilFail = StencilOp::keep, depthFail = StencilOp::keep, pass = StencilOp::keep;
  bool operator==(const StencilFace&) const = default;
};
struct StencilState {
  bool enabled = false;
  int reference = 0;
  std::uint32_t readMask = 0xff, writeMask = 0xff;
  StencilFace front, back;
  bool operator==(const StencilState&) const = default;
};
struct DrawState {
  DepthState depth;
  Cull cull = Cull::none;
  BlendState blend;
  StencilState stencil;
  std::array<bool, 4> colorMask{true, true, true, true};
  std::optional<Rect> scissor;             ///< window coordinates of the target
  std::optional<glm::vec2> polygonOffset;  ///< factor, units
  glm::vec2 depthRange{0.0f, 1.0f};        ///< window depths of clip depths -1 and 1
  bool operator==(const DrawState&) const = default;
};

/// Vertex attributes have fixed locations, the same in every program.
enum class VertexAttribute : std::uint32_t {
  position = 0,
  normal = 1,
  texcoord = 2,
  extra0 = 3,
  extra1 = 4,
  extra2 = 5,
  extra3 = 6,
  extra4 = 7
};
enum class AttributeType { float32, unorm8, snorm8, unorm16, snorm16 };
enum class IndexType { none, uint16, uint32 };

}  // namespace halfshadow::device
