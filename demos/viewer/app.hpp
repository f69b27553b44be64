// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The viewer: a window, its panels, and the pictures behind them.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include "viewer/error_map.hpp"
#include "viewer/overlay.hpp"
#include "viewer/panels.hpp"
#include "viewer/remembered.hpp"
#include "viewer/script.hpp"
#include "viewer/ui_input.hpp"
#include "viewer/viewer_options.hpp"
#include "window/window.hpp"

namespace halfshadow::viewer {

class App final : public Stage {
 public:
  /// Errors: driverMissing (no display, no ES 2.0), those of the first scene, and of Picture::open.
  static Result<std::unique_ptr<App>> create(ViewerOptions options);
  ~App() override;
  /// Until the window is closed, or the script has ended. Errors: of the script, and fileNotWritable.
  Status run();

  // Stage
  std::optional<Place> find(const std::string& name) override { return controls_.find(name); }
  void send(const InputEvent& event) override { queue_.push(event); }
  void resize(int width, int height) override { window_->setSize({width, height}); }
  void minimise() override { window_->minimise(); }
  void restore() override { window_->restore(); }
  Status writeScreenshot(const std::string& path) override;
  Status writeClipboard(const std::string& path) override;
  Status writePicture(const std::string& path) override;
  bool isSettled() const override;
  std::optional<double> value(const std::string& name) override;

 private:
  App() = default;
  Status start();
  Status startUi();
  Status beginComparison();
  measure::HostContext hostContext();
  void knowAgain();
  Status remember();

  // The loop (app.cpp).
  bool waitForNews();
  Status frame();
  void beginUi(double seconds);
  void buildUi();
  void advance(double seconds);
  void noteFrame(double beganSeconds);
  Status finish();
  Status writeFacts();

  // Scenes and requests (app_requests.cpp).
  Status open(const std::string& source);
  void tell(const Status& status, const std::string& news = {});
  void listAnimations(const std::string& source);
  void reload();
  void reloadIfChanged();
  void doRequests();
  void reopenEngine();
  std::string freeName(const char* extension) const;
  Status saveVisibility(const std::string& path);

  // The picture and hands on it (app_picture.cpp, app_hands.cpp).
  void layOut();
  void showPictures();
  void backToLastGood(const Status& status);
  Status showOther();
  Picture::Wanted wantedOf(const std::string& technique) const;
  void updateTruth();
  void updateHeatMap();
  void drawPicture();
  void drawSides();
  void drawLights();
  void drawMagnifier();
  void drawStatus();
  void onEvent(const InputEvent& event);
  void onPress(int button, int modifiers);
  void onDrag(const glm::dvec2& to);
  void onKey(int key, int modifiers);
  void stepTechnique(int step);
  ScreenSpace screen() const;
  glm::dvec2 pixelOf(const glm::dvec2& windowPlace) const { return windowPlace * picturePixelsPerPoint_; }
  bool isOnPicture(const glm::dvec2& place) const;

  ViewerOptions options_;
  std::string rememberPath_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<Overlay> overlay_;
  EventQueue queue_;
  Controls controls_;
  UiState state_;
  Requests requests_;
  std::unique_ptr<Picture> picture_, other_;
  std::unique_ptr<ScriptPlayer> player_;
  FrameTimes times_;
  bool measuresFrame_ = false;  ///< this one is to be timed as a whole
  std::filesystem::file_time_type fileTime_{};
  std::atomic<bool> truthHasNews_{false};
  std::unique_ptr<TruthWorker> truth_;

  OwnTexture truthTexture_, heatTexture_;
  std::shared_ptr<const TruthImage> truthShown_;  ///< in truthTexture_
  std::optional<metrics::ErrorStatistics> error_;
  std::uint64_t heatRevision_ = 0;
  double heatFullShown_ = 0.0;
  std::shared_ptr<const TruthImage> heatTruth_;
  std::optional<measure::RgbaImage> pixels_;  ///< of the picture, for the magnifier
  std::uint64_t pixelsRevision_ = 0;

  // Layout, in window coordinates.
  double pixelsPerPoint_ = 1.0, scale_ = 1.0;
  double picturePixelsPerPoint_ = 1.0;  ///< the picture's own, which --size may magnify
  double pictureWidth_ = 1.0, pictureHeight_ = 1.0;

  // Hands.
  glm::dvec2 pointer_{-1.0};
  enum class Drag { none, orbit, pan, handle, light, slider };
  Drag drag_ = Drag::none;
  std::optional<Handle> held_;
  scene::AreaLight heldStart_;
  glm::dvec3 flying_{0.0};  ///< keys that are down: right, up, forward

  std::optional<View> lastGood_;
  std::string technique_;  ///< of the last frame
  View truthWanted_;       ///< what the truth is of, to see that something moved
  scene::Camera fitted_;
  std::shared_ptr<const scene::SceneDescription> fittedTo_;
  std::uint64_t frames_ = 0, drawn_ = 0;
  int dueFrames_ = 4;  ///< to be drawn before it rests: ImGui takes a few to settle
  int glErrors_ = 0, reloads_ = 0;
  double lastFrameSeconds_ = 0.0;
  // For --json.
  double firstPictureMs_ = 0.0, slowestSwitchMs_ = 0.0;
  std::uint64_t earlyResidentBytes_ = 0;
  int earlyObjects_ = 0;
};

}  // namespace halfshadow::viewer
