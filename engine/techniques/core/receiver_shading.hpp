// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How a receiver fragment obtains the visibility of one light. No GL.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/uniforms.hpp"
#include "framegraph/graph.hpp"
#include "techniques/core/draw_item.hpp"

namespace halfshadow::techniques {

/// A sampler of a program and what it reads: an image of the frame, or a texture of the technique's own.
struct TextureRead {
  device::UniformKey sampler;
  /// In a PassPlan an index into its images; what declaring it answers with has the graph's.
  framegraph::ResourceId resource;
  const gl::Texture* texture = nullptr;  ///< instead of `resource`; set from `own` by uploading
  std::optional<std::uint32_t> own;      ///< in PassPlan::textures
};

/// How receiver fragments that need the filter are kept apart from those that do not.
enum class FilterSkip {
  none,    ///< every fragment runs the same code
  branch,  ///< `if` around the taps
  loop,    ///< a tap loop that ends at the fragment's own count
  stencil  ///< a first draw decides what needs no filter and tags it in depth; a second draw filters the rest
};
/// Of the setting value "branch", "loop" or "stencil".
FilterSkip filterSkipFromName(std::string_view name);

struct ReceiverShading {
  std::string fragmentFile;          ///< below shaders_es2/; defines halfshadow_visibility()
  std::vector<std::string> defines;  ///< of the variant
  std::vector<TextureRead> textures;
  device::UniformList uniforms;
  /// Uniforms that differ from receiver to receiver; may be empty.
  std::function<void(const DrawItem&, device::UniformList&)> itemUniforms;
  glm::dmat4 mapFromWorld{
      1.0};  ///< world -> (s·z, t·z, d·z, z); screen-space techniques use z alone, or none
  FilterSkip skip = FilterSkip::none;
  /// With FilterSkip::stencil: the filter need not decide again, of receivers that the first draw leaves to
  /// it.
  bool filterTrustsClasses = false;
  bool usesFacetPlane = false;  ///< receiver-plane bias: by facet stream or by derivatives, per mesh
  /// Receivers compiled with HS_CASTING_RECEIVER: means over regions of the map would mislead them.
  enum class SelfReceivers { none, casting, all } selfReceivers = SelfReceivers::none;
  /// With SelfReceivers::casting, what they are drawn by instead, with nothing defined; empty:
  /// `fragmentFile`.
  std::string castingFile;
  /// With SelfReceivers::casting, these objects too, though they cast nothing themselves.
  std::vector<std::uint64_t> alsoCasting;
  bool forward = true;  ///< may be evaluated inside a host's own fragment shader
};

enum class ReceiverOutput {
  visibility,    ///< 8 bits, light i in channel i (a single light in all four)
  visibility16,  ///< one light, two bytes: red high, green low, value = (256 high + low) / 65280
  taps,          ///< fetches of each pixel's visibility function: red low byte, green high byte
  shaded         ///< lit colour of one light, visibility evaluated in the same pass
};

/// How the receivers' colours reach the target.
struct ReceiverTarget {
  std::array<bool, 4> colorMask{true, true, true, true};
  bool depthIsComplete = false;  ///< an earlier light of the pass has drawn all depths
  bool additive = false;         ///< blend ONE, ONE
  /// Receivers in the same place get depths a step apart, by their place in the list: only one of them is
  /// found again where sums over pixels must not count both. For all draws of a depth buffer or none.
  bool depthsApart = false;
};

}  // namespace halfshadow::techniques
