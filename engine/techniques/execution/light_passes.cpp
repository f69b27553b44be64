// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/light_passes.hpp"

#include <algorithm>

#include "techniques/execution/gpu_mesh.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::ResourceId;

/// Of the plan's images in the graph.
struct Placed {
  std::span<const ResourceId> images;
  ResourceId of(ResourceId image) const { return images[image.index]; }
  void place(ReceiverShading& shading) const {
    for (TextureRead& read : shading.textures) {
      if (read.texture == nullptr) read.resource = of(read.resource);
    }
  }
};

void addRead(std::vector<ResourceId>& reads, ResourceId image) {
  if (std::ranges::find(reads, image) == reads.end()) reads.push_back(image);
}

std::vector<ResourceId> readsOf(const PlannedPass& pass) {
  std::vector<ResourceId> reads;
  const auto add = [&](const std::vector<TextureRead>& textures) {
    for (const TextureRead& read : textures) {
      if (!read.own) addRead(reads, read.resource);
    }
  };
  for (const PlannedDraw& draw : pass.draws) {
    add(draw.textures);
    if (const auto* receivers = std::get_if<ReceiversDraw>(&draw.what)) add(receivers->shading.textures);
    if (const auto* back = std::get_if<ReadBackDraw>(&draw.what)) addRead(reads, back->image);
  }
  return reads;
}

gl::Cull culledFaces(const MeshDraw& meshes, const DrawItem& item) {
  if (meshes.faces == MeshDraw::Faces::all) return gl::Cull::none;
  const gl::Cull hidden = hiddenFaces(item, meshes.eyeWorld, meshes.nearReach);
  return meshes.faces == MeshDraw::Faces::turned ? turnedRound(hidden) : hidden;
}

GpuMesh::Streams streamsOf(MeshStreams streams) {
  switch (streams) {
    case MeshStreams::positions:
      return GpuMesh::Streams::positions;
    case MeshStreams::facet:
      return GpuMesh::Streams::facet;
    case MeshStreams::shading:
      return GpuMesh::Streams::shading;
  }
  return GpuMesh::Streams::positions;
}

/// Draws over the viewport what `draw` says of the image as the CPU changed it. Without memory for the copy
/// the target stays as it was cleared.
void drawReadBack(framegraph::PassContext& context, gl::Program& program, const gl::Texture& image,
                  const PlannedDraw& draw, const ReadBackDraw& back) {
  gl::Context& gl = context.encoder.context();
  auto framebuffer = gl::Framebuffer::create(gl, {.color = &image});
  if (!framebuffer) return;
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(back.width) * back.height * 4);
  context.encoder.readPixels(*framebuffer, {0, 0, back.width, back.height}, rgba.data());
  back.change(rgba);
  auto changed = gl::Texture::create(gl, {.width = back.width, .height = back.height}, rgba.data());
  if (!changed) return;
  context.encoder.useProgram(program);
  const gl::TextureBinding binding{program.samplerUnit(back.sampler), &*changed};
  context.encoder.bindTextures({&binding, 1});
  context.encoder.drawFullscreen(draw.state);
}
}  // namespace

Status LightPasses::prepare(const LightScene& scene) {
  plan_ = {};
  return planner_->plan(scene, plan_);
}

Status LightPasses::upload(Device& device) {
  if (Status s = link(device); !s) return s;
  if (Status s = uploadTextures(device); !s) return s;
  return uploadBuffers(device);
}

Status LightPasses::link(Device& device) {
  programs_.clear();
  for (const PlannedPass& pass : plan_.passes) {
    std::vector<DrawPrograms>& linked = programs_.emplace_back();
    for (const PlannedDraw& draw : pass.draws) {
      DrawPrograms& programs = linked.emplace_back();
      if (const auto* receivers = std::get_if<ReceiversDraw>(&draw.what)) {
        auto set = receiverPrograms(device.programs, receivers->shading, receivers->output, receivers->items);
        if (!set) return set.error();
        programs.receivers = *set;
        continue;
      }
      auto program = device.programs.get(draw.program);
      if (!program) return program.error();
      programs.program = *program;
    }
  }
  return {};
}

Status LightPasses::uploadTextures(Device& device) {
  std::erase_if(textures_, [&](const auto& held) {
    return std::ranges::find(plan_.textures, held.first, &PlannedTexture::name) == plan_.textures.end();
  });
  texturesOfPlan_.clear();
  for (const PlannedTexture& planned : plan_.textures) {
    if (planned.forAllLights) {
      auto shared = device.shared.get(device.context, planned);
      if (!shared) return shared.error();
      texturesOfPlan_.push_back(*shared);
      continue;
    }
    OwnTexture& own = textures_[planned.name];
    if (own.key != planned.key) {
      own = {};
      auto made = gl::Texture::create(device.context, planned.desc, planned.pixels().data());
      if (!made) return made.error();
      own = {planned.key, std::move(made).value()};
    }
    texturesOfPlan_.push_back(&own.texture);
  }
  const auto resolve = [&](std::vector<TextureRead>& textures) {
    for (TextureRead& read : textures) {
      if (read.own) read.texture = texturesOfPlan_[*read.own];
    }
  };
  resolve(plan_.shading.textures);
  for (PlannedPass& pass : plan_.passes) {
    for (PlannedDraw& draw : pass.draws) {
      resolve(draw.textures);
      if (auto* receivers = std::get_if<ReceiversDraw>(&draw.what)) resolve(receivers->shading.textures);
    }
  }
  return {};
}

Status LightPasses::uploadBuffers(Device& device) {
  buffers_.resize(plan_.buffers.size());
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    const PlannedBuffer& planned = plan_.buffers[i];
    OwnBuffer& own = buffers_[i];
    if (own.key == planned.key || !planned.bytes || planned.bytes->empty()) continue;
    own.key = 0;
    if (own.buffer) {
      if (Status s = own.buffer.update(device.context, *planned.bytes); !s) return s;
    } else {
      const auto target =
          planned.kind == PlannedBuffer::Kind::vertices ? gl::BufferTarget::vertex : gl::BufferTarget::index;
      auto made = gl::Buffer::create(device.context, target, *planned.bytes, gl::BufferUsage::dynamicDraw);
      if (!made) return made.error();
      own.buffer = std::move(made).value();
    }
    own.key = planned.key;
  }
  return {};
}

ReceiverShading LightPasses::declare(const View& view, framegraph::Graph& graph) const {
  auto images = std::make_shared<std::vector<ResourceId>>();
  for (const framegraph::ResourceDesc& desc : plan_.images) images->push_back(graph.addResource(desc));
  const Placed placed{*images};
  for (std::size_t i = 0; i < plan_.passes.size(); ++i) {
    const PlannedPass& planned = plan_.passes[i];
    framegraph::PassDesc pass{.name = planned.name,
                              .stage = planned.stage,
                              .reads = readsOf(planned),
                              .writes = planned.writes,
                              .contentKey = planned.contentKey,
                              .rebindReason = planned.rebindReason};
    for (ResourceId& read : pass.reads) read = placed.of(read);
    for (framegraph::Attachment& write : pass.writes) write.resource = placed.of(write.resource);
    pass.execute = [this, i, &view, images](framegraph::PassContext& context) {
      run(i, view, *images, context);
    };
    graph.addPass(std::move(pass));
  }
  for (const auto& note : plan_.notes) graph.noteSkipped(note.what, note.why);
  ReceiverShading shading = plan_.shading;
  placed.place(shading);
  return shading;
}

void LightPasses::run(std::size_t pass, const View& view, std::span<const ResourceId> images,
                      framegraph::PassContext& context) const {
  gl::Encoder& encoder = context.encoder;
  const Placed placed{images};
  const std::vector<PlannedDraw>& draws = plan_.passes[pass].draws;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const PlannedDraw& draw = draws[i];
    if (draw.viewport) encoder.setViewport(*draw.viewport);
    if (const auto* receivers = std::get_if<ReceiversDraw>(&draw.what)) {
      ReceiverShading shading = receivers->shading;
      placed.place(shading);
      drawReceivers(context, shading, programs_[pass][i].receivers, view, receivers->items, nullptr,
                    receivers->target);
      continue;
    }
    gl::Program& program = *programs_[pass][i].program;
    if (const auto* back = std::get_if<ReadBackDraw>(&draw.what)) {
      drawReadBack(context, program, context.texture(placed.of(back->image)), draw, *back);
      continue;
    }
    encoder.useProgram(program);
    program.set(encoder.context(), draw.uniforms);
    std::vector<gl::TextureBinding> bindings;
    for (const TextureRead& read : draw.textures) {
      bindings.push_back({program.samplerUnit(read.sampler),
                          read.texture ? read.texture : &context.texture(placed.of(read.resource))});
    }
    if (!bindings.empty()) encoder.bindTextures(bindings);
    if (const auto* meshes = std::get_if<MeshDraw>(&draw.what)) {
      drawMeshes(encoder, program, draw, *meshes);
    } else if (const auto* triangles = std::get_if<BufferDraw>(&draw.what)) {
      drawBuffers(encoder, draw, *triangles);
    } else {
      encoder.drawFullscreen(draw.state);
    }
  }
}

void LightPasses::drawMeshes(gl::Encoder& encoder, gl::Program& program, const PlannedDraw& draw,
                             const MeshDraw& meshes) const {
  gl::DrawState state = draw.state;
  for (const DrawItem& item : meshes.items) {
    state.cull = culledFaces(meshes, item);
    program.set(encoder.context(), meshes.clipFromObject,
                glm::mat4(meshes.clipFromWorld * item.worldFromObject));
    item.mesh->draw(encoder, state, streamsOf(meshes.streams));
  }
}

void LightPasses::drawBuffers(gl::Encoder& encoder, const PlannedDraw& draw,
                              const BufferDraw& triangles) const {
  std::vector<gl::AttributeBinding> bindings;
  for (const BufferDraw::Attribute& attribute : triangles.attributes) {
    bindings.push_back({attribute.attribute, &buffers_[attribute.buffer].buffer, attribute.components,
                        attribute.type, attribute.strideBytes, attribute.offsetBytes});
  }
  const bool indexed = triangles.indexType != device::IndexType::none;
  encoder.draw(draw.state, {.attributes = bindings,
                            .indices = indexed ? &buffers_[triangles.indices].buffer : nullptr,
                            .indexType = triangles.indexType,
                            .first = triangles.first,
                            .count = triangles.count});
}

std::uint64_t LightPasses::memoryBytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [name, own] : textures_) {
    const gl::TextureDesc& desc = own.texture.desc();
    bytes += static_cast<std::uint64_t>(desc.width) * desc.height * gl::bytesPerTexel(desc.format);
  }
  for (const OwnBuffer& own : buffers_) bytes += own.buffer.byteCount();
  return bytes;
}

}  // namespace halfshadow::techniques
