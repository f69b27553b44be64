// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/encoder.hpp"

#include <algorithm>

#include "gl/encoder_cache.hpp"

namespace halfshadow::gl {

Counters Counters::operator-(const Counters& earlier) const {
  Counters difference;
  difference.draws = draws - earlier.draws;
  difference.triangles = triangles - earlier.triangles;
  difference.framebufferSwitches = framebufferSwitches - earlier.framebufferSwitches;
  difference.clears = clears - earlier.clears;
  difference.programSwitches = programSwitches - earlier.programSwitches;
  difference.uniformUploads = uniformUploads - earlier.uniformUploads;
  difference.textureUploadBytes = textureUploadBytes - earlier.textureUploadBytes;
  difference.bufferUploadBytes = bufferUploadBytes - earlier.bufferUploadBytes;
  return difference;
}

Encoder::Encoder(Context& context)
    : context_(context), countedUploads_(context.uploads()), cache_(std::make_unique<Cache>()) {}

Encoder::~Encoder() = default;

Counters& Encoder::counters() {
  const Context::Uploads& now = context_.uploads();
  counters_.uniformUploads += now.uniforms - countedUploads_.uniforms;
  counters_.textureUploadBytes += now.textureBytes - countedUploads_.textureBytes;
  counters_.bufferUploadBytes += now.bufferBytes - countedUploads_.bufferBytes;
  countedUploads_ = now;
  return counters_;
}

void Encoder::beginFrame() {
  *cache_ = Cache{};
  if (context_.lost()) return;
  if (!fullscreenTriangle_) {
    constexpr float kCorners[] = {-1, -1, 3, -1, -1, 3};
    Result<Buffer> buffer = Buffer::create(context_, BufferTarget::vertex, std::as_bytes(std::span(kCorners)),
                                           BufferUsage::staticDraw);
    if (buffer) fullscreenTriangle_ = std::move(*buffer);
  }
  const Functions& gl = context_.functions();
  gl.disable(GL_DITHER);  // on at start; it would add noise to data stored in 8 bits
  gl.disable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  gl.disable(GL_SAMPLE_COVERAGE);
  gl.frontFace(GL_CCW);
  gl.pixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.pixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

void Encoder::bindFramebuffer(std::uint32_t name) {
  if (cache_->bound.framebuffer == name) return;
  context_.functions().bindFramebuffer(GL_FRAMEBUFFER, name);
  cache_->bound.framebuffer = name;
  if (cache_->countedFramebuffer != name) ++counters_.framebufferSwitches;
  cache_->countedFramebuffer = name;
}

void Encoder::beginPass(const PassBegin& begin) {
  if (context_.lost()) return;
  Cache& cache = *cache_;
  const Functions& gl = context_.functions();
  cache.pass = begin.framebuffer;
  dropStaleBindings();
  bindFramebuffer(begin.framebuffer->name());
  cache.viewport.set(gl, {begin.viewport.x, begin.viewport.y, begin.viewport.width, begin.viewport.height});

  GLbitfield mask = 0;
  if (begin.clear.color) {
    const glm::vec4& color = *begin.clear.color;
    cache.clearColor.set(gl, {color.x, color.y, color.z, color.w});
    cache.colorMask.set(gl, {1, 1, 1, 1});
    mask |= GL_COLOR_BUFFER_BIT;
  }
  if (begin.clear.depth) {
    cache.clearDepth.set(gl, *begin.clear.depth);
    cache.depthMask.set(gl, 1);
    mask |= GL_DEPTH_BUFFER_BIT;
  }
  if (begin.clear.stencil) {
    cache.clearStencil.set(gl, *begin.clear.stencil);
    cache.stencilMaskFront.set(gl, 0xff);
    cache.stencilMaskBack.set(gl, 0xff);
    mask |= GL_STENCIL_BUFFER_BIT;
  }
  if (mask == 0) return;
  cache.scissorTest.set(gl, begin.clearParts.empty() ? 0 : 1);
  if (begin.clearParts.empty()) gl.clear(mask);
  for (const Rect& part : begin.clearParts) {
    cache.scissorBox.set(gl, {part.x, part.y, part.width, part.height});
    gl.clear(mask);
  }
  counters_.clears += std::max<std::size_t>(begin.clearParts.size(), 1);
}

void Encoder::setViewport(const Rect& viewport) {
  cache_->viewport.set(context_.functions(), {viewport.x, viewport.y, viewport.width, viewport.height});
}

void Encoder::endPass(const PassEnd& end) {
  const Framebuffer* framebuffer = std::exchange(cache_->pass, nullptr);
  if (context_.lost() || !framebuffer || !context_.capabilities().has(device::Capability::discard)) return;
  const bool isDefault = framebuffer->name() == 0;  // whose attachments have other names
  std::array<GLenum, 3> attachments{};
  GLsizei count = 0;
  const auto add = [&](bool wanted, GLenum defaultName, GLenum objectName) {
    if (wanted) attachments[static_cast<std::size_t>(count++)] = isDefault ? defaultName : objectName;
  };
  add(end.discardColor, GL_COLOR_EXT, GL_COLOR_ATTACHMENT0);
  add(end.discardDepth, GL_DEPTH_EXT, GL_DEPTH_ATTACHMENT);
  add(end.discardStencil, GL_STENCIL_EXT, GL_STENCIL_ATTACHMENT);
  if (count == 0) return;
  dropStaleBindings();
  bindFramebuffer(framebuffer->name());
  context_.functions().discardFramebuffer(GL_FRAMEBUFFER, count, attachments.data());
}

void Encoder::useProgram(Program& program) {
  if (context_.lost()) return;
  cache_->wantedProgram = program.name();
  dropStaleBindings();
  bindProgram();
}

void Encoder::bindTextures(std::span<const TextureBinding> bindings) {
  for (const TextureBinding& binding : bindings) {
    if (binding.unit < 0 || binding.unit >= state::kTextureUnits || !binding.texture) continue;
    cache_->wantedTextures[static_cast<std::size_t>(binding.unit)] = binding.texture->name();
  }
}

/// Uploads and deletions since the last call may have moved any binding and freed any name.
void Encoder::dropStaleBindings() {
  Cache& cache = *cache_;
  if (cache.boundRevision == context_.bindingRevision()) return;
  cache.boundRevision = context_.bindingRevision();
  cache.bound = {};
  // Binding a deleted name would make a new, empty texture of it.
  for (std::uint32_t& name : cache.wantedTextures) {
    if (name != 0 && !context_.functions().isTexture(name)) name = 0;
  }
}

void Encoder::bindProgram() {
  Cache& cache = *cache_;
  if (cache.wantedProgram == 0 || cache.bound.program == cache.wantedProgram) return;
  context_.functions().useProgram(cache.wantedProgram);
  cache.bound.program = cache.wantedProgram;
  ++counters_.programSwitches;
}

void Encoder::bindWanted() {
  Cache& cache = *cache_;
  const Functions& gl = context_.functions();
  dropStaleBindings();
  if (cache.pass) bindFramebuffer(cache.pass->name());
  bindProgram();
  for (int unit = 0; unit < state::kTextureUnits; ++unit) {
    const std::uint32_t wanted = cache.wantedTextures[static_cast<std::size_t>(unit)];
    std::optional<std::uint32_t>& bound = cache.bound.textures[static_cast<std::size_t>(unit)];
    if (wanted == 0 || bound == wanted) continue;
    if (cache.bound.activeUnit != unit) gl.activeTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    cache.bound.activeUnit = unit;
    gl.bindTexture(GL_TEXTURE_2D, wanted);
    bound = wanted;
  }
}

void Encoder::draw(const DrawState& state, const Geometry& geometry) {
  if (context_.lost() || geometry.count == 0) return;
  const Functions& gl = context_.functions();
  bindWanted();
  applyState(state);
  applyAttributes(geometry.attributes);
  if (geometry.indexType == IndexType::none) {
    gl.drawArrays(GL_TRIANGLES, static_cast<GLint>(geometry.first), static_cast<GLsizei>(geometry.count));
  } else {
    const std::uint32_t name = geometry.indices->name();
    if (cache_->bound.indexBuffer != name) gl.bindBuffer(GL_ELEMENT_ARRAY_BUFFER, name);
    cache_->bound.indexBuffer = name;
    const bool wide = geometry.indexType == IndexType::uint32;
    gl.drawElements(GL_TRIANGLES, static_cast<GLsizei>(geometry.count),
                    wide ? GL_UNSIGNED_INT : GL_UNSIGNED_SHORT,
                    bufferOffset(geometry.first * (wide ? 4 : 2)));
  }
  ++counters_.draws;
  counters_.triangles += geometry.count / 3;
}

void Encoder::drawFullscreen(const DrawState& state) {
  if (context_.lost() || !fullscreenTriangle_) return;
  const AttributeBinding corner{
      VertexAttribute::position, &fullscreenTriangle_, 2, AttributeType::float32, 8, 0};
  Geometry geometry;
  geometry.attributes = std::span(&corner, 1);
  geometry.count = 3;
  draw(state, geometry);
}

void Encoder::readPixels(const Framebuffer& framebuffer, const Rect& rect, std::uint8_t* rgba) {
  if (context_.lost()) return;
  const Functions& gl = context_.functions();
  dropStaleBindings();
  bindFramebuffer(framebuffer.name());
  gl.pixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.readPixels(rect.x, rect.y, rect.width, rect.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

void Encoder::finish() {
  if (!context_.lost()) context_.functions().finish();
}

}  // namespace halfshadow::gl
