// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The only caller of glDraw*, glClear and glBindFramebuffer. Counts what it does; caches the state it set.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "device/draw_state.hpp"
#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "gl/timers.hpp"

namespace halfshadow::gl {

using device::AttributeType;
using device::BlendEquation;
using device::BlendFactor;
using device::BlendState;
using device::Compare;
using device::Cull;
using device::DepthState;
using device::DrawState;
using device::IndexType;
using device::StencilFace;
using device::StencilOp;
using device::StencilState;
using halfshadow::Rect;

struct AttributeBinding {
  VertexAttribute attribute = VertexAttribute::position;
  const Buffer* buffer = nullptr;
  int components = 3;
  AttributeType type = AttributeType::float32;
  int strideBytes = 0;
  std::size_t offsetBytes = 0;
};
/// What one draw reads. Not owning.
struct Geometry {
  std::span<const AttributeBinding> attributes;
  const Buffer* indices = nullptr;
  IndexType indexType = IndexType::none;
  std::size_t first = 0;  ///< first vertex or index
  std::size_t count = 0;  ///< vertices or indices; triangles only
};

/// A texture and the unit it is read from: Program::samplerUnit. A negative unit is ignored (the variant has
/// no such sampler).
struct TextureBinding {
  int unit = 0;
  const Texture* texture = nullptr;
};

struct ClearValues {
  std::optional<glm::vec4> color;
  std::optional<float> depth;
  std::optional<int> stencil;
};
struct PassBegin {
  const Framebuffer* framebuffer = nullptr;
  Rect viewport;
  ClearValues clear;
  std::span<const Rect> clearParts;  ///< that the clear stays inside of; none: all of the attachments
};
/// Attachments whose content nobody reads after the pass.
struct PassEnd {
  bool discardColor = false, discardDepth = false, discardStencil = false;
};

struct Counters {
  std::uint64_t draws = 0;
  std::uint64_t triangles = 0;
  std::uint64_t framebufferSwitches = 0;
  std::uint64_t clears = 0;
  std::uint64_t programSwitches = 0;
  std::uint64_t uniformUploads = 0;
  std::uint64_t textureUploadBytes = 0;
  std::uint64_t bufferUploadBytes = 0;
  Counters operator-(const Counters& earlier) const;
};

class Encoder {
 public:
  explicit Encoder(Context& context);
  ~Encoder();

  /// Forgets cached state; call at the start of a frame, since the host may have changed anything. Disables
  /// dither and sets the pixel-store and sample state that every pass relies on.
  void beginFrame();
  void beginPass(const PassBegin& begin);
  void endPass(const PassEnd& end);
  /// Another part of the pass's framebuffer, for several images in one target.
  void setViewport(const Rect& viewport);

  /// Makes the program current; uniforms may then be set on it through `program.set(context, …)`.
  void useProgram(Program& program);
  void bindTextures(std::span<const TextureBinding> bindings);
  void draw(const DrawState& state, const Geometry& geometry);
  /// One triangle that covers the viewport; the program reads a_position (two floats in clip space).
  void drawFullscreen(const DrawState& state);

  /// RGBA bytes of a rectangle of the framebuffer bound by the last beginPass or given here; bottom row
  /// first.
  void readPixels(const Framebuffer& framebuffer, const Rect& rect, std::uint8_t* rgba);
  void finish();

  /// Of this encoder; uploads count everything sent through its context.
  Counters& counters();
  Context& context() { return context_; }

 private:
  void dropStaleBindings();
  void bindProgram();
  void bindWanted();
  void applyState(const DrawState& state);
  void applyAttributes(std::span<const AttributeBinding> attributes);
  void bindFramebuffer(std::uint32_t name);
  Context& context_;
  Counters counters_;
  Context::Uploads countedUploads_;
  Buffer fullscreenTriangle_;
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace halfshadow::gl
