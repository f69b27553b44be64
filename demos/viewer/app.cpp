// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/app.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "images/images.hpp"
#include "measure/text_file.hpp"
#include "viewer/camera_motion.hpp"

namespace halfshadow::viewer {
namespace {
constexpr double kScriptStep = 1.0 / 60.0;  ///< seconds a frame, so that scripts do the same on any machine
constexpr double kPathRound = 16.0;         ///< seconds
/// Every picture of a measurement's time follows at once.
constexpr double kLongestStep = 0.1;

/// GLFW asks the system's EGL, so the driver can only be one of its own.
Status chooseDriver(const std::string& driver) {
  if (driver == "default") return {};
  if (driver == "llvmpipe" || driver == "softpipe") {
    setenv("GALLIUM_DRIVER", driver.c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    return {};
  }
  return Error{
      ErrorCode::invalidArgument,
      "--driver " + driver +
          " draws without windows only; give default, llvmpipe or softpipe, or use `halfshadow render`"};
}

/// A proportional font of Debian's is easier to read, and sharp at any size; ImGui's own will do.
void loadFont(float pixels) {
  constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  if (std::filesystem::exists(kFont) && fonts.AddFontFromFileTTF(kFont, pixels) != nullptr) return;
  ImFontConfig config;
  config.SizePixels = pixels;
  fonts.AddFontDefault(&config);
}
}  // namespace

Result<std::unique_ptr<App>> App::create(ViewerOptions options) {
  std::unique_ptr<App> app(new App);
  app->options_ = std::move(options);
  if (Status status = app->start(); !status) return status.error();
  return app;
}

App::~App() {
  truth_.reset();  // its thread wakes the window
  picture_.reset();
  other_.reset();
  overlay_.reset();
  if (ImGui::GetCurrentContext() != nullptr) ImGui::DestroyContext();
}

void App::knowAgain() {
  const bool isScripted = options_.isScripted();
  if (options_.remember == "auto") {
    rememberPath_ = isScripted ? "" : rememberedPath();
  } else if (options_.remember != "none") {
    rememberPath_ = options_.remember;
  }
  const Remembered known = rememberPath_.empty() ? Remembered{} : readRemembered(rememberPath_);
  View& view = state_.view;
  view = options_.view;
  if (!options_.sceneIsGiven && !known.source.empty()) view.source = known.source;
  if (!options_.techniqueIsGiven && !known.technique.empty()) {
    view.technique = known.technique;
    for (const auto& [key, value] : known.choices) view.choices.try_emplace(key, value);
  }
  state_.tab = known.tab;
  state_.showsHandles = known.showsHandles;
  if (!options_.windowWidth)
    options_.windowWidth = known.windowWidth, options_.windowHeight = known.windowHeight;
  options_.windowX = known.windowX, options_.windowY = known.windowY;
}

Status App::start() {
  if (Status status = chooseDriver(options_.view.driver); !status) return status;
  if (!options_.script.empty()) {
    auto lines = readScript(options_.script);
    if (!lines) return lines.error();
    player_ = std::make_unique<ScriptPlayer>(std::move(lines).value());
  }
  knowAgain();
  auto window =
      Window::create({.width = *options_.windowWidth,
                      .height = *options_.windowHeight,
                      .title = "Halfshadow",
                      .vsync = options_.isScripted() ? WindowOptions::Vsync::off : WindowOptions::Vsync::on,
                      .depthBits = 0,
                      .stencilBits = 0,
                      .context = options_.context});
  if (!window) return window.error();
  window_ = std::move(window).value();
  if (options_.windowX && options_.windowY) window_->setPosition({*options_.windowX, *options_.windowY});
  if (Status status = startUi(); !status) return status;
  const Status opened = open(state_.view.source);
  if (!opened && (options_.sceneIsGiven || !state_.view.scene)) {
    // What was remembered may be gone; what was asked for must be there.
    if (options_.sceneIsGiven) return opened;
    if (Status status = open("builtin:figure"); !status) return status;
  }
  View& view = state_.view;
  if (options_.camera) view.camera = *options_.camera;
  if (!options_.lights.empty()) view.lights = options_.lights;
  auto picture = Picture::open(hostContext(), view);
  if (!picture) return picture.error();
  picture_ = std::move(picture).value();
  if (Status status = beginComparison(); !status) return status;
  truth_ = std::make_unique<TruthWorker>(options_.samples, [this] {
    truthHasNews_ = true;
    Window::wake();
  });
  return {};
}

Status App::beginComparison() {
  state_.showing = options_.showing;
  if (options_.beside.empty()) return {};
  if (options_.beside == "truth") {
    state_.compare = Compare::truth;
    return {};
  }
  if (std::ranges::find(picture_->techniques(), options_.beside, &TechniqueChoice::id) ==
      picture_->techniques().end()) {
    return Error{ErrorCode::unknownTechnique,
                 "--beside: there is no technique \"" + options_.beside +
                     "\"; give truth, or one that `halfshadow techniques` lists"};
  }
  state_.compare = Compare::technique;
  state_.otherTechnique = options_.beside;
  return {};
}

Status App::startUi() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  scale_ = options_.scale > 0.0 ? options_.scale : window_->contentScale();
  loadFont(static_cast<float>(14.0 * scale_));
  ImGui::StyleColorsDark();
  ImGui::GetStyle().AntiAliasedLinesUseTex =
      false;  // the font's image is not filtered: upright lines had kinks
  ImGui::GetStyle().ScaleAllSizes(static_cast<float>(scale_));
  auto overlay = Overlay::create();
  if (!overlay) return overlay.error();
  overlay_ = std::move(overlay).value();
  connectUi(*window_);
  WindowCallbacks callbacks = callbacksInto(queue_);
  callbacks.refresh = [this] { dueFrames_ = std::max(dueFrames_, 2); };
  callbacks.framebufferSize = [this](int, int) { dueFrames_ = std::max(dueFrames_, 3); };
  window_->setCallbacks(std::move(callbacks));
  return {};
}

measure::HostContext App::hostContext() {
  return {.getProcAddress = [](const char* name,
                               void* user) { return static_cast<Window*>(user)->getProcAddress(name); },
          .user = window_.get(),
          .description = std::string("a window, ") + window_->contextName()};
}

bool App::waitForNews() {
  constexpr double kRestSeconds = 0.4;      // between looks at the file
  constexpr double kProgressSeconds = 0.2;  // between looks at the truth: drawing takes time from tracing
  const bool moves =
      state_.measures || state_.playing || state_.path != PathRun::off || flying_ != glm::dvec3(0.0);
  const bool traces = !truth_->state().done;
  if (options_.isScripted() || moves || dueFrames_ > 0 || !queue_.empty()) {
    window_->poll();
  } else {
    window_->wait(traces ? kProgressSeconds : kRestSeconds);
    if (traces) dueFrames_ = 1;
  }
  reloadIfChanged();
  if (!queue_.empty()) dueFrames_ = std::max(dueFrames_, 3);
  if (truthHasNews_.exchange(false)) dueFrames_ = std::max(dueFrames_, 1);
  if (!state_.news.empty() && window_->timeSeconds() > state_.newsUntil) {
    state_.news.clear();
    dueFrames_ = std::max(dueFrames_, 1);
  }
  return options_.isScripted() || moves || dueFrames_ > 0;
}

Status App::run() {
  while (!window_->shouldClose()) {
    if (!waitForNews()) continue;
    if (player_) {
      if (Status status = player_->step(*this); !status) return status;
    }
    if (Status status = frame(); !status) return status;
    const bool scriptEnded = !player_ || player_->isDone();
    const bool framesEnded = options_.frames == 0 || frames_ >= static_cast<std::uint64_t>(options_.frames);
    if (options_.isScripted() && framesEnded && scriptEnded && queue_.empty()) break;
    if (options_.frames > 0 && framesEnded && !scriptEnded) {
      return Error{ErrorCode::invalidArgument, "the script did not end within --frames " +
                                                   std::to_string(options_.frames) + "; give more"};
    }
  }
  if (Status status = finish(); !status) return status;
  return remember();
}

Status App::frame() {
  const double now = window_->timeSeconds();
  measuresFrame_ = false;
  const double seconds =
      options_.isScripted() ? kScriptStep : std::min(now - lastFrameSeconds_, kLongestStep);
  lastFrameSeconds_ = now;
  ++frames_;
  if (dueFrames_ > 0) --dueFrames_;
  for (const InputEvent& event : queue_.take()) {
    feedUi(event);
    onEvent(event);
  }
  if (window_->isMinimised() || window_->framebufferSize().width == 0) return {};
  beginUi(std::max(seconds, 1e-4));
  layOut();
  advance(seconds);
  buildUi();
  doRequests();
  showPictures();
  updateTruth();
  updateHeatMap();
  drawPicture();
  controls_.endFrame();
  ImGui::Render();
  overlay_->draw(*ImGui::GetDrawData());
  glErrors_ += takeGlErrors();
  window_->swap();
  noteFrame(now);
  return {};
}

void App::beginUi(double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  const Window::Size size = window_->size(), pixels = window_->framebufferSize();
  io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  pixelsPerPoint_ = static_cast<double>(pixels.width) / std::max(size.width, 1);
  io.DisplayFramebufferScale = {static_cast<float>(pixelsPerPoint_), static_cast<float>(pixelsPerPoint_)};
  io.DeltaTime = static_cast<float>(seconds);
  ImGui::NewFrame();
}

void App::buildUi() {
  PanelInput in{state_, requests_, controls_, *picture_, *truth_, times_, error_};
  keysWindow(in);
  if (!state_.showsPanels) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x - panelWidth(), 0});
  ImGui::SetNextWindowSize({panelWidth(), size.y});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus;
  ImGui::Begin("panels", nullptr, kFlags);
  constexpr std::pair<const char*, void (*)(PanelInput&)> kTabs[] = {
      {"Scene", scenePanel}, {"Shadows", shadowPanel}, {"Compare", comparePanel}, {"Inside", insidePanel},
      {"Cost", costPanel},   {"Device", devicePanel},  {"Keep", keepPanel}};
  int count = 0;
  for (const auto& [name, panel] : kTabs) {
    if (count++ % 4 != 0) ImGui::SameLine();
    const bool chosen = state_.tab == name;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (namedButton(in, name, std::string("tab/") + name)) state_.tab = name;
    if (chosen) ImGui::PopStyleColor();
  }
  ImGui::BeginChild("panel");
  for (const auto& [name, panel] : kTabs) {
    if (state_.tab == name) panel(in);
  }
  ImGui::EndChild();
  ImGui::End();
}

void App::advance(double seconds) {
  View& view = state_.view;
  if (flying_ != glm::dvec3(0.0)) fly(view.camera, 0.8 * seconds * flying_);
  const double share = seconds / kPathRound;
  if (state_.path == PathRun::camera || state_.path == PathRun::both)
    orbit(view.camera, {2.0 * share * view.height, 0.0}, view.height);
  if (state_.path == PathRun::light || state_.path == PathRun::both) {
    for (scene::AreaLight& light : view.lights) light = turnedLight(light, view.camera.targetWorld, share);
  }
  if (state_.playing && !state_.animations.empty()) {
    const auto& info = state_.animations[static_cast<std::size_t>(std::max(view.animationIndex, 0))];
    view.animationSeconds += seconds;
    if (view.animationSeconds > info.seconds) view.animationSeconds = 0.0;
    tell(openScene(view, Keep::ground));
  }
}

Status App::finish() {
  if (!options_.screenshot.empty()) {
    if (Status status = writeScreenshot(options_.screenshot); !status) return status;
  }
  if (!options_.controls.empty()) {
    std::string text;
    for (const std::string& name : controls_.names()) text += name + "\n";
    if (Status status = measure::writeTextFile(options_.controls, text); !status) return status;
  }
  if (Status status = writeFacts(); !status) return status;
  if (glErrors_ > 0) {
    return Error{ErrorCode::driverFault,
                 "OpenGL reported " + std::to_string(glErrors_) + " errors while the viewer drew"};
  }
  return {};
}

Status App::remember() {
  if (rememberPath_.empty()) return {};
  const Window::Size size = window_->size();
  const Window::Position place = window_->position();
  return writeRemembered(rememberPath_, {.windowWidth = size.width,
                                         .windowHeight = size.height,
                                         .windowX = place.x,
                                         .windowY = place.y,
                                         .source = state_.view.source,
                                         .technique = state_.view.technique,
                                         .choices = state_.view.choices,
                                         .tab = state_.tab,
                                         .showsHandles = state_.showsHandles});
}

}  // namespace halfshadow::viewer
