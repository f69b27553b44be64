// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "framegraph/executor.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "framegraph/resource_pool.hpp"

namespace halfshadow::framegraph {
namespace {

const gl::Texture kNoTexture;

// Two views of different sizes in turn keep their images; a window that was resized loses its old ones.
constexpr int kRunsKept = 5;
// Frames without a change cost nothing, but for the one in which it is certain that the host stands still.
constexpr int kStandstill = 8;

Error lostError() {
  return Error{ErrorCode::contextLost,
               "the OpenGL ES context was lost; make a new one current and call contextRestored()"};
}

// Passes of the plan, by position, in which a resource is first and last touched.
struct Use {
  std::optional<std::size_t> first;
  std::size_t last = 0;
};

std::vector<Use> usesOf(const Graph& graph, const Plan& plan) {
  std::vector<Use> uses(graph.resources().size());
  const auto touch = [&](ResourceId resource, std::size_t position) {
    Use& use = uses[resource.index];
    if (!use.first) use.first = position;
    use.last = position;
  };
  for (std::size_t position = 0; position < plan.passes.size(); ++position) {
    for (const PlannedAttachment& attachment : plan.passes[position].attachments)
      touch(attachment.resource, position);
    for (const ResourceId read : graph.passes()[plan.passes[position].pass].reads) touch(read, position);
  }
  for (const ResourceId output : graph.outputs()) uses[output.index].last = plan.passes.size();
  return uses;
}

gl::ClearValues clearValuesOf(const PlannedPass& planned) {
  gl::ClearValues values;
  for (const PlannedAttachment& attachment : planned.attachments) {
    // What is loaded for an update is cleared in its parts.
    if (attachment.load != LoadAction::clear && !planned.updates) continue;
    const float* color = attachment.clear.color;
    const bool depthStencil = attachment.point == AttachmentPoint::depthStencil;
    if (attachment.point == AttachmentPoint::color)
      values.color = glm::vec4(color[0], color[1], color[2], color[3]);
    if (depthStencil || attachment.point == AttachmentPoint::depth) values.depth = attachment.clear.depth;
    if (depthStencil || attachment.point == AttachmentPoint::stencil)
      values.stencil = attachment.clear.stencil;
  }
  return values;
}

gl::PassEnd discardsOf(const PlannedPass& planned) {
  gl::PassEnd end;
  for (const PlannedAttachment& attachment : planned.attachments) {
    if (attachment.store != StoreAction::discard) continue;
    const bool depthStencil = attachment.point == AttachmentPoint::depthStencil;
    if (attachment.point == AttachmentPoint::color) end.discardColor = true;
    if (depthStencil || attachment.point == AttachmentPoint::depth) end.discardDepth = true;
    if (depthStencil || attachment.point == AttachmentPoint::stencil) end.discardStencil = true;
  }
  return end;
}

// A pass's framebuffer and the part of it that the pass covers.
struct Target {
  const gl::Framebuffer* framebuffer = nullptr;
  gl::Rect viewport;
  bool imported = false;
};

}  // namespace

struct Executor::State {
  explicit State(gl::Context& contextToUse) : context(contextToUse), pool(contextToUse) {}

  Status takeImages(const Graph& graph, const Plan& plan);
  Result<Target> targetOf(const Graph& graph, const PlannedPass& planned);
  Status runPass(const Graph& graph, const PlannedPass& planned, const Target& target,
                 PassContext& passContext, gl::Encoder& encoder);
  void setContentKeys(const Graph& graph, const PlannedPass& planned, std::uint64_t key);
  void forgetSharedImages(const std::vector<Use>& uses);

  const Image* imageOf(ResourceId resource) const {
    return resource.index < images.size() ? images[resource.index] : nullptr;
  }

  gl::Context& context;
  ResourcePool pool;
  std::vector<Image*> images;  // of the last run's resources; null = not made, or since given to another
  std::vector<std::unique_ptr<gl::Framebuffer>> hostFramebuffers;
  std::optional<gl::Timer> timer;
  int standing = 0;  // frames since the last run
};

// All images are made before the first pass: uploads and allocations between passes stall tile-based GPUs.
Status Executor::State::takeImages(const Graph& graph, const Plan& plan) {
  pool.beginRun();
  standing = 0;
  hostFramebuffers.clear();
  images.assign(graph.resources().size(), nullptr);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const ResourceDesc& desc = graph.resources()[i];
    if (desc.lifetime != Lifetime::persistent) continue;
    images[i] = pool.findPersistent(desc);
    if (images[i]) (void)pool.persistent(desc).ok();  // marks it used
  }
  // Only now: the plan may rely on what a persistent image holds since long ago.
  pool.trim(kRunsKept);
  const std::vector<Use> uses = usesOf(graph, plan);
  for (std::size_t position = 0; position < plan.passes.size(); ++position) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      const ResourceDesc& desc = graph.resources()[i];
      if (desc.lifetime == Lifetime::imported || images[i] || uses[i].first != position) continue;
      Result<Image*> image =
          desc.lifetime == Lifetime::persistent ? pool.persistent(desc) : pool.takeTransient(desc);
      if (!image) return image.error();
      images[i] = *image;
    }
    for (std::size_t i = 0; i < images.size(); ++i) {
      const bool transient = graph.resources()[i].lifetime == Lifetime::transient;
      if (transient && uses[i].first && uses[i].last == position) images[i]->taken = false;
    }
  }
  return {};
}

// After the run an image belongs to the last resource that lived in it.
void Executor::State::forgetSharedImages(const std::vector<Use>& uses) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t j = 0; j < images.size(); ++j) {
      if (i != j && images[i] && images[i] == images[j] && uses[i].last < uses[j].last) images[i] = nullptr;
    }
  }
}

Result<Target> Executor::State::targetOf(const Graph& graph, const PlannedPass& planned) {
  const ResourceId first = planned.attachments.front().resource;
  const ResourceDesc& desc = graph.resources()[first.index];
  if (desc.lifetime == Lifetime::imported) {
    const ImportedTarget& host = graph.importedTargets()[graph.importedIndex(first)];
    hostFramebuffers.push_back(std::make_unique<gl::Framebuffer>(
        gl::Framebuffer::wrap(host.framebufferName, host.x + host.width, host.y + host.height)));
    return Target{hostFramebuffers.back().get(), {host.x, host.y, host.width, host.height}, true};
  }
  AttachedImages attached;
  for (const PlannedAttachment& attachment : planned.attachments) {
    const Image* image = imageOf(attachment.resource);
    if (attachment.point == AttachmentPoint::color) {
      attached.color = image;
    } else if (attachment.point == AttachmentPoint::stencil) {
      attached.stencil = image;
    } else {
      attached.depth = image;
    }
  }
  Result<const gl::Framebuffer*> framebuffer = pool.framebuffer(attached);
  if (!framebuffer) {
    return Error{framebuffer.error().code,
                 "pass '" + graph.passes()[planned.pass].name + "': " + framebuffer.error().message};
  }
  return Target{*framebuffer, {0, 0, desc.width, desc.height}, false};
}

void Executor::State::setContentKeys(const Graph& graph, const PlannedPass& planned, std::uint64_t key) {
  for (const PlannedAttachment& attachment : planned.attachments) {
    Image* image = images[attachment.resource.index];
    if (image && graph.resources()[attachment.resource.index].lifetime == Lifetime::persistent) {
      image->contentKey = key;
    }
  }
}

Status Executor::State::runPass(const Graph& graph, const PlannedPass& planned, const Target& target,
                                PassContext& passContext, gl::Encoder& encoder) {
  const PassDesc& pass = graph.passes()[planned.pass];
  setContentKeys(graph, planned, 0);
  gl::PassBegin begin{
      .framebuffer = target.framebuffer, .viewport = target.viewport, .clear = clearValuesOf(planned)};
  // The host may own pixels of its framebuffer outside the viewport.
  if (target.imported) begin.clearParts = {&target.viewport, 1};
  if (planned.updates) begin.clearParts = pass.update.parts;
  if (planned.updates && pass.update.parts.empty()) begin.clear = {};
  encoder.beginPass(begin);
  if (pass.execute) pass.execute(passContext);
  encoder.endPass(discardsOf(planned));
  for (const PlannedAttachment& attachment : planned.attachments) {
    Image* image = images[attachment.resource.index];
    if (image && image->desc.mipmapped) image->texture.generateMipmaps(context);
  }
  if (context.lost()) return lostError();
  if (Status status = context.checkErrors(("pass '" + pass.name + "'").c_str()); !status) return status;
  setContentKeys(graph, planned, pass.contentKey != 0 ? pass.contentKey : kUnidentifiedContent);
  return {};
}

const gl::Texture& PassContext::texture(ResourceId resource) const {
  const Image* image = executor_ ? executor_->state_->imageOf(resource) : nullptr;
  return image ? image->texture : kNoTexture;
}

Executor::Executor(gl::Context& context) : state_(std::make_unique<State>(context)) {}
Executor::~Executor() = default;

std::uint64_t Executor::contentKeyOf(const ResourceDesc& desc) const {
  const Image* image = state_->context.lost() ? nullptr : state_->pool.findPersistent(desc);
  return image ? image->contentKey : 0;
}

Result<std::vector<PassReport>> Executor::run(const Graph& graph, const Plan& plan, gl::Encoder& encoder,
                                              PassTiming timing) {
  State& state = *state_;
  if (state.context.lost()) {
    forgetContent();
    return lostError();
  }
  // Else the first pass would be blamed for them.
  if (Status status = state.context.checkErrors("before the passes"); !status) return status.error();
  if (Status status = state.takeImages(graph, plan); !status) return status.error();
  std::vector<Target> targets;
  for (const PlannedPass& planned : plan.passes) {
    Result<Target> target = state.targetOf(graph, planned);
    if (!target) return target.error();
    targets.push_back(*target);
  }
  if (timing == PassTiming::perPass && !state.timer) state.timer.emplace(state.context);
  encoder.beginFrame();

  std::vector<PassReport> reports;
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    PassReport& report = reports.emplace_back(PassReport{.planned = i});
    const gl::Counters before = encoder.counters();
    PassContext passContext(encoder, targets[i].viewport);
    passContext.executor_ = this;
    passContext.updates = plan.passes[i].updates;
    if (timing == PassTiming::perPass) state.timer->begin();
    const Status status = state.runPass(graph, plan.passes[i], targets[i], passContext, encoder);
    if (timing == PassTiming::perPass) {
      state.timer->end();
      report.milliseconds = state.timer->milliseconds().value_or(0.0);
    }
    if (!status) {
      if (state.context.lost()) forgetContent();
      return status.error();
    }
    report.counters = encoder.counters() - before;
  }
  state.forgetSharedImages(usesOf(graph, plan));
  return reports;
}

Result<std::vector<PassReport>> Executor::runImportedAgain(const Graph& graph, const Plan& plan,
                                                           gl::Encoder& encoder) {
  State& state = *state_;
  std::vector<PassReport> reports;
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const ResourceId target = plan.passes[i].attachments.front().resource;
    if (graph.resources()[target.index].lifetime != Lifetime::imported) continue;
    for (const ResourceId read : graph.passes()[plan.passes[i].pass].reads) {
      if (state.imageOf(read) == nullptr) return std::vector<PassReport>{};
    }
    reports.push_back({.planned = i});
  }
  state.hostFramebuffers.clear();
  encoder.beginFrame();
  for (PassReport& report : reports) {
    const PlannedPass& planned = plan.passes[report.planned];
    Result<Target> target = state.targetOf(graph, planned);
    if (!target) return target.error();
    const gl::Counters before = encoder.counters();
    PassContext passContext(encoder, target->viewport);
    passContext.executor_ = this;
    if (Status s = state.runPass(graph, planned, *target, passContext, encoder); !s) return s.error();
    report.counters = encoder.counters() - before;
  }
  return reports;
}

const gl::Texture* Executor::texture(const Graph& graph, ResourceId resource) const {
  if (resource.index >= graph.resources().size()) return nullptr;
  const ResourceDesc& desc = graph.resources()[resource.index];
  const Image* image =
      desc.lifetime == Lifetime::persistent ? state_->pool.findPersistent(desc) : state_->imageOf(resource);
  return image && image->texture ? &image->texture : nullptr;
}

const gl::Framebuffer* Executor::framebufferFor(const Graph& graph, ResourceId resource) const {
  if (!texture(graph, resource)) return nullptr;
  const ResourceDesc& desc = graph.resources()[resource.index];
  const Image* image =
      desc.lifetime == Lifetime::persistent ? state_->pool.findPersistent(desc) : state_->imageOf(resource);
  AttachedImages attached;
  (desc.format == Format::rgba8 ? attached.color : attached.depth) = image;
  Result<const gl::Framebuffer*> framebuffer = state_->pool.framebuffer(attached);
  return framebuffer ? *framebuffer : nullptr;
}

std::uint64_t Executor::memoryBytes() const {
  return state_->pool.memoryBytes();
}

void Executor::trim(int frames) {
  for (Image*& image : state_->images) {
    if (image && state_->pool.isStale(*image, frames)) image = nullptr;
  }
  state_->pool.trim(frames);
}

void Executor::repeatRun() {
  state_->pool.repeatRun();
  if (++state_->standing == kStandstill) trim(kRunsKept);
}

void Executor::forgetContent() {
  state_->pool.forgetContent();
  if (!state_->context.lost()) return;
  // The names mean nothing any more; the objects forget them without touching GL.
  state_->hostFramebuffers.clear();
  state_->timer.reset();
  trim(0);
}

}  // namespace halfshadow::framegraph
