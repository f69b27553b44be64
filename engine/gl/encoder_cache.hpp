// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What the encoder remembers of the context (internal to Encoder).
#pragma once

#include "gl/encoder.hpp"
#include "gl/state_list.hpp"

namespace halfshadow::gl {

/// An offset into the bound buffer, where the API wants a pointer.
inline const void* bufferOffset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

/// What the encoder knows to be set. An empty optional is unknown, so the next set is sent.
struct Encoder::Cache {
  /// The last value sent for one state type; `set` sends only a different one.
  template <typename State>
  struct Entry {
    std::optional<typename State::Type> value;
    void set(const Functions& gl, const typename State::Type& wanted) {
      if (value == wanted) return;
      State::set(gl, wanted);
      value = wanted;
    }
  };
  template <GLenum capability>
  using Flag = Entry<state::Enable<capability>>;

  // Fixed state.
  Entry<state::DepthFunc> depthFunc;
  Entry<state::DepthMask> depthMask;
  Entry<state::CullFaceMode> cullFace;
  Entry<state::BlendFunc> blendFunc;
  Entry<state::BlendEquation> blendEquation;
  Entry<state::ColorMask> colorMask;
  Entry<state::ScissorBox> scissorBox;
  Entry<state::PolygonOffset> polygonOffset;
  Entry<state::DepthRange> depthRange;
  Entry<state::StencilFunc<GL_FRONT>> stencilFuncFront;
  Entry<state::StencilFunc<GL_BACK>> stencilFuncBack;
  Entry<state::StencilOps<GL_FRONT>> stencilOpsFront;
  Entry<state::StencilOps<GL_BACK>> stencilOpsBack;
  Entry<state::StencilWriteMask<GL_FRONT>> stencilMaskFront;
  Entry<state::StencilWriteMask<GL_BACK>> stencilMaskBack;
  Entry<state::Viewport> viewport;
  Entry<state::ClearColor> clearColor;
  Entry<state::ClearDepth> clearDepth;
  Entry<state::ClearStencil> clearStencil;
  Flag<GL_DEPTH_TEST> depthTest;
  Flag<GL_CULL_FACE> cull;
  Flag<GL_BLEND> blend;
  Flag<GL_STENCIL_TEST> stencilTest;
  Flag<GL_SCISSOR_TEST> scissorTest;
  Flag<GL_POLYGON_OFFSET_FILL> polygonOffsetFill;

  // Bindings: what is wanted, and what is known to be bound.
  struct Attribute {
    std::uint32_t buffer = 0;
    int components = 0;
    AttributeType type = AttributeType::float32;
    int strideBytes = 0;
    std::size_t offsetBytes = 0;
    bool operator==(const Attribute&) const = default;
  };
  struct Bindings {
    std::optional<std::uint32_t> program, framebuffer, arrayBuffer, indexBuffer;
    std::array<std::optional<std::uint32_t>, state::kTextureUnits> textures;
    std::optional<int> activeUnit;
    std::array<std::optional<Attribute>, state::kVertexAttributes> attributes;
    std::array<std::optional<bool>, state::kVertexAttributes> attributeEnabled;
  };
  Bindings bound;
  std::uint64_t boundRevision = 0;
  std::uint32_t wantedProgram = 0;
  std::array<std::uint32_t, state::kTextureUnits> wantedTextures{};
  std::optional<std::uint32_t>
      countedFramebuffer;  // survives stale bindings: a rebind of the same is no switch

  const Framebuffer* pass = nullptr;
};

}  // namespace halfshadow::gl
