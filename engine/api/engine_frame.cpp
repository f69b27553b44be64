// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "api/draw_items.hpp"
#include "api/engine_state.hpp"
#include "api/frame_desc.hpp"

namespace halfshadow {
namespace {
framegraph::ClearValue clearColor(float r, float g, float b, float a) {
  return {.color = {r, g, b, a}};
}

framegraph::ClearValue clearValueOf(const RenderDesc& desc) {
  if (desc.output == Output::taps) return clearColor(0, 0, 0, 0);
  if (desc.output != Output::shaded) return clearColor(1, 1, 1, 1);
  return clearColor(desc.clearColor[0], desc.clearColor[1], desc.clearColor[2], desc.clearColor[3]);
}

bool blamesDriver(ErrorCode code) {
  return code == ErrorCode::outOfMemory || code == ErrorCode::driverFault ||
         code == ErrorCode::shaderFailed || code == ErrorCode::capabilityMissing ||
         code == ErrorCode::contextLost;
}

/// A colour image of the frame's size with a depth buffer of its own.
std::vector<framegraph::Attachment> imageWithDepth(framegraph::Graph& graph, const std::string& name,
                                                   const TargetDesc& target, framegraph::Lifetime lifetime,
                                                   const framegraph::ClearValue& clear) {
  const auto color =
      graph.addResource({.name = name, .width = target.width, .height = target.height, .lifetime = lifetime});
  const auto depth = graph.addResource({.name = name + " depth",
                                        .width = target.width,
                                        .height = target.height,
                                        .format = framegraph::Format::depth24,
                                        .storage = framegraph::Storage::renderbuffer});
  return {{.resource = color, .point = framegraph::AttachmentPoint::color, .clear = clear},
          {.resource = depth, .point = framegraph::AttachmentPoint::depth, .clear = clear}};
}
}  // namespace

techniques::Technique* Engine::State::techniqueNamed(std::string_view id) const {
  const auto found =
      std::ranges::find_if(techniques, [&](const auto& candidate) { return candidate->info().id == id; });
  return found == techniques.end() ? nullptr : found->get();
}

void Engine::State::declareVisibilityPass(Frame& frame, std::vector<framegraph::Attachment> targets) {
  const auto output = api::receiverOutput(frame.desc, frame.shading);
  const bool shaded = output == techniques::ReceiverOutput::shaded;
  framegraph::PassDesc pass{.name = shaded ? "receivers, shaded" : "receivers, visibility",
                            .stage = framegraph::PassStage::scene,
                            .writes = std::move(targets)};
  const std::size_t drawn = api::drawnLights(frame.desc, frame.shading, frame.lights.size());
  for (std::size_t i = 0; i < drawn; ++i) {
    for (const auto resource : techniques::resourcesRead(frame.lights[i].shading))
      pass.reads.push_back(resource);
  }
  pass.execute = [&frame, drawn, shaded](framegraph::PassContext& passContext) {
    for (std::size_t i = 0; i < drawn; ++i) {
      const FrameLight& light = frame.lights[i];
      techniques::drawReceivers(passContext, light.shading, light.programs, frame.view, frame.receivers,
                                shaded ? &frame.shadingInputs : nullptr, api::receiverTarget(i, drawn));
    }
  };
  frame.graph.addPass(std::move(pass));
}

Status Engine::State::declareReceiverPasses(Frame& frame) {
  const RenderDesc& desc = frame.desc;
  using framegraph::AttachmentPoint;
  const framegraph::ClearValue clear = clearValueOf(desc);
  const TargetDesc& target = desc.target;
  std::vector<framegraph::Attachment> targets;
  if (target.kind == TargetDesc::Kind::host) {
    const auto host = frame.graph.importTarget(
        "host target", {target.framebuffer, target.x, target.y, target.width, target.height});
    targets = {{.resource = host, .point = AttachmentPoint::color, .clear = clear},
               {.resource = host, .point = AttachmentPoint::depth, .clear = clear}};
  } else {
    targets = imageWithDepth(frame.graph, "output", target, framegraph::Lifetime::persistent, clear);
  }
  frame.color = targets.front().resource;
  frame.graph.markOutput(frame.color);
  frame.shadingInputs = techniques::shadingInputs(lights, frame.shading == api::Shading::apart,
                                                  frame.receivers, context->capabilities());
  if (desc.output != Output::shaded || frame.shading == api::Shading::together) {
    declareVisibilityPass(frame, std::move(targets));
    return {};
  }
  auto visibilityTargets = imageWithDepth(frame.graph, "visibilities", target,
                                          framegraph::Lifetime::transient, clearColor(1, 1, 1, 1));
  frame.screenShading = techniques::shadeFromScreen(visibilityTargets.front().resource);
  auto linked = techniques::receiverPrograms(*programs, frame.screenShading,
                                             {.output = techniques::ReceiverOutput::shaded, .lights = lights},
                                             frame.receivers);
  if (!linked) return linked.error();
  frame.screenPrograms = *linked;
  declareVisibilityPass(frame, std::move(visibilityTargets));
  framegraph::PassDesc pass{.name = "receivers, shaded",
                            .stage = framegraph::PassStage::resolve,
                            .reads = techniques::resourcesRead(frame.screenShading),
                            .writes = std::move(targets)};
  pass.execute = [&frame](framegraph::PassContext& passContext) {
    techniques::drawReceivers(passContext, frame.screenShading, frame.screenPrograms, frame.view,
                              frame.receivers, &frame.shadingInputs, {});
  };
  frame.graph.addPass(std::move(pass));
  return {};
}

Status Engine::State::checkFrame(const RenderDesc& desc, const scene::Camera& camera) const {
  if (context->lost())
    return Error{ErrorCode::contextLost, "the context was lost; call contextRestored on the new one"};
  if (Status s = api::checkFrameDesc(desc); !s) return s;
  if (Status s = api::checkTarget(desc.target, context->capabilities().limits); !s) return s;
  if (Status s = scene::checkCamera(camera); !s) return s;
  for (std::size_t i = 0; i < techniques.size(); ++i) {
    if (techniques[i].get() == technique && !techniqueReasons[i].empty()) {
      return Error{ErrorCode::capabilityMissing,
                   "technique " + technique->info().id + " needs " + techniqueReasons[i] + "; set another"};
    }
  }
  return {};
}

Status Engine::State::declareFrame(Frame& frame, const scene::Camera& camera) {
  const RenderDesc& desc = frame.desc;
  const double aspect = static_cast<double>(desc.target.width) / desc.target.height;
  frame.view = {.clipFromWorld = scene::clipFromView(camera, aspect) * scene::viewFromWorld(camera),
                .eyeWorld = camera.eyeWorld,
                .width = desc.target.width,
                .height = desc.target.height,
                .nearReach = scene::nearReach(camera, aspect)};
  lists.update(objects);
  shared.beginFrame();
  programs->beginFrame();
  planner::FramePlan framePlan =
      planner.plan({.objects = lists.planned(),
                    .changed = lists.changed(),
                    .camera = desc.receivers == Receivers::seen ? &camera : nullptr,
                    .aspectWidthOverHeight = aspect,
                    .lights = lights,
                    .lightRevisions = lightRevisions,
                    .lightNumbers = lightNumbers,
                    .receiversUnknown = desc.receivers == Receivers::unknown});
  frame.skips = std::move(framePlan.skips);
  // What shadows nothing is in no light's view: its pixels need none of the care that casters' own do.
  std::vector<char> castsForSome(lists.objects().size(), 0);
  for (const planner::LightPlan& light : framePlan.lights) {
    for (const std::uint32_t i : light.casters) castsForSome[i] = 1;
  }
  if (Status s = receivers.update(*context, lists, framePlan.receivers, std::move(castsForSome),
                                  api::receiverView(frame.view, camera));
      !s) {
    return s;
  }
  frame.receivers = receivers.values();
  frame.lights.resize(lights.size());
  for (std::uint32_t number = 0; number < lightCaches.size(); ++number) {
    if (std::ranges::find(lightNumbers, number) == lightNumbers.end()) lightCaches[number] = {};
  }
  if (lights.size() > 1) frame.shading = api::Shading::apart;
  if (!proofFailure.empty()) frame.graph.noteSkipped("proof of programs", proofFailure);
  techniques::FramePasses passes{frame.view, frame.graph};
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (Status s = declareLight(frame, passes, i, framePlan); !s) return s;
  }
  shared.endFrame();
  return desc.output == Output::lightsOnly ? Status{} : declareReceiverPasses(frame);
}

Status Engine::State::renderFrame(const RenderDesc& desc) {
  const scene::Camera camera = api::toCamera(desc.camera);
  if (Status s = checkFrame(desc, camera); !s) return s;
  gl::HostStateGuard guard(*context, policy());
  if (desc.target.kind == TargetDesc::Kind::host && desc.output != Output::lightsOnly) {
    if (Status s = gl::checkHostFramebuffer(*context, desc.target.framebuffer); !s) return s;
  }
  const gl::Counters before = encoder->counters();
  gl::Counters proving;
  encoder->beginFrame();
  std::unique_ptr<Frame> frame;
  for (bool proven = false; !proven;) {
    frame = std::make_unique<Frame>();
    frame->desc = desc;
    frame->sceneRevision = sceneRevision();
    if (Status s = declareFrame(*frame, camera); !s) return s;
    const Result<bool> draws = provePrograms(*frame, proving);
    if (!draws) return draws.error();
    proven = *draws;
  }
  auto plan = framegraph::compile(frame->graph, [this](const framegraph::ResourceDesc& resource) {
    return executor->contentKeyOf(resource);
  });
  if (!plan) return plan.error();
  frame->plan = std::move(plan).value();
  auto passReports = executor->run(
      frame->graph, frame->plan, *encoder,
      desc.timing == Timing::perPass ? framegraph::PassTiming::perPass : framegraph::PassTiming::off);
  if (!passReports) return passReports.error();
  if (Status s = context->checkErrors("a frame"); !s) return s;
  frame->passReports = std::move(passReports).value();
  frame->counters = encoder->counters() - before - proving;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const techniques::MapUpdates::Counts& counts = cacheOf(i).passes->castersDrawn();
    frame->castersDrawn.drawn += counts.drawn;
    frame->castersDrawn.kept += counts.kept;
  }
  // What objects sent since the last frame is this one's too.
  const gl::Counters& now = encoder->counters();
  frame->counters.textureUploadBytes = now.textureUploadBytes - uploadsTold.textureUploadBytes;
  frame->counters.bufferUploadBytes = now.bufferUploadBytes - uploadsTold.bufferUploadBytes;
  uploadsTold = now;
  ++forwardBindings;
  frame->valid = true;
  lastFrame = std::move(frame);
  return {};
}

bool Engine::State::isUnchanged(const RenderDesc& desc) const {
  // Who asks for times asks for passes.
  return lastFrame && lastFrame->valid && !context->lost() && desc.timing == Timing::off &&
         lastFrame->sceneRevision == sceneRevision() && api::sameFrame(lastFrame->desc, desc);
}

Result<bool> Engine::State::drawUnchanged() {
  Frame& frame = *lastFrame;
  const bool host =
      frame.desc.target.kind == TargetDesc::Kind::host && frame.desc.output != Output::lightsOnly;
  frame.unchanged = true;
  frame.counters = {};
  frame.silhouettesExtracted = 0;
  frame.castersDrawn = {};
  frame.passReports.clear();
  executor->repeatRun();
  if (!host) return true;
  gl::HostStateGuard guard(*context, policy());
  const gl::Counters before = encoder->counters();
  auto passReports = executor->runImportedAgain(frame.graph, frame.plan, *encoder);
  if (!passReports) return passReports.error();
  if (passReports->empty()) return false;
  if (Status s = context->checkErrors("a frame"); !s) return s.error();
  frame.passReports = std::move(passReports).value();
  frame.counters = encoder->counters() - before;
  return true;
}

Outcome Engine::State::render(const RenderDesc& desc) {
  forwardUnits.fill(0);
  if (isUnchanged(desc)) {
    const Result<bool> drawn = drawUnchanged();
    if (drawn && *drawn) return {};
    lastFrame->valid = false;
    if (!drawn) {
      lastFrame->lights.clear();
      return fail(drawn.error());
    }
  }
  Status status = renderFrame(desc);
  for (int attempt = 0; !status && status.error().code == ErrorCode::outOfMemory; ++attempt) {
    if (!freeForRetry(attempt)) break;
    status = renderFrame(desc);
  }
  if (!status && lastFrame) {
    // What the lights of the frame before read may have been replaced.
    lastFrame->lights.clear();
    lastFrame->valid = false;
  }
  if (!status && blamesDriver(status.error().code)) {
    forgetDriverWork();
  }
  return status ? Outcome{} : fail(status.error());
}

Outcome Engine::render(const RenderDesc& desc) {
  return state_->guarded([&] { return state_->render(desc); });
}

Outcome Engine::render(const RenderDesc& desc, FrameReport& report) {
  const Outcome outcome = render(desc);
  report = outcome.ok() ? this->report() : FrameReport{};
  return outcome;
}

std::uint32_t Engine::outputTexture() const {
  if (!state_->lastFrame || state_->context->lost()) return 0;
  const gl::Texture* texture = state_->executor->texture(state_->lastFrame->graph, state_->lastFrame->color);
  return texture ? texture->name() : 0;
}

Outcome Engine::readOutput(std::uint8_t* rgba, std::size_t byteCount) {
  return state_->guarded([&] { return state_->readOutput(rgba, byteCount); });
}

Outcome Engine::State::readOutput(std::uint8_t* rgba, std::size_t byteCount) {
  if (context->lost()) return fail({ErrorCode::contextLost, "the context was lost; call contextRestored"});
  gl::HostStateGuard guard(*context, policy());  // framebufferFor may make and bind one
  const gl::Framebuffer* framebuffer =
      lastFrame ? executor->framebufferFor(lastFrame->graph, lastFrame->color) : nullptr;
  if (Status s = context->checkErrors("reading the output"); !s) return fail(s.error());
  if (framebuffer == nullptr)
    return fail({ErrorCode::invalidArgument, "no frame was rendered with TargetDesc::Kind::engine"});
  const TargetDesc& target = lastFrame->desc.target;
  const auto width = static_cast<std::size_t>(target.width), height = static_cast<std::size_t>(target.height);
  if (rgba == nullptr || byteCount < width * height * 4)
    return fail({ErrorCode::invalidArgument, "readOutput needs width x height x 4 bytes"});
  encoder->beginFrame();
  encoder->readPixels(*framebuffer, {0, 0, target.width, target.height}, rgba);
  for (std::size_t y = 0; y < height / 2; ++y) {
    std::swap_ranges(rgba + y * width * 4, rgba + (y + 1) * width * 4, rgba + (height - 1 - y) * width * 4);
  }
  const Status status = context->checkErrors("reading the output");
  return status ? Outcome{} : fail(status.error());
}

}  // namespace halfshadow
