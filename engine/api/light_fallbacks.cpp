// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/light_fallbacks.hpp"

#include <algorithm>

namespace halfshadow::api {
namespace {
/// A technique's own, then the last two of all.
std::vector<techniques::Fallback> ladderOf(const techniques::Technique& technique) {
  const std::string& id = technique.info().id;
  std::vector<techniques::Fallback> ladder = technique.fallbacks();
  if (id == "none") return ladder;
  if (id == "hard") {
    ladder.push_back({.text = "the light is drawn without shadows", .technique = "none"});
  } else {
    ladder.push_back({.text = "hard shadows", .technique = "hard"});
  }
  return ladder;
}
}  // namespace

const LightFallbacks::Steps* LightFallbacks::stepsOf(const techniques::Technique& technique) const {
  const auto found = std::ranges::find(steps_, &technique, &Steps::technique);
  return found == steps_.end() ? nullptr : &*found;
}

LightFallbacks::Choice LightFallbacks::choose(techniques::Technique& asked,
                                              const techniques::Settings& settings,
                                              const TechniqueNamed& techniqueNamed) {
  if (settingsRevision_ != settings.revision()) {
    settingsRevision_ = settings.revision();
    steps_.clear();
  }
  constexpr std::size_t kKept = 4;
  Choice choice{&asked, &settings, {}};
  while (choice.technique != nullptr) {
    const Steps* steps = stepsOf(*choice.technique);
    if (steps == nullptr) break;
    const std::vector<techniques::Fallback> ladder = ladderOf(*choice.technique);
    const bool last = steps->count > ladder.size();
    const techniques::Fallback taken =
        last ? techniques::Fallback{.text = "nothing is left to take its place"} : ladder[steps->count - 1];
    choice.notes.emplace_back(choice.technique->info().id,
                              "program " + steps->program +
                                  " links without an error but draws nothing on this device: " + taken.text);
    if (last) {
      choice.technique = nullptr;
    } else if (!taken.technique.empty()) {
      choice.technique = techniqueNamed(taken.technique);
      choice.settings = &settings;
    } else {
      if (changed_.size() == kKept) changed_.erase(changed_.begin());
      changed_.push_back(std::make_unique<techniques::Settings>(settings.with(taken.settings)));
      choice.settings = changed_.back().get();
      break;
    }
  }
  return choice;
}

void LightFallbacks::stepDown(const techniques::Technique& technique, const std::string& program) {
  const auto found = std::ranges::find(steps_, &technique, &Steps::technique);
  Steps& steps = found == steps_.end() ? steps_.emplace_back(Steps{&technique}) : *found;
  ++steps.count;
  steps.program = program;
}

}  // namespace halfshadow::api
