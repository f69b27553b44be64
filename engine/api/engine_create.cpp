// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// An engine's beginning and end, and those of its context.
#include <set>

#include "api/engine_state.hpp"
#include "gl/embedded_shaders.hpp"

namespace halfshadow {
namespace {
thread_local std::string createMessage;

Outcome createFailed(const Error& error) {
  createMessage = error.message;
  return {error.code, createMessage.c_str()};
}

Result<std::vector<device::Capability>> capabilitiesNamed(const char* const* names, std::size_t count) {
  std::vector<device::Capability> capabilities;
  for (std::size_t i = 0; i < count; ++i) {
    if (names == nullptr || names[i] == nullptr)
      return Error{ErrorCode::invalidArgument, "a name of EngineDesc::forcedOff is null"};
    auto capability = device::capabilityFromName(names[i]);
    if (!capability) return capability.error();
    capabilities.push_back(*capability);
  }
  return capabilities;
}
}  // namespace

Engine::Engine() : state_(new State) {}

Status Engine::State::openContext() {
  encoder.reset();
  executor.reset();
  programs.reset();
  const gl::GetProcAddress load = [this](const char* name) {
    return getProcAddress(name, getProcAddressUser);
  };
  if (context) {
    if (Status s = context->reopen(load, contextOptions); !s) return s;
  } else {
    auto opened = gl::Context::create(load, contextOptions);
    if (!opened) return opened.error();
    context = std::move(opened).value();
  }
  programs =
      std::make_unique<gl::ProgramCache>(*context,
                                         shaderFolder.empty() ? gl::ShaderSourceProvider(gl::embeddedShader)
                                                              : gl::directoryShaders(shaderFolder),
                                         techniques::allShaderFamilies(techniques));
  encoder = std::make_unique<gl::Encoder>(*context);
  executor = std::make_unique<framegraph::Executor>(*context);
  techniqueReasons.clear();
  for (const auto& each : techniques)
    techniqueReasons.push_back(each->support(context->capabilities()).reason);
  return {};
}

Engine* Engine::create(const EngineDesc& desc, Outcome& outcome) {
  try {
    return State::create(desc, outcome);
  } catch (...) {
    outcome = {ErrorCode::outOfMemory,
               "the system has no memory left for an engine; free some and try again"};
    return nullptr;
  }
}

Engine* Engine::State::create(const EngineDesc& desc, Outcome& outcome) {
  if (desc.getProcAddress == nullptr) {
    outcome = createFailed(
        {ErrorCode::invalidArgument, "EngineDesc::getProcAddress is null; pass the host's loader"});
    return nullptr;
  }
  if (desc.hostState < HostState::restore || desc.hostState > HostState::leaveDirty) {
    outcome =
        createFailed({ErrorCode::invalidArgument, "EngineDesc::hostState is none of HostState's values"});
    return nullptr;
  }
  auto forcedOff = capabilitiesNamed(desc.forcedOff, desc.forcedOffCount);
  if (!forcedOff) {
    outcome = createFailed(forcedOff.error());
    return nullptr;
  }
  std::unique_ptr<Engine> engine(new Engine);
  State& state = *engine->state_;
  state.getProcAddress = desc.getProcAddress;
  state.getProcAddressUser = desc.getProcAddressUser;
  state.workers = Workers(desc.parallelFor, desc.parallelForUser);
  state.contextOptions.forcedOff = std::move(*forcedOff);
  if (desc.shaderFolder) state.shaderFolder = desc.shaderFolder;
  state.hostState = desc.hostState;
  state.techniques = techniques::makeAllTechniques();
  if (Status s = state.openContext(); !s) {
    outcome = createFailed(s.error());
    return nullptr;
  }
  if (desc.programProofs) state.proofs.restore(desc.programProofs, state.context->capabilities().driver);
  state.settings = std::make_unique<techniques::Settings>(techniques::allSettings(state.techniques));
  state.technique = state.techniqueNamed("hard");
  state.setLights(std::vector<scene::AreaLight>{});
  outcome = {};
  return engine.release();
}

Engine::~Engine() {
  if (state_->context) {
    // Without memory to remember the host's state it stays as deleting leaves it.
    std::optional<gl::HostStateGuard> guard;
    try {
      guard.emplace(*state_->context, state_->policy());
    } catch (...) {
    }
    state_->lastFrame.reset();
    state_->lightCaches = {};
    state_->executor.reset();
    state_->shared.forget();
    state_->receivers = {};
    state_->objects.clear();
    state_->techniques.clear();
    state_->encoder.reset();
    state_->programs.reset();
    state_->forwardPrograms.clear();
  }
  delete state_;
}

void Engine::contextLost() {
  state_->context->markLost();
}

Status Engine::State::uploadObjects() {
  std::set<api::ObjectMesh*> uploaded;
  for (auto& [id, object] : objects) {
    if (uploaded.insert(object.mesh.get()).second) {
      if (Status s = object.mesh->upload(*context); !s) return s;
    }
    if (Status s = object.uploadTextures(*context); !s) return s;
  }
  return context->checkErrors("making the objects again");
}

Outcome Engine::contextRestored() {
  State& state = *state_;
  // Names of the context before are names of other things in this one.
  state.context->markLost();
  const Outcome outcome = state.guarded([&]() -> Outcome {
    state.forgetDerived();
    state.forwardPrograms.clear();
    for (auto& [id, object] : state.objects) object.forgetUploads();
    if (Status s = state.openContext(); !s) return state.fail(s.error());
    gl::HostStateGuard guard(*state.context, state.policy());
    if (Status s = state.uploadObjects(); !s) {
      state.context->markLost();
      return state.fail(s.error());
    }
    ++state.changes;
    return {};
  });
  if (!outcome.ok()) {
    state.context->markLost();
    for (auto& [id, object] : state.objects) object.forgetUploads();
  }
  return outcome;
}

int Engine::liveObjectCount() const {
  return state_->context->liveObjects().total();
}

void Engine::finish() {
  if (!state_->context->lost()) state_->encoder->finish();
}

}  // namespace halfshadow
