// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Drawing the receivers with a technique's visibility function: as an image of visibilities, as counts of
/// taps, or shaded in one forward pass.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "framegraph/executor.hpp"
#include "gl/program.hpp"
#include "techniques/core/light_scene.hpp"
#include "techniques/core/receiver_shading.hpp"

namespace halfshadow::techniques {

struct ShadingInputs {
  std::span<const scene::AreaLight>
      lights;          ///< one when visibility is evaluated in the same pass, else up to four
  double scale = 1.0;  ///< of the world, see shade.glsl: a power of two
  double farthestEye = std::numeric_limits<double>::infinity();  ///< scaled; what is farther is brought near
};
/// apart: from visibilities on the screen.
ShadingInputs shadingInputs(std::span<const scene::AreaLight> lights, bool apart,
                            std::span<const DrawItem> receivers, const device::Capabilities& capabilities);
/// By which all receivers are within 1 of the first light: a power of two.
double shadingScale(const scene::AreaLight& first, std::span<const DrawItem> receivers);

/// Lit colours from the visibilities of all lights that an earlier pass left in `visibility`.
ReceiverShading shadeFromScreen(framegraph::ResourceId visibility);

/// Programs of one light, ready to draw; made while declaring so that a shader error is a frame's error.
struct ReceiverPrograms {
  gl::Program* whole = nullptr;     ///< every fragment
  gl::Program* classify = nullptr;  ///< FilterSkip::stencil: draws what needs no filter, discards the rest
  gl::Program* filter = nullptr;    ///< FilterSkip::stencil: the rest
};
/// What of an item selects its programs.
struct ReceiverKind {
  bool facets = false;    ///< its facet stream is drawn
  bool textured = false;  ///< its base colour texture is read
  bool casting = false;   ///< it is in the map itself, and the technique minds
  bool cut = false;       ///< alpha cuts holes into it
  bool colored = false;   ///< colours of its vertices are read
  bool dark = false;      ///< of one colour, so dark that the sky shows in it
  bool behind = false;    ///< not all of it lies before all the lights' planes
  int index() const {
    return facets + 2 * textured + 4 * casting + 8 * cut + 16 * colored + 32 * dark + 64 * behind;
  }
};
struct ReceiverProgramSet {
  ReceiverPrograms byKind[128];
  bool twoDraws = false;
  ReceiverPrograms& of(const ReceiverKind& kind) { return byKind[kind.index()]; }
  const ReceiverPrograms& of(const ReceiverKind& kind) const { return byKind[kind.index()]; }
};
struct ReceiverRequest {
  ReceiverOutput output = ReceiverOutput::visibility;
  std::span<const scene::AreaLight> lights{};  ///< that shade: what none of them needs is not compiled in
  bool depthIsComplete = false;                ///< of the target
};
/// Links what `items` need. Errors: shaderFailed.
Result<ReceiverProgramSet> receiverPrograms(gl::ProgramCache& programs, const ReceiverShading& shading,
                                            const ReceiverRequest& request, std::span<const DrawItem> items);

/// What drawReceivers() draws with, whatever the item.
gl::DrawState receiverState(const ReceiverTarget& target);

/// Draws all items; called inside a pass whose reads include the shading's resources.
/// `shadingInputs`: of ReceiverOutput::shaded, else null.
void drawReceivers(framegraph::PassContext& context, const ReceiverShading& shading,
                   const ReceiverProgramSet& programs, const View& view, std::span<const DrawItem> items,
                   const ShadingInputs* shadingInputs, const ReceiverTarget& target);

/// What decides the texts of a host's own shaders.
struct ForwardVariant {
  std::string fragmentFile;
  std::vector<std::string> defines;
  std::vector<device::UniformKey> samplers;
  bool usesFacetPlane = false;
  std::uint64_t key = 0;  ///< of the texts; never 0
};
ForwardVariant forwardVariant(const ReceiverShading& shading);

/// Of an item that alpha cuts: sets what alpha_mask.glsl reads of the current program.
void bindAlphaMask(gl::Encoder& encoder, gl::Program& program, const DrawItem& item);

/// Texts for a host's own shaders, see ForwardRecord. Errors: shaderFailed.
struct ForwardTexts {
  std::string vertex, fragment;
};
Result<ForwardTexts> forwardTexts(const gl::ProgramCache& programs, const ForwardVariant& variant);
/// Names by unit of the textures that hosts' programs read, as far as they are known to be bound.
using ForwardUnits = std::array<std::uint32_t, 32>;
/// Where a host's program, which is current, gets what the fragment text reads.
struct ForwardBinding {
  const glm::dmat4& worldFromObject;
  int firstTextureUnit = 0;
  ForwardUnits& bound;
  const framegraph::Executor& executor;
  const framegraph::Graph& graph;
};
void bindForward(gl::Context& context, gl::Program& program, const ReceiverShading& shading,
                 const ForwardBinding& binding);
/// The same of a light that shadows nothing: everything is lit, and no image is read.
void bindForwardLit(gl::Context& context, gl::Program& program, const ForwardVariant& variant,
                    int firstTextureUnit);

/// Resources that the pass must list as read.
std::vector<framegraph::ResourceId> resourcesRead(const ReceiverShading& shading);

}  // namespace halfshadow::techniques
