// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "api/draw_items.hpp"
#include "api/engine_state.hpp"
#include "api/receiver_reach.hpp"
#include "base/keys.hpp"
#include "planner/light_reach.hpp"

namespace halfshadow {
namespace {
glm::dvec3 toVector(const double v[3]) {
  return {v[0], v[1], v[2]};
}

scene::Camera toCamera(const CameraDesc& desc) {
  return {.eyeWorld = toVector(desc.eye),
          .targetWorld = toVector(desc.target),
          .up = toVector(desc.up),
          .verticalFovRadians = desc.verticalFovRadians,
          .nearDistance = desc.nearDistance,
          .farDistance = desc.farDistance};
}

Status checkTarget(const TargetDesc& target, const device::Limits& limits) {
  const int limit = std::min(limits.textureSize, limits.renderbufferSize);
  if (target.width <= 0 || target.height <= 0) {
    return Error{ErrorCode::invalidArgument, "the target's size is " + std::to_string(target.width) + "x" +
                                                 std::to_string(target.height) + "; give positive numbers"};
  }
  if (target.kind == TargetDesc::Kind::engine && std::max(target.width, target.height) > limit) {
    return Error{ErrorCode::invalidArgument, "the target's size " + std::to_string(target.width) + "x" +
                                                 std::to_string(target.height) +
                                                 " is above this device's limit of " + std::to_string(limit)};
  }
  return {};
}

/// What the pass that evaluates visibility writes: with several lights, shading reads it from the screen.
techniques::ReceiverOutput receiverOutput(const RenderDesc& desc, std::size_t lightCount) {
  switch (desc.output) {
    case Output::shaded:
      return lightCount > 1 ? techniques::ReceiverOutput::visibility : techniques::ReceiverOutput::shaded;
    case Output::visibility:
    case Output::lightsOnly:
      return techniques::ReceiverOutput::visibility;
    case Output::visibility16:
      return techniques::ReceiverOutput::visibility16;
    case Output::taps:
      return techniques::ReceiverOutput::taps;
  }
  return techniques::ReceiverOutput::visibility;
}

/// Three points a triangle, in order: techniques read them as triangles. Each vertex is transformed once.
void appendPoints(const EngineObject& object, std::vector<glm::dvec3>& points) {
  std::vector<glm::dvec3> verticesWorld;
  verticesWorld.reserve(object.mesh.positions.size());
  for (const glm::vec3& position : object.mesh.positions) {
    verticesWorld.push_back(glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0)));
  }
  for (const std::uint32_t index : object.mesh.indices) points.push_back(verticesWorld[index]);
}

framegraph::ClearValue clearColor(float r, float g, float b, float a) {
  return {.color = {r, g, b, a}};
}

framegraph::ClearValue clearValueOf(const RenderDesc& desc) {
  if (desc.output == Output::taps) return clearColor(0, 0, 0, 0);
  if (desc.output != Output::shaded) return clearColor(1, 1, 1, 1);
  return clearColor(desc.clearColor[0], desc.clearColor[1], desc.clearColor[2], desc.clearColor[3]);
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

Status Engine::State::declareLight(Frame& frame, techniques::FramePasses& passes, std::size_t index,
                                   const planner::FramePlan& framePlan,
                                   const std::vector<const EngineObject*>& sceneObjects,
                                   const RenderDesc& desc) {
  const planner::LightPlan& plan = framePlan.lights[index];
  const scene::AreaLight& light = lights[index];
  FrameLight& target = frame.lights[index];
  LightCache& cache = lightCaches[index];
  const int mapSize = settings->integer("map_size");
  target.casters.reserve(plan.casters.size());
  for (const std::uint32_t i : plan.casters) target.casters.push_back(api::drawItem(*sceneObjects[i]));
  if (cache.key != plan.contentKey || cache.mapSize != mapSize) {
    cache.casterPointsWorld.clear();
    for (const std::uint32_t i : plan.casters) appendPoints(*sceneObjects[i], cache.casterPointsWorld);
    cache.light = planner::lightWithinReach(light, cache.casterPointsWorld);
    cache.fit = planner::fitLight(cache.light, cache.casterPointsWorld,
                                  {.mapSize = mapSize, .pointsAreTriangles = true});
    cache.key = plan.contentKey;
    cache.mapSize = mapSize;
    cache.reachKey = 0;
  }
  techniques::Technique* used = technique;
  if (!plan.active || cache.fit.empty || plan.casters.empty()) {
    frame.graph.noteSkipped("light " + std::to_string(index) + " shadows",
                            std::string(planner::skipText(planner::SkipReason::noCasters)));
    used = techniqueNamed("none");
  }
  std::vector<bool> isCaster(sceneObjects.size(), false);
  for (const std::uint32_t i : plan.casters) isCaster[i] = true;
  for (std::size_t i = 0; i < sceneObjects.size(); ++i) {
    // A caster that shadows nothing was left out of the casters, but it is a receiver like any other.
    if (isCaster[i] || !sceneObjects[i]->receives) continue;
    target.shadowlessReceivers.push_back(api::drawItem(*sceneObjects[i]));
    target.shadowlessReceivers.back().casts = false;
  }
  const std::uint64_t sceneKey = combineKeys(plan.contentKey, framePlan.sceneRevision);
  const double receiverFarDistance = receiverReach(cache, sceneObjects, sceneKey);
  std::string splitReason;
  const planner::SubLights* subLights = cache.split.update({.light = cache.light,
                                                            .fit = cache.fit,
                                                            .casterPointsWorld = cache.casterPointsWorld,
                                                            .receiverFarDistance = receiverFarDistance,
                                                            .contentKey = plan.contentKey},
                                                           *used, *settings, splitReason);
  if (!splitReason.empty())
    frame.graph.noteSkipped("light " + std::to_string(index) + " sub-lights", splitReason);
  const techniques::LightScene scene{.capabilities = context->capabilities(),
                                     .settings = *settings,
                                     .screen = frame.view,
                                     .channel = static_cast<int>(index),
                                     .name = "light " + std::to_string(index),
                                     .light = cache.light,
                                     .center = {.fit = cache.fit,
                                                .casters = target.casters,
                                                .contentKey = plan.contentKey,
                                                .sceneKey = sceneKey},
                                     .subLights = subLights,
                                     .casterPointsWorld = cache.casterPointsWorld,
                                     .receiverFarDistance = receiverFarDistance,
                                     .casters = target.casters,
                                     .groups = cache.groups,
                                     .receivers = frame.receivers,
                                     .shadowlessReceivers = target.shadowlessReceivers,
                                     .contentKey = plan.contentKey,
                                     .sceneKey = sceneKey};
  if (const auto standIn = used->standIn(scene)) {
    const bool hostEvaluates = desc.output == Output::lightsOnly;
    const std::string outcome = hostEvaluates ? "; kept, since " + standIn->id + " works on the screen only"
                                              : "; " + standIn->id + " takes the light";
    frame.graph.noteSkipped("light " + std::to_string(index) + " " + used->info().id,
                            standIn->reason + outcome);
    if (!hostEvaluates) used = techniqueNamed(standIn->id);
  }
  auto shading = shadingOf(passes, index, *used, scene);
  if (!shading) return shading.error();
  target.shading = std::move(shading).value();
  if (desc.output == Output::lightsOnly) {
    for (const auto resource : techniques::resourcesRead(target.shading)) frame.graph.markOutput(resource);
    return {};
  }
  auto linked = techniques::receiverPrograms(*programs, target.shading, receiverOutput(desc, lights.size()),
                                             frame.receivers);
  if (!linked) return linked.error();
  target.programs = *linked;
  return {};
}

double Engine::State::receiverReach(LightCache& cache, const std::vector<const EngineObject*>& sceneObjects,
                                    std::uint64_t sceneKey) const {
  if (cache.reachKey == sceneKey) return cache.receiverFarDistance;
  std::vector<api::Receiver> receivers;
  for (const EngineObject* object : sceneObjects) {
    if (object->receives) receivers.push_back({&object->mesh, object->worldFromObject, object->boundsWorld});
  }
  cache.reachKey = sceneKey;
  cache.receiverFarDistance = api::receiverFarDistance(cache.fit, receivers);
  return cache.receiverFarDistance;
}

Result<techniques::ReceiverShading> Engine::State::shadingOf(techniques::FramePasses& passes,
                                                             std::size_t index, techniques::Technique& used,
                                                             const techniques::LightScene& scene) {
  LightCache& cache = lightCaches[index];
  if (cache.passesOf != &used) {
    cache.passesOf = &used;
    cache.passes = std::make_unique<techniques::LightPasses>(used.newPlanner());
  }
  techniques::Device device{*context, *programs, shared};
  if (Status s = cache.passes->prepare(scene); !s) return s.error();
  if (Status s = cache.passes->upload(device); !s) return s.error();
  return cache.passes->declare(passes);
}

void Engine::State::declareVisibilityPass(Frame& frame, const RenderDesc& desc,
                                          std::vector<framegraph::Attachment> targets) {
  const auto output = receiverOutput(desc, frame.lights.size());
  const bool shaded = output == techniques::ReceiverOutput::shaded;
  framegraph::PassDesc pass{.name = shaded ? "receivers, shaded" : "receivers, visibility",
                            .stage = framegraph::PassStage::scene,
                            .writes = std::move(targets)};
  // An image of one value a pixel shows the first light only.
  const std::size_t drawn = output == techniques::ReceiverOutput::visibility ? frame.lights.size() : 1;
  for (std::size_t i = 0; i < drawn; ++i) {
    for (const auto resource : techniques::resourcesRead(frame.lights[i].shading))
      pass.reads.push_back(resource);
  }
  pass.execute = [&frame, drawn, shaded](framegraph::PassContext& passContext) {
    for (std::size_t i = 0; i < drawn; ++i) {
      const FrameLight& light = frame.lights[i];
      techniques::ReceiverTarget receiverTarget{.depthIsComplete = i > 0};
      if (drawn > 1) {
        receiverTarget.colorMask.fill(false);
        receiverTarget.colorMask[i] = true;
      }
      techniques::drawReceivers(passContext, light.shading, light.programs, frame.view, frame.receivers,
                                shaded ? &frame.shadingInputs : nullptr, receiverTarget);
    }
  };
  frame.graph.addPass(std::move(pass));
}

Status Engine::State::declareReceiverPasses(Frame& frame, const RenderDesc& desc) {
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
  for (const scene::AreaLight& light : lights) frame.shadingInputs.lights.push_back(&light);
  if (desc.output != Output::shaded || lights.size() == 1) {
    declareVisibilityPass(frame, desc, std::move(targets));
    return {};
  }
  auto visibilityTargets = imageWithDepth(frame.graph, "visibilities", target,
                                          framegraph::Lifetime::transient, clearColor(1, 1, 1, 1));
  frame.screenShading = techniques::shadeFromScreen(visibilityTargets.front().resource);
  auto linked = techniques::receiverPrograms(*programs, frame.screenShading,
                                             techniques::ReceiverOutput::shaded, frame.receivers);
  if (!linked) return linked.error();
  frame.screenPrograms = *linked;
  declareVisibilityPass(frame, desc, std::move(visibilityTargets));
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

Status Engine::State::renderFrame(const RenderDesc& desc, FrameReport& frameReport) {
  if (context->lost())
    return Error{ErrorCode::contextLost, "the context was lost; make a new engine on the new context"};
  if (Status s = checkTarget(desc.target, context->capabilities().limits); !s) return s;
  const scene::Camera camera = toCamera(desc.camera);
  if (Status s = scene::checkCamera(camera); !s) return s;
  if (objects.empty())
    return Error{ErrorCode::emptyScene, "the scene has no objects; add one before rendering"};
  if (lights.empty())
    return Error{ErrorCode::invalidLight, "no light is set; call setLights before rendering"};

  gl::HostStateGuard guard(*context, policy());
  const gl::Counters before = encoder->counters();
  encoder->beginFrame();
  auto frame = std::make_unique<Frame>();
  const double aspect = static_cast<double>(desc.target.width) / desc.target.height;
  frame->view = {.clipFromWorld = scene::clipFromView(camera, aspect) * scene::viewFromWorld(camera),
                 .eyeWorld = camera.eyeWorld,
                 .width = desc.target.width,
                 .height = desc.target.height,
                 .nearReach = scene::nearReach(camera, aspect)};

  std::vector<const EngineObject*> sceneObjects;
  std::vector<planner::PlannedObject> planned;
  sceneObjects.reserve(objects.size());
  planned.reserve(objects.size());
  for (const auto& [id, object] : objects) {
    sceneObjects.push_back(&object);
    planned.push_back({.id = id,
                       .boundsWorld = object.boundsWorld,
                       .revision = object.revision,
                       .casts = object.casts,
                       .receives = object.receives,
                       .mesh = &object.mesh,
                       .support = &object.support(),
                       .worldFromObject = object.worldFromObject});
  }
  const planner::FramePlan framePlan = planner.plan({.objects = planned,
                                                     .camera = &camera,
                                                     .aspectWidthOverHeight = aspect,
                                                     .lights = lights,
                                                     .lightRevisions = lightRevisions});
  // What shadows nothing is in no light's view: its pixels need none of the care that casters' own do.
  std::vector<bool> castsForSome(sceneObjects.size(), false);
  for (const planner::LightPlan& light : framePlan.lights) {
    for (const std::uint32_t i : light.casters) castsForSome[i] = true;
  }
  frame->receivers.reserve(framePlan.receivers.size());
  for (const std::uint32_t i : framePlan.receivers) {
    auto item = api::receiverItem(*context, *sceneObjects[i], castsForSome[i], frame->view, camera);
    if (!item) return item.error();
    frame->receivers.push_back(*item);
  }
  frame->lights.resize(lights.size());
  lightCaches.resize(lights.size());
  techniques::FramePasses passes{frame->view, frame->graph};
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (Status s = declareLight(*frame, passes, i, framePlan, sceneObjects, desc); !s) return s;
  }
  if (desc.output != Output::lightsOnly) {
    if (Status s = declareReceiverPasses(*frame, desc); !s) return s;
  }
  auto plan = framegraph::compile(frame->graph, [this](const framegraph::ResourceDesc& resource) {
    return executor->contentKeyOf(resource);
  });
  if (!plan) return plan.error();
  auto passReports = executor->run(
      frame->graph, *plan, *encoder,
      desc.timing == Timing::perPass ? framegraph::PassTiming::perPass : framegraph::PassTiming::off);
  if (!passReports) return passReports.error();
  if (Status s = context->checkErrors("a frame"); !s) return s;
  report.passReports = std::move(passReports).value();
  lastFrame = std::move(frame);
  outputWidth = desc.target.width;
  outputHeight = desc.target.height;
  fillReport(*plan, framePlan, encoder->counters() - before, frameReport);
  return {};
}

Outcome Engine::render(const RenderDesc& desc, FrameReport& report) {
  report = {};
  const Status status = state_->renderFrame(desc, report);
  // What the lights of the frame before read may have been replaced.
  if (!status && state_->lastFrame) state_->lastFrame->lights.clear();
  return status ? Outcome{} : state_->fail(status.error());
}

std::uint32_t Engine::outputTexture() const {
  if (!state_->lastFrame) return 0;
  const gl::Texture* texture = state_->executor->texture(state_->lastFrame->graph, state_->lastFrame->color);
  return texture ? texture->name() : 0;
}

Outcome Engine::readOutput(std::uint8_t* rgba, std::size_t byteCount) {
  State& state = *state_;
  if (state.context->lost())
    return state.fail({ErrorCode::contextLost, "the context was lost; make a new engine"});
  gl::HostStateGuard guard(*state.context, state.policy());  // framebufferFor may make and bind one
  const gl::Framebuffer* framebuffer =
      state.lastFrame ? state.executor->framebufferFor(state.lastFrame->graph, state.lastFrame->color)
                      : nullptr;
  if (framebuffer == nullptr) {
    return state.fail({ErrorCode::invalidArgument, "no frame was rendered with TargetDesc::Kind::engine"});
  }
  const auto width = static_cast<std::size_t>(state.outputWidth),
             height = static_cast<std::size_t>(state.outputHeight);
  if (rgba == nullptr || byteCount < width * height * 4) {
    return state.fail({ErrorCode::invalidArgument, "readOutput needs width x height x 4 bytes"});
  }
  state.encoder->beginFrame();
  state.encoder->readPixels(*framebuffer, {0, 0, state.outputWidth, state.outputHeight}, rgba);
  for (std::size_t y = 0; y < height / 2; ++y) {
    std::swap_ranges(rgba + y * width * 4, rgba + (y + 1) * width * 4, rgba + (height - 1 - y) * width * 4);
  }
  const Status status = state.context->checkErrors("reading the output");
  return status ? Outcome{} : state.fail(status.error());
}

}  // namespace halfshadow
