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
  const std::vector<ResourceId>& images;
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

/// Whether a proof of one holds for the other: draws of a pass mostly differ in what they draw alone.
bool usesAlike(const PlannedDraw& a, const PlannedDraw& b) {
  const device::BlendState &p = a.state.blend, &q = b.state.blend;
  return !std::holds_alternative<ReceiversDraw>(a.what) && a.program == b.program &&
         a.textures.size() == b.textures.size() && p.enabled == q.enabled && p.equation == q.equation &&
         p.source == q.source && p.destination == q.destination && a.state.colorMask == b.state.colorMask &&
         a.state.depth.test == b.state.depth.test && a.state.depth.write == b.state.depth.write;
}

gl::Cull culledFaces(const MeshDraw& meshes, const DrawItem& item) {
  if (meshes.faces == MeshDraw::Faces::all) return gl::Cull::none;
  if (meshes.faces == MeshDraw::Faces::facing) return unseenFaces(item, meshes.eyeWorld, meshes.nearReach);
  const gl::Cull hidden = hiddenFaces(item, meshes.eyeWorld, meshes.nearReach);
  return meshes.faces == MeshDraw::Faces::turned ? turnedRound(hidden) : hidden;
}

/// Draws over the viewport what `draw` says of the image as the CPU changed it.
void drawReadBack(framegraph::PassContext& context, gl::Program& program, const gl::Texture& image,
                  const PlannedDraw& draw, const ReadBackDraw& back) {
  gl::Context& gl = context.encoder.context();
  auto framebuffer = gl::Framebuffer::create(gl, {.color = &image});
  if (!framebuffer) return gl.noteFault(framebuffer.error().message);
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(back.width) * back.height * 4);
  context.encoder.readPixels(*framebuffer, {0, 0, back.width, back.height}, rgba.data());
  back.change(rgba);
  auto changed = gl::Texture::create(gl, {.width = back.width, .height = back.height}, rgba.data());
  if (!changed) return gl.noteFault(changed.error().message);
  context.encoder.useProgram(program);
  const gl::TextureBinding binding{program.samplerUnit(back.sampler), &*changed};
  context.encoder.bindTextures({&binding, 1});
  context.encoder.drawFullscreen(draw.state);
}
}  // namespace

Status LightPasses::prepare(const LightScene& scene, std::span<const ItemHistory::Key> casterKeys,
                            const ListChanges& casterChanges) {
  plan_ = {};
  if (Status s = planner_->plan(scene, plan_); !s) return s;
  updates_.begin(plan_, updateRuleOf(scene.settings), {scene.casters, casterKeys, casterChanges});
  return {};
}

Status LightPasses::upload(Device& device) {
  if (Status s = link(device); !s) return s;
  if (Status s = uploadTextures(device); !s) return s;
  return uploadBuffers(device);
}

Status LightPasses::link(Device& device) {
  programs_.clear();
  for (const device::ProgramVariant& variant : plan_.programs) {
    auto program = device.programs.get(variant);
    if (!program) return program.error();
    programs_.push_back(*program);
  }
  cutting_.clear();
  receivers_.clear();
  std::span<const DrawItem> looked;
  std::uint32_t lookedFor = 0;
  for (const PlannedPass& pass : plan_.passes) {
    std::vector<ReceiverProgramSet>& sets = receivers_.emplace_back();
    for (std::size_t i = 0; i < pass.draws.size(); ++i) {
      if (const auto* meshes = std::get_if<MeshDraw>(&pass.draws[i].what)) {
        const std::uint32_t program = pass.draws[i].program;
        // Views of one light draw the same items.
        const bool again = looked.data() == meshes->items.data() && looked.size() == meshes->items.size() &&
                           lookedFor == program;
        looked = meshes->items, lookedFor = program;
        if (again || !device.holes) continue;
        if (Status s = linkCutting(device, program, meshes->items); !s) return s;
      }
      const auto* receivers = std::get_if<ReceiversDraw>(&pass.draws[i].what);
      if (receivers == nullptr) continue;
      auto set = receiverPrograms(
          device.programs, receivers->shading,
          {.output = receivers->output, .depthIsComplete = receivers->target.depthIsComplete},
          receivers->items);
      if (!set) return set.error();
      sets.resize(i + 1);
      sets[i] = *set;
    }
  }
  return {};
}

Status LightPasses::linkCutting(Device& device, std::uint32_t program, std::span<const DrawItem> items) {
  for (const DrawItem& item : items) {
    if (item.alphaMask == nullptr) continue;
    gl::Program*& slot = cutting_[{program, item.vertexColors}];
    if (slot != nullptr) continue;
    device::ProgramVariant variant = plan_.programs[program];
    variant.defines.emplace_back("HS_ALPHA_MASK");
    if (item.vertexColors) variant.defines.emplace_back("HS_VERTEX_COLORS");
    auto linked = device.programs.get(variant);
    if (!linked) return linked.error();
    slot = *linked;
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
      own.key = 0;
      const Pixels pixels = planned.pixels();
      if (own.texture && own.texture.desc() == planned.desc) {
        own.texture.update(device.context, 0, 0, planned.desc.width, planned.desc.height, pixels->data());
      } else {
        auto made = gl::Texture::create(device.context, planned.desc, pixels->data());
        if (!made) return made.error();
        own.texture = std::move(made).value();
      }
      own.key = planned.key;
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
  std::unordered_map<std::uint64_t, OwnBuffer> kept;
  buffersOfPlan_.clear();
  for (const PlannedBuffer& planned : plan_.buffers) {
    OwnBuffer& own = kept[planned.id];
    if (const auto held = buffers_.find(planned.id); held != buffers_.end()) own = std::move(held->second);
    if (own.key == planned.key || planned.bytes->empty()) continue;
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
  buffers_ = std::move(kept);
  for (const PlannedBuffer& planned : plan_.buffers)
    buffersOfPlan_.push_back(&buffers_.at(planned.id).buffer);
  return {};
}

void LightPasses::addUses(ProgramUses& uses) const {
  const auto descOf = [&](ResourceId image) -> const framegraph::ResourceDesc& {
    return plan_.images[image.index];
  };
  for (std::size_t pass = 0; pass < plan_.passes.size(); ++pass) {
    const std::vector<PlannedDraw>& draws = plan_.passes[pass].draws;
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const PlannedDraw& draw = draws[i];
      if (const auto* receivers = std::get_if<ReceiversDraw>(&draw.what)) {
        uses.addReceivers(receivers_[pass][i], receivers->shading, receivers->target, descOf);
      } else if (i == 0 || !usesAlike(draws[i - 1], draw)) {
        uses.add(*programs_[draw.program], draw.state, draw.textures, descOf);
      }
      if (std::holds_alternative<MeshDraw>(draw.what)) addCuttingUses(uses, draw, descOf);
    }
  }
}

/// Of whatever draw of the plan has them: link() found them by what is drawn.
void LightPasses::addCuttingUses(ProgramUses& uses, const PlannedDraw& draw,
                                 const ProgramUses::DescOf& descOf) const {
  for (const bool colored : {false, true}) {
    const auto linked = cutting_.find({draw.program, colored});
    if (linked != cutting_.end()) uses.add(*linked->second, draw.state, draw.textures, descOf);
  }
}

LightPasses::Images LightPasses::declareImages(framegraph::Graph& graph) const {
  Images images;
  for (std::size_t i = 0; i < plan_.images.size(); ++i) {
    const auto& declared = graph.resources();
    const auto found = plan_.imageIsShared[i] ? std::ranges::find(declared, plan_.images[i].name,
                                                                  &framegraph::ResourceDesc::name)
                                              : declared.end();
    images.push_back(found == declared.end()
                         ? graph.addResource(plan_.images[i])
                         : ResourceId{static_cast<std::uint32_t>(found - declared.begin())});
  }
  return images;
}

void LightPasses::declarePass(std::size_t index, const Images& images, FramePasses& frame) {
  const PlannedPass& planned = plan_.passes[index];
  auto parts = std::make_shared<std::vector<SharedPass::Part>>();
  if (planned.drawsForAllLights) {
    const auto known = std::ranges::find(frame.shared, planned.name, &SharedPass::name);
    if (known != frame.shared.end()) {
      known->parts->push_back({this, index, images});
      return;
    }
    frame.shared.push_back({planned.name, parts});
  }
  parts->push_back({this, index, images});
  const Placed placed{images};
  framegraph::PassDesc pass{.name = planned.name,
                            .stage = planned.stage,
                            .reads = readsOf(planned),
                            .writes = planned.writes,
                            .contentKey = planned.contentKey,
                            .update = updates_.updateOf(index),
                            .rebindReason = planned.rebindReason};
  for (ResourceId& read : pass.reads) read = placed.of(read);
  for (framegraph::Attachment& write : pass.writes) write.resource = placed.of(write.resource);
  pass.execute = [parts, shared = planned.drawsForAllLights,
                  &view = frame.view](framegraph::PassContext& context) {
    for (std::size_t i = 0; i < parts->size(); ++i) {
      const SharedPass::Part& part = (*parts)[i];
      const std::size_t first = i == 0 ? 0 : *shared;
      part.light->run(part.pass, first, view, part.images, context);
    }
  };
  frame.graph.addPass(std::move(pass));
}

ReceiverShading LightPasses::declare(FramePasses& frame) {
  const Images images = declareImages(frame.graph);
  for (std::size_t i = 0; i < plan_.passes.size(); ++i) declarePass(i, images, frame);
  for (const auto& note : plan_.notes) frame.graph.noteSkipped(note.what, note.why);
  ReceiverShading shading = plan_.shading;
  Placed{images}.place(shading);
  return shading;
}

void LightPasses::run(std::size_t pass, std::size_t firstDraw, const View& view, const Images& images,
                      framegraph::PassContext& context) {
  updates_.drawn(pass, context.updates ? MapUpdates::Extent::update : MapUpdates::Extent::whole);
  if (context.updates) return runUpdate(pass, images, context);
  const std::vector<PlannedDraw>& draws = plan_.passes[pass].draws;
  for (std::size_t i = firstDraw; i < draws.size(); ++i) {
    if (draws[i].viewport) context.encoder.setViewport(*draws[i].viewport);
    if (const auto* receivers = std::get_if<ReceiversDraw>(&draws[i].what)) {
      ReceiverShading shading = receivers->shading;
      Placed{images}.place(shading);
      drawReceivers(context, shading, receivers_[pass][i], view, receivers->items, nullptr,
                    receivers->target);
    } else {
      runDraw(draws[i], images, context);
    }
  }
}

void LightPasses::runUpdate(std::size_t pass, const Images& images, framegraph::PassContext& context) const {
  const std::vector<PlannedDraw>& draws = plan_.passes[pass].draws;
  const std::vector<MapUpdates::DrawPart>& parts = updates_.parts(pass);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    if (parts[i].items.empty()) continue;
    if (draws[i].viewport) context.encoder.setViewport(*draws[i].viewport);
    drawMeshes(draws[i], std::get<MeshDraw>(draws[i].what), images, context, &parts[i]);
  }
}

void LightPasses::runDraw(const PlannedDraw& draw, const Images& images,
                          framegraph::PassContext& context) const {
  gl::Encoder& encoder = context.encoder;
  gl::Program& program = *programs_[draw.program];
  const Placed placed{images};
  if (const auto* back = std::get_if<ReadBackDraw>(&draw.what)) {
    drawReadBack(context, program, context.texture(placed.of(back->image)), draw, *back);
    return;
  }
  if (const auto* meshes = std::get_if<MeshDraw>(&draw.what)) {
    drawMeshes(draw, *meshes, images, context);
    return;
  }
  setUp(encoder, program, draw, images, context);
  if (const auto* triangles = std::get_if<BufferDraw>(&draw.what)) {
    drawBuffers(encoder, draw, *triangles);
  } else {
    encoder.drawFullscreen(draw.state);
  }
}

void LightPasses::setUp(gl::Encoder& encoder, gl::Program& program, const PlannedDraw& draw,
                        const Images& images, framegraph::PassContext& context) const {
  const Placed placed{images};
  encoder.useProgram(program);
  program.set(encoder.context(), draw.uniforms);
  std::vector<gl::TextureBinding> bindings;
  for (const TextureRead& read : draw.textures) {
    bindings.push_back({program.samplerUnit(read.sampler),
                        read.texture ? read.texture : &context.texture(placed.of(read.resource))});
  }
  if (!bindings.empty()) encoder.bindTextures(bindings);
}

void LightPasses::drawMeshes(const PlannedDraw& draw, const MeshDraw& meshes, const Images& images,
                             framegraph::PassContext& context, const MapUpdates::DrawPart* part) const {
  gl::Encoder& encoder = context.encoder;
  gl::DrawState state = draw.state;
  if (part != nullptr) state.scissor = part->part.rect();
  gl::Program* current = nullptr;
  const std::size_t count = part != nullptr ? part->items.size() : meshes.items.size();
  for (std::size_t i = 0; i < count; ++i) {
    const DrawItem& item = meshes.items[part != nullptr ? part->items[i] : i];
    const bool cut = item.alphaMask != nullptr;
    gl::Program& program = cut ? *cutting_.at({draw.program, item.vertexColors}) : *programs_[draw.program];
    if (&program != current) setUp(encoder, program, draw, images, context);
    current = &program;
    if (cut) bindAlphaMask(encoder, program, item);
    state.cull = culledFaces(meshes, item);
    program.set(encoder.context(), meshes.clipFromObject,
                glm::mat4(meshes.clipFromWorld * item.worldFromObject));
    item.mesh->draw(encoder, state, meshes.streams, cut ? MeshExtras::alpha : MeshExtras::none);
  }
}

void LightPasses::drawBuffers(gl::Encoder& encoder, const PlannedDraw& draw,
                              const BufferDraw& triangles) const {
  std::vector<gl::AttributeBinding> bindings;
  for (const BufferDraw::Attribute& attribute : triangles.attributes) {
    bindings.push_back({attribute.attribute, buffersOfPlan_[attribute.buffer], attribute.components,
                        attribute.type, attribute.strideBytes, attribute.offsetBytes});
  }
  const bool indexed = triangles.indexType != device::IndexType::none;
  encoder.draw(draw.state, {.attributes = bindings,
                            .indices = indexed ? buffersOfPlan_[triangles.indices] : nullptr,
                            .indexType = triangles.indexType,
                            .first = triangles.first,
                            .count = triangles.count});
}

}  // namespace halfshadow::techniques
