// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "api/engine_state.hpp"
#include "gl/embedded_shaders.hpp"

namespace halfshadow {
namespace {
thread_local std::string createMessage;

Outcome createFailed(const Error& error) {
  createMessage = error.message;
  return {error.code, createMessage.c_str()};
}
}  // namespace

Outcome Engine::State::fail(const Error& error) {
  message = error.message;
  return {error.code, message.c_str()};
}

gl::HostStatePolicy Engine::State::policy() const {
  switch (hostState) {
    case HostState::restore:
      return gl::HostStatePolicy::restore;
    case HostState::leaveDefaults:
      return gl::HostStatePolicy::leaveDefaults;
    case HostState::leaveDirty:
      break;
  }
  return gl::HostStatePolicy::leaveDirty;
}

Engine::Engine() : state_(new State) {}

Engine* Engine::create(const EngineDesc& desc, Outcome& outcome) {
  if (desc.getProcAddress == nullptr) {
    outcome = createFailed(
        {ErrorCode::invalidArgument, "EngineDesc::getProcAddress is null; pass the host's loader"});
    return nullptr;
  }
  gl::ContextOptions options;
  for (std::size_t i = 0; i < desc.forcedOffCount; ++i) {
    auto capability = device::capabilityFromName(desc.forcedOff[i]);
    if (!capability) {
      outcome = createFailed(capability.error());
      return nullptr;
    }
    options.forcedOff.push_back(*capability);
  }
  auto context = gl::Context::create([load = desc.getProcAddress, user = desc.getProcAddressUser](
                                         const char* name) { return load(name, user); },
                                     options);
  if (!context) {
    outcome = createFailed(context.error());
    return nullptr;
  }
  Engine* engine = new Engine;
  State& state = *engine->state_;
  state.context = std::move(context).value();
  state.hostState = desc.hostState;
  state.techniques = techniques::makeAllTechniques();
  state.programs =
      std::make_unique<gl::ProgramCache>(*state.context,
                                         desc.shaderFolder ? gl::directoryShaders(desc.shaderFolder)
                                                           : gl::ShaderSourceProvider(gl::embeddedShader),
                                         techniques::allShaderFamilies(state.techniques));
  if (desc.programProofs) state.proofs.restore(desc.programProofs, state.context->capabilities().driver);
  state.encoder = std::make_unique<gl::Encoder>(*state.context);
  state.executor = std::make_unique<framegraph::Executor>(*state.context);
  state.settings = std::make_unique<techniques::Settings>(techniques::allSettings(state.techniques));
  for (const auto& technique : state.techniques) {
    state.techniqueReasons.push_back(technique->support(state.context->capabilities()).reason);
    if (technique->info().id == "hard") state.technique = technique.get();
  }
  outcome = {};
  return engine;
}

Engine::~Engine() {
  {
    gl::HostStateGuard guard(*state_->context,
                             state_->context->lost() ? gl::HostStatePolicy::leaveDirty : state_->policy());
    state_->lastFrame.reset();
    state_->lightCaches = {};
    state_->executor.reset();
    state_->shared.forget();
    state_->receivers.clear();
    state_->objects.clear();
    state_->techniques.clear();
    state_->encoder.reset();
    state_->programs.reset();
  }
  delete state_;
}

void Engine::contextLost() {
  state_->context->markLost();
}

int Engine::liveObjectCount() const {
  return state_->context->liveObjects().total();
}

void Engine::finish() {
  if (!state_->context->lost()) state_->encoder->finish();
}

Outcome Engine::setTechnique(const char* id) {
  State& state = *state_;
  const std::string_view wanted = id ? id : "";
  std::string known;
  for (const auto& technique : state.techniques) {
    known += (known.empty() ? "" : ", ") + technique->info().id;
    if (technique->info().id != wanted) continue;
    const techniques::Support support = technique->support(state.context->capabilities());
    if (!support.supported) {
      return state.fail(
          {ErrorCode::capabilityMissing, "technique " + std::string(wanted) + " needs " + support.reason});
    }
    if (state.technique != technique.get()) ++state.changes;
    state.technique = technique.get();
    return {};
  }
  return state.fail(
      {ErrorCode::unknownTechnique, "unknown technique \"" + std::string(wanted) + "\"; known: " + known});
}

Outcome Engine::set(const char* key, const char* value) {
  if (key == nullptr || value == nullptr) {
    return state_->fail({ErrorCode::invalidArgument, "a setting needs a key and a value, e.g. pcf.size=7"});
  }
  const Status status = state_->settings->set(key, value);
  return status ? Outcome{} : state_->fail(status.error());
}

Outcome Engine::setLights(const LightDesc* lights, std::size_t count) {
  State& state = *state_;
  if (count > static_cast<std::size_t>(kMaxLights)) {
    return state.fail({ErrorCode::invalidArgument, "at most 4 lights: visibility has one channel each"});
  }
  std::vector<scene::AreaLight> checked;
  for (std::size_t i = 0; i < count; ++i) {
    const LightDesc& desc = lights[i];
    const auto vector = [](const double v[3]) { return glm::dvec3(v[0], v[1], v[2]); };
    auto light = scene::areaLightFromVectors(vector(desc.center), vector(desc.halfU), vector(desc.halfV));
    if (!light) return state.fail(light.error());
    if (glm::length(light->halfU) == 0.0) {
      const glm::dvec3 emission = vector(desc.emission);
      if (!(glm::length(emission) > 0.0) || !std::isfinite(glm::length(emission))) {
        return state.fail(
            {ErrorCode::invalidLight, "a point light needs a finite, non-zero emission direction"});
      }
      light->emission = glm::normalize(emission);
    }
    light->color = {desc.color[0], desc.color[1], desc.color[2]};
    light->intensity = desc.intensity;
    light->referenceDistance = desc.referenceDistance;
    if (!std::isfinite(desc.color[0] + desc.color[1] + desc.color[2] + desc.intensity)) {
      return state.fail({ErrorCode::invalidLight, "the light's colour or intensity is not finite"});
    }
    if (!std::isfinite(desc.referenceDistance) || desc.referenceDistance < 0.0) {
      return state.fail(
          {ErrorCode::invalidLight, "the light's reference distance is negative or not finite"});
    }
    checked.push_back(*light);
  }
  state.setLights(std::move(checked));
  return {};
}

}  // namespace halfshadow
