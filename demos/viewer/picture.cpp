// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/picture.hpp"

#include <algorithm>
#include <chrono>

namespace halfshadow::viewer {
namespace {
using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

bool sameView(const scene::Camera& a, const scene::Camera& b) {
  return a.eyeWorld == b.eyeWorld && a.targetWorld == b.targetWorld && a.up == b.up &&
         a.verticalFovRadians == b.verticalFovRadians && a.nearDistance == b.nearDistance &&
         a.farDistance == b.farDistance;
}
}  // namespace

Result<std::unique_ptr<Picture>> Picture::open(const measure::HostContext& context, const View& view) {
  auto session = measure::EngineSession::openIn(
      context,
      {.forcedOff = view.forcedOff, .deviceProfile = view.deviceProfile, .hostState = HostState::restore});
  if (!session) return session.error();
  std::unique_ptr<Picture> picture(new Picture);
  picture->session_ = std::move(session).value();
  picture->listRegistry();
  return picture;
}

void Picture::listRegistry() {
  Engine& engine = session_->engine();
  for (std::size_t i = 0; i < engine.techniqueCount(); ++i) {
    const TechniqueRecord record = engine.technique(i);
    techniques_.push_back({record.id, record.summary, record.guarantees, record.knownFailures, record.paper,
                           record.supported, record.unsupportedReason});
  }
  for (std::size_t i = 0; i < engine.settingCount(); ++i) {
    const SettingRecord record = engine.setting(i);
    settings_.push_back({record.key, record.type, record.value, record.allowed, record.text});
    values_[record.key] = record.value;
  }
}

std::string Picture::value(const std::string& key, const Choices& choices) const {
  if (const auto chosen = choices.find(key); chosen != choices.end()) return chosen->second;
  const auto found = std::ranges::find(settings_, key, &SettingChoice::key);
  return found == settings_.end() ? "" : found->start;
}

Status Picture::applyScene(const View& view) {
  if (scene_ != view.scene) {
    valid_ = false;
    scene_ = nullptr;  // half loaded, if this fails
    if (Status status = session_->update(*view.scene); !status) return status;
    scene_ = view.scene;
  }
  if (lights_ != view.lights) {
    valid_ = false;
    lights_.clear();
    if (Status status = session_->setLights(view.lights); !status) return status;
    lights_ = view.lights;
  }
  return {};
}

Status Picture::applySettings(const Wanted& wanted) {
  if (technique_ != wanted.technique) {
    valid_ = false;
    if (Status status = session_->choose(wanted.technique, {}); !status) return status;
    technique_ = wanted.technique;
  }
  for (const SettingChoice& setting : settings_) {
    const std::string text = value(setting.key, wanted.choices);
    if (values_[setting.key] == text) continue;
    valid_ = false;
    if (Status status = session_->set({{setting.key, text}}); !status) return status;
    values_[setting.key] = text;
  }
  // A key that no setting has is an error of whoever chose it.
  for (const auto& [key, text] : wanted.choices) {
    if (values_.contains(key)) continue;
    if (Status status = session_->set({{key, text}}); !status) return status;
  }
  return {};
}

Status Picture::apply(const View& view, const Wanted& wanted) {
  if (Status status = applyScene(view); !status) return status;
  return applySettings(wanted);
}

RenderDesc Picture::descOf(const View& view, const Wanted& wanted) const {
  RenderDesc desc{.camera = measure::cameraDesc(view.camera),
                  .target = {.width = view.width, .height = view.height},
                  .output = wanted.output,
                  .timing = isTimed(wanted) ? Timing::perPass : Timing::off};
  if (wanted.measures && wanted.frame % 2 == 1) desc.camera = measure::nudged(desc.camera);
  return desc;
}

Status Picture::show(const View& view, const Wanted& wanted) {
  if (Status status = apply(view, wanted); !status) return status;
  const bool same = valid_ && !wanted.measures && !shown_.measures && shown_.output == wanted.output &&
                    width_ == view.width && height_ == view.height && sameView(camera_, view.camera);
  if (same) return {};
  valid_ = false;
  if (wanted.measures) {
    // As in measurements of moving lights: every map is made again.
    std::vector<scene::AreaLight> moved = lights_;
    const glm::dvec3 step = 1e-7 * (view.camera.targetWorld - moved.front().centerWorld);
    moved.front().centerWorld += static_cast<double>(wanted.frame % 2) * step;
    if (Status status = session_->setLights(moved); !status) return status;
  } else if (shown_.measures) {
    if (Status status = session_->setLights(lights_); !status) return status;
  }
  const Clock::time_point begin = Clock::now();
  if (Status status = session_->render(descOf(view, wanted)); !status) return status;
  facts_.cpuMs = millisecondsSince(begin);
  facts_.totalMs = 0.0;
  if (wanted.measures) {
    session_->engine().finish();
    facts_.totalMs = millisecondsSince(begin);
  }
  camera_ = view.camera, width_ = view.width, height_ = view.height;
  shown_ = wanted;
  valid_ = true;
  factsAreOld_ = true;
  ++revision_;
  return {};
}

const FrameFacts& Picture::facts() {
  if (!factsAreOld_) return facts_;
  const FrameReport report = session_->engine().report();
  facts_.counters = measure::countersOf(report);
  // While measuring, the times of the last frame that had some stay.
  const bool keepsTimes = shown_.measures && !isTimed(shown_) && !facts_.passes.empty();
  if (!keepsTimes) facts_.passes = measure::passesOf(report);
  facts_.skips = measure::skipsOf(report);
  facts_.planText = report.planText;
  facts_.memoryBytes = report.memoryBytes;
  factsAreOld_ = false;
  return facts_;
}

}  // namespace halfshadow::viewer
