// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Every piece of OpenGL ES state that the engine touches, one small type each: Type, kName, initial, get,
/// set. Capture, restore, defaults and the hostile-host test are loops over StateList.
#pragma once

#include <tuple>
#include <utility>

#include "gl/state_bindings.hpp"
#include "gl/state_fixed.hpp"

namespace halfshadow::gl::state {

template <typename Units, typename Attributes>
struct MakeList;
template <int... units, int... attributes>
struct MakeList<std::integer_sequence<int, units...>, std::integer_sequence<int, attributes...>> {
  // Captured first to last, set last to first: the selectors (active unit, array buffer) come first because
  // the entries that follow them disturb them. The framebuffer comes last: drivers clamp stencil values to
  // the bits of the bound one.
  using Type = std::tuple<
      ActiveTexture, TextureBinding2D<units>..., ArrayBuffer,
      AttributeArray<static_cast<GLuint>(attributes)>..., ElementArrayBuffer, CurrentProgram, Viewport,
      ScissorBox, Enable<GL_BLEND>, Enable<GL_CULL_FACE>, Enable<GL_DEPTH_TEST>, Enable<GL_DITHER, true>,
      Enable<GL_POLYGON_OFFSET_FILL>, Enable<GL_SAMPLE_ALPHA_TO_COVERAGE>, Enable<GL_SAMPLE_COVERAGE>,
      Enable<GL_SCISSOR_TEST>, Enable<GL_STENCIL_TEST>, BlendFunc, BlendEquation, BlendColor, ColorMask,
      DepthFunc, DepthMask, DepthRange, StencilFunc<GL_FRONT>, StencilFunc<GL_BACK>, StencilOps<GL_FRONT>,
      StencilOps<GL_BACK>, StencilWriteMask<GL_FRONT>, StencilWriteMask<GL_BACK>, CullFaceMode, FrontFace,
      PolygonOffset, SampleCoverage, ClearColor, ClearDepth, ClearStencil, PixelStore<GL_PACK_ALIGNMENT>,
      PixelStore<GL_UNPACK_ALIGNMENT>, RenderbufferBinding, FramebufferBinding>;
};

/// All of it.
using StateList = MakeList<std::make_integer_sequence<int, kTextureUnits>,
                           std::make_integer_sequence<int, kVertexAttributes>>::Type;

/// The values of a whole list.
template <typename List>
struct ValuesOf;
template <typename... States>
struct ValuesOf<std::tuple<States...>> {
  using Type = std::tuple<typename States::Type...>;
};
using StateValues = ValuesOf<StateList>::Type;

inline constexpr std::size_t kStateCount = std::tuple_size_v<StateList>;

/// Calls `visitor.template operator()<State, index>()` for each entry, first to last.
template <typename Visitor>
void forEachState(Visitor&& visitor) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visitor.template operator()<std::tuple_element_t<i, StateList>, i>(), ...);
  }
  (std::make_index_sequence<kStateCount>());
}
/// The same, last to first.
template <typename Visitor>
void forEachStateReversed(Visitor&& visitor) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visitor.template operator()<std::tuple_element_t<kStateCount - 1 - i, StateList>, kStateCount - 1 - i>(),
     ...);
  }
  (std::make_index_sequence<kStateCount>());
}

/// Reads every value; the state is the same afterwards.
StateValues captureState(const Functions& gl);
void applyState(const Functions& gl, const StateValues& values);
/// Initial values, with the host-sized ones (viewport, scissor box) taken from `host`.
StateValues initialState(const StateValues& host);

}  // namespace halfshadow::gl::state
