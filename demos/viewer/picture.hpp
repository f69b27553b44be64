// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One engine and what it shows: a view under one technique, drawn into the engine's own texture.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/measurement.hpp"
#include "viewer/view.hpp"

namespace halfshadow::viewer {

struct TechniqueChoice {
  std::string id, summary, guarantees, failures, paper;
  bool supported = true;
  std::string reason;
};

struct SettingChoice {
  std::string key, type, start, allowed,
      text;  ///< as in SettingRecord; `start`: the device profile's or the default
};

/// What a frame cost and did, as values that outlive it.
struct FrameFacts {
  double cpuMs = 0.0;    ///< of Engine::render
  double totalMs = 0.0;  ///< until the GPU was done; only while measuring, else 0
  measure::Counters counters;
  std::vector<measure::PassMeasurement> passes;
  std::vector<measure::SkipMeasurement> skips;
  std::string planText;
  std::uint64_t memoryBytes = 0;
};

class Picture {
 public:
  /// Errors: those of EngineSession::openIn.
  static Result<std::unique_ptr<Picture>> open(const measure::HostContext& context, const View& view);

  /// Draws `view` unless the engine still holds it. `technique` and `choices` replace the view's. An error
  /// leaves the last picture. Errors: those of EngineSession.
  struct Wanted {
    std::string technique;
    Choices choices;
    Output output = Output::shaded;
    bool measures = false;    ///< everything is drawn again and timed by pass
    std::uint64_t frame = 0;  ///< while measuring: nudges light and camera, so that nothing is kept
  };
  Status show(const View& view, const Wanted& wanted);

  std::uint32_t texture() { return session_->engine().outputTexture(); }
  Output output() const { return shown_.output; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Pixels of the last picture, row 0 on top.
  Result<measure::RgbaImage> read() { return session_->read(width_, height_); }
  /// Counts up with every picture that differs from the one before.
  std::uint64_t revision() const { return revision_; }
  const FrameFacts& facts();
  /// Passes of the last frame were waited for one by one: they have times, and the frame as a whole has none.
  bool isTimedByPass() const { return isTimed(shown_); }
  Engine& engine() { return session_->engine(); }
  int sizeLimit() const { return session_->sizeLimit(); }

  const std::vector<TechniqueChoice>& techniques() const { return techniques_; }
  const std::vector<SettingChoice>& settings() const { return settings_; }
  /// The value that the setting has now.
  std::string value(const std::string& key, const Choices& choices) const;

 private:
  Picture() = default;
  static bool isTimed(const Wanted& wanted) { return wanted.measures && wanted.frame % 8 == 0; }
  void listRegistry();
  Status apply(const View& view, const Wanted& wanted);
  Status applyScene(const View& view);
  Status applySettings(const Wanted& wanted);
  RenderDesc descOf(const View& view, const Wanted& wanted) const;

  std::unique_ptr<measure::EngineSession> session_;
  std::vector<TechniqueChoice> techniques_;
  std::vector<SettingChoice> settings_;
  std::shared_ptr<const scene::SceneDescription> scene_;  ///< that is loaded
  std::vector<scene::AreaLight> lights_;
  Choices values_;  ///< of all settings, as they were set last
  std::string technique_;
  Wanted shown_;
  int width_ = 0, height_ = 0;
  scene::Camera camera_;
  bool valid_ = false;  ///< the picture is of camera_, lights_, … as they are
  std::uint64_t revision_ = 0;
  FrameFacts facts_;
  bool factsAreOld_ = true;
};

}  // namespace halfshadow::viewer
