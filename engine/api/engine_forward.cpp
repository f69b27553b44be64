// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <glm/gtc/type_ptr.hpp>

#include "api/engine_state.hpp"

namespace halfshadow {
namespace {
Error noFrame() {
  return {ErrorCode::invalidArgument,
          "no frame with this light was rendered; call render (Output::lightsOnly suffices) first"};
}
}  // namespace

Status Engine::State::checkForward(std::size_t light) const {
  if (context->lost()) return Error{ErrorCode::contextLost, "the context was lost; make a new engine"};
  if (!lastFrame || light >= lastFrame->lights.size()) return noFrame();
  if (!lastFrame->lights[light].shading.forward) {
    return Error{ErrorCode::capabilityMissing,
                 "technique " + technique->info().id + " works on the screen only; use Output::visibility"};
  }
  return {};
}

Outcome Engine::forwardSource(std::size_t light, ForwardRecord& record) {
  State& state = *state_;
  record = {};
  if (Status s = state.checkForward(light); !s) return state.fail(s.error());
  const techniques::ReceiverShading& shading = state.lastFrame->lights[light].shading;
  auto texts = techniques::forwardTexts(*state.programs, shading);
  if (!texts) return state.fail(texts.error());
  state.forwardTexts = std::move(texts).value();
  record = {.vertexGlsl = state.forwardTexts.vertex.c_str(),
            .fragmentGlsl = state.forwardTexts.fragment.c_str(),
            .textureUnits = static_cast<int>(shading.textures.size()),
            .readsFacetNormal =
                shading.usesFacetPlane && techniques::needsFacetStream(state.context->capabilities())};
  return {};
}

Outcome Engine::bindForward(std::size_t light, std::uint32_t program, const double worldFromObject[16],
                            int firstTextureUnit) {
  State& state = *state_;
  if (Status s = state.checkForward(light); !s) return state.fail(s.error());
  const techniques::ReceiverShading& shading = state.lastFrame->lights[light].shading;
  const int units = static_cast<int>(shading.textures.size());
  if (firstTextureUnit < 0 ||
      firstTextureUnit + units > state.context->capabilities().limits.fragmentTextureUnits) {
    return state.fail({ErrorCode::invalidArgument, "bindForward needs " + std::to_string(units) +
                                                       " texture units; choose a smaller firstTextureUnit"});
  }
  if (!state.context->functions().isProgram(program)) {
    return state.fail({ErrorCode::invalidArgument, "bindForward needs a linked program of the host's"});
  }
  gl::Program wrapped = gl::Program::wrap(*state.context, program);
  techniques::bindForward(*state.context, wrapped, shading, glm::make_mat4(worldFromObject), firstTextureUnit,
                          [&](framegraph::ResourceId resource) {
                            return state.executor->texture(state.lastFrame->graph, resource);
                          });
  const Status status = state.context->checkErrors("binding a host's program");
  return status ? Outcome{} : state.fail(status.error());
}

}  // namespace halfshadow
