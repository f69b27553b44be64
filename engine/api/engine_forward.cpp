// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "api/engine_state.hpp"
#include "base/keys.hpp"

namespace halfshadow {
namespace {
/// Hosts have fewer; one that makes programs without end, and never says which are gone, does not grow this.
constexpr std::size_t kMostPrograms = 256;

Error noFrame() {
  return {ErrorCode::invalidArgument,
          "no frame with this light was rendered; call render (Output::lightsOnly suffices) first"};
}
}  // namespace

Status Engine::State::checkForward(std::size_t light) const {
  if (context->lost()) return Error{ErrorCode::contextLost, "the context was lost; call contextRestored"};
  if (!lastFrame || light >= lastFrame->lights.size() || !hasLights) return noFrame();
  if (!lastFrame->lights[light].shading.forward) {
    return Error{ErrorCode::capabilityMissing,
                 "technique " + technique->info().id + " works on the screen only; use Output::visibility"};
  }
  return {};
}

void Engine::State::chooseForward(FrameLight& target, LightCache& cache) const {
  const auto techniqueIndex = static_cast<std::uint64_t>(
      std::ranges::find(techniques, technique, [](const auto& t) { return t.get(); }) - techniques.begin());
  const std::uint64_t chosen = combineKeys(settings->revision() + 1, techniqueIndex + 1);
  if (target.allLit && cache.forwardOf == chosen) {
    target.forward = cache.forward;
    return;
  }
  target.forward = techniques::forwardVariant(target.shading);
  if (target.allLit) return;
  cache.forward = target.forward;
  cache.forwardOf = chosen;
}

Outcome Engine::forwardSource(std::size_t light, ForwardRecord& record) {
  State& state = *state_;
  record = {};
  return state.guarded([&]() -> Outcome {
    if (Status s = state.checkForward(light); !s) return state.fail(s.error());
    const techniques::ForwardVariant& variant = state.lastFrame->lights[light].forward;
    auto texts = techniques::forwardTexts(*state.programs, variant);
    if (!texts) return state.fail(texts.error());
    state.forwardTexts = std::move(texts).value();
    record = {.vertexGlsl = state.forwardTexts.vertex.c_str(),
              .fragmentGlsl = state.forwardTexts.fragment.c_str(),
              .textureUnits = static_cast<int>(variant.samplers.size()),
              .readsFacetNormal =
                  variant.usesFacetPlane && techniques::needsFacetStream(state.context->capabilities()),
              .serial = variant.key};
    return {};
  });
}

Outcome Engine::forwardSerials(std::size_t light, ForwardSerials& serials) {
  State& state = *state_;
  serials = {};
  return state.guarded([&]() -> Outcome {
    if (Status s = state.checkForward(light); !s) return state.fail(s.error());
    serials = {.source = state.lastFrame->lights[light].forward.key, .bindings = state.forwardBindings};
    return {};
  });
}

Result<gl::Program*> Engine::State::forwardProgram(std::uint32_t name, const FrameLight& light) {
  auto found = forwardPrograms.find(name);
  if (found == forwardPrograms.end()) {
    const gl::Functions& gl = context->functions();
    GLint linked = 0;
    if (gl.isProgram(name)) gl.getProgramiv(name, GL_LINK_STATUS, &linked);
    if (!linked) return Error{ErrorCode::invalidArgument, "bindForward needs a linked program of the host's"};
    gl::Program wrapped = gl::Program::wrap(*context, name);
    if (wrapped.textKey() == 0) {
      return Error{
          ErrorCode::invalidArgument,
          "bindForward needs a program that calls halfshadow_visibility() of forwardSource()'s texts"};
    }
    if (forwardPrograms.size() >= kMostPrograms) forwardPrograms.clear();
    found = forwardPrograms.emplace(name, std::move(wrapped)).first;
  }
  if (!light.allLit && found->second.textKey() != light.forward.key) {
    return Error{ErrorCode::invalidArgument,
                 "the program is of older texts than the frame; link one of what forwardSource() gives now"};
  }
  return &found->second;
}

Outcome Engine::bindForward(std::size_t light, std::uint32_t program, const double worldFromObject[16],
                            int firstTextureUnit) {
  State& state = *state_;
  return state.guarded([&]() -> Outcome {
    if (Status s = state.checkForward(light); !s) return state.fail(s.error());
    const FrameLight& frameLight = state.lastFrame->lights[light];
    const int units = static_cast<int>(frameLight.forward.samplers.size());
    const int limit = state.context->capabilities().limits.fragmentTextureUnits;
    if (firstTextureUnit < 0 || firstTextureUnit > limit - units) {
      return state.fail(
          {ErrorCode::invalidArgument, "bindForward needs " + std::to_string(units) +
                                           " texture units; choose a smaller firstTextureUnit"});
    }
    if (worldFromObject == nullptr ||
        !std::all_of(worldFromObject, worldFromObject + 16, [](double e) { return std::isfinite(e); })) {
      return state.fail({ErrorCode::invalidArgument, "bindForward needs a matrix of 16 finite numbers"});
    }
    auto known = state.forwardProgram(program, frameLight);
    if (!known) return state.fail(known.error());
    if (frameLight.allLit) {
      techniques::bindForwardLit(*state.context, **known, frameLight.forward, firstTextureUnit);
      return {};
    }
    const glm::dmat4 placed = glm::make_mat4(worldFromObject);
    techniques::bindForward(*state.context, **known, frameLight.shading,
                            {.worldFromObject = placed,
                             .firstTextureUnit = firstTextureUnit,
                             .bound = state.forwardUnits,
                             .executor = *state.executor,
                             .graph = state.lastFrame->graph});
    return {};
  });
}

void Engine::forgetForwardProgram(std::uint32_t program) {
  state_->forwardPrograms.erase(program);
}

}  // namespace halfshadow
