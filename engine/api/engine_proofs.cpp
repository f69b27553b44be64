// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/engine_state.hpp"
#include "api/frame_desc.hpp"
#include "base/log.hpp"
#include "techniques/execution/program_uses.hpp"

namespace halfshadow {
namespace {
/// Files and short defines of a program's label.
std::string shortLabel(const std::string& label) {
  constexpr std::size_t kLongest = 160;
  return label.size() <= kLongest ? label : label.substr(0, kLongest) + "...";
}

/// Null when all draw, or nothing is known of them.
const gl::Program* firstDropped(const gl::ProgramProofs& proofs, const techniques::ProgramUses& uses) {
  for (const techniques::ProgramUses::Use& use : uses.uses()) {
    if (proofs.of(use.key) == gl::Proof::dropped) return use.program;
  }
  return nullptr;
}
}  // namespace

Result<api::LightFallbacks::Choice> Engine::State::choiceFor(Frame& frame, std::size_t light,
                                                             techniques::Technique& asked) {
  api::LightFallbacks::Choice choice = cacheOf(light).fallbacks.choose(
      asked, *settings, [this](std::string_view id) { return techniqueNamed(id); });
  if (choice.technique == nullptr) {
    return Error{ErrorCode::capabilityMissing,
                 nameOf(light) + " cannot be drawn on this device: " + choice.notes.back().second};
  }
  for (auto& [id, why] : choice.notes) frame.graph.noteSkipped(nameOf(light) + " " + id, std::move(why));
  return choice;
}

Result<bool> Engine::State::provePrograms(const Frame& frame, gl::Counters& spent) {
  const auto descOf = [&](framegraph::ResourceId id) -> const framegraph::ResourceDesc& {
    return frame.graph.resources()[id.index];
  };
  const device::Capabilities& capabilities = context->capabilities();
  const std::size_t drawn = frame.desc.output == Output::lightsOnly
                                ? 0
                                : api::drawnLights(frame.desc, frame.shading, frame.lights.size());
  std::vector<techniques::ProgramUses> uses(frame.lights.size(), {proofs, capabilities});
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const FrameLight& light = frame.lights[i];
    cacheOf(i).passes->addUses(uses[i]);
    if (i < drawn) uses[i].addReceivers(light.programs, light.shading, api::receiverTarget(i, drawn), descOf);
  }
  techniques::ProgramUses screen(proofs, capabilities);
  screen.addReceivers(frame.screenPrograms, frame.screenShading, {}, descOf);
  if (proofs.pending()) {
    const gl::Counters before = encoder->counters();
    const Status run = proofs.run(*encoder);
    spent = encoder->counters() - before;
    if (!run && context->lost()) return run.error();
    if (!run) {
      proofFailure = "unproven: " + run.error().message;
      logMessage(LogLevel::warning, "programs could not be proven to draw: " + run.error().message);
    }
  }
  if (const gl::Program* program = firstDropped(proofs, screen)) {
    return Error{ErrorCode::capabilityMissing,
                 "lights cannot be shaded together on this device: program " + shortLabel(program->label()) +
                     " links without an error but draws nothing; take Output::visibility, or one light"};
  }
  bool draws = true;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const gl::Program* program = firstDropped(proofs, uses[i]);
    if (program == nullptr) continue;
    cacheOf(i).fallbacks.stepDown(*frame.lights[i].technique, shortLabel(program->label()));
    draws = false;
  }
  return draws;
}

const char* Engine::programProofs() {
  State& state = *state_;
  state.proofsText = state.proofs.text(state.context->capabilities().driver);
  return state.proofsText.c_str();
}

}  // namespace halfshadow
