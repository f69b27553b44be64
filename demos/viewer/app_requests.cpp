// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include <cstdio>

#include "images/images.hpp"
#include "measure/text_file.hpp"
#include "viewer/app.hpp"

namespace halfshadow::viewer {
namespace {
constexpr double kNewsSeconds = 4.0;

/// Looking along the light's emission from its centre.
scene::Camera cameraAtLight(const scene::AreaLight& light, const scene::Camera& camera) {
  constexpr double kFovRadians = 0.9;
  scene::Camera result = camera;
  const double distance = glm::distance(light.centerWorld, camera.targetWorld);
  result.eyeWorld = light.centerWorld;
  result.targetWorld = light.centerWorld + distance * scene::emissionDirection(light);
  result.up = light.halfV != glm::dvec3(0.0) ? glm::normalize(light.halfV) : glm::dvec3(0, 1, 0);
  result.verticalFovRadians = kFovRadians;
  return scene::checkCamera(result) ? result : camera;
}

bool isFile(const std::string& source) {
  return !source.starts_with("builtin:");
}

std::filesystem::file_time_type timeOf(const std::string& source) {
  std::error_code missing;
  const auto time = std::filesystem::last_write_time(source, missing);
  return missing ? std::filesystem::file_time_type{} : time;
}
}  // namespace

void App::tell(const Status& status, const std::string& news) {
  if (!status) {
    state_.message = status.error().message;
    state_.playing = false;
    return;
  }
  if (!news.empty()) state_.news = news, state_.newsUntil = window_->timeSeconds() + kNewsSeconds;
}

Status App::open(const std::string& source) {
  View view = state_.view;
  const bool isAnother = view.source != source || !view.scene;
  view.source = source;
  if (isAnother && view.scene) view.animationSeconds = 0.0, view.animationIndex = 0;
  if (Status status = openScene(view, Keep::nothing); !status) return status;
  listAnimations(source);
  fileTime_ = isFile(source) ? timeOf(source) : std::filesystem::file_time_type{};
  state_.view = std::move(view);
  state_.homeCamera = state_.view.camera;
  state_.homeLights = state_.view.lights;
  state_.message.clear();
  state_.playing = false;
  state_.light = 0;
  state_.seenFromLight = false;
  window_->setTitle("Halfshadow - " + source);
  dueFrames_ = std::max(dueFrames_, 3);
  return {};
}

void App::listAnimations(const std::string& source) {
  state_.animations.clear();
  if (!isFile(source)) return;
  if (auto animations = scenes::gltfAnimations(source)) state_.animations = std::move(animations).value();
}

void App::reload() {
  // Camera and lights stay where hands put them: only what the file holds is read again.
  View view = state_.view;
  const Status status = openScene(view, Keep::cameraAndLights);
  if (status) {
    state_.view = std::move(view);
    listAnimations(state_.view.source);
    state_.message.clear();
    ++reloads_;
  }
  tell(status, "read again: " + state_.view.source);
  dueFrames_ = std::max(dueFrames_, 3);
}

void App::reloadIfChanged() {
  if (!isFile(state_.view.source)) return;
  const auto time = timeOf(state_.view.source);
  if (time == fileTime_ || time == std::filesystem::file_time_type{}) return;
  fileTime_ = time;
  reload();
}

void App::reopenEngine() {
  auto fresh = Picture::open(hostContext(), state_.view);
  if (!fresh) {
    state_.view.forcedOff.clear();
    return tell(fresh.error());
  }
  other_.reset();
  picture_ = std::move(fresh).value();
  heatTruth_ = nullptr;
  pixels_.reset();
}

std::string App::freeName(const char* extension) const {
  for (int number = 1;; ++number) {
    char name[40];
    std::snprintf(name, sizeof name, "halfshadow_%04d%s", number, extension);
    if (!std::filesystem::exists(name)) return name;
  }
}

Status App::saveVisibility(const std::string& path) {
  View& view = state_.view;
  Picture::Wanted wanted = wantedOf(view.technique);
  wanted.output = view.lights.size() == 1 ? measure::visibilityOutputOf(view.technique) : Output::visibility;
  if (Status status = picture_->show(view, wanted); !status) return status;
  const auto image = picture_->read();
  if (!image) return image.error();
  images::FloatImage floats{.width = image->width, .height = image->height};
  floats.channels = static_cast<int>(view.lights.size());
  for (std::size_t k = 0; k < view.lights.size(); ++k)
    floats.channelNames.push_back(k == 0 ? "V" : "V" + std::to_string(k));
  if (view.lights.size() == 1) {
    floats.pixels = measure::decodeVisibility(*image, wanted.output);
  } else {
    for (std::size_t i = 0; i < image->pixels.size(); i += 4) {
      for (std::size_t k = 0; k < view.lights.size(); ++k)
        floats.pixels.push_back(static_cast<float>(image->pixels[i + k]) / 255.0f);
    }
  }
  return images::writeExr(path, floats);
}

void App::doRequests() {
  const Requests asked = std::move(requests_);
  requests_ = {};
  View& view = state_.view;
  if (asked.open) tell(open(*asked.open), "opened " + *asked.open);
  if (asked.reload) reload();
  if (asked.repose) {
    // At rest the ground is fitted to the pose, as the command line does it.
    View posed = view;
    const Status status = openScene(posed, Keep::cameraAndLights);
    if (status) view = std::move(posed);
    tell(status);
  }
  if (asked.resetCamera) view.camera = state_.homeCamera;
  if (asked.resetLights) view.lights = state_.homeLights, state_.light = 0;
  if (asked.toggleLightView) {
    if (!state_.seenFromLight) state_.besideLight = view.camera;
    view.camera =
        state_.seenFromLight ? state_.besideLight : cameraAtLight(view.lights[state_.light], view.camera);
    state_.seenFromLight = !state_.seenFromLight;
  }
  if (asked.reopenEngine) reopenEngine();
  if (asked.copyCommand) {
    window_->setClipboard(commandLine(view, "halfshadow render", "-o picture.png"));
    tell({}, "the command line is on the clipboard");
  }
  if (asked.savePicture) {
    const std::string name = freeName(".png");
    tell(writePicture(name), "saved " + name);
  }
  if (asked.saveVisibility) {
    const std::string name = freeName(".exr");
    tell(saveVisibility(name), "saved " + name);
  }
}

// What scripts ask for.

Status App::writeScreenshot(const std::string& path) {
  const Window::Size size = window_->framebufferSize();
  // The frame that was shown may be gone with its buffer.
  overlay_->draw(*ImGui::GetDrawData());
  return images::writePng(path, size.width, size.height, 3, windowPixels(size.width, size.height));
}

Status App::writeClipboard(const std::string& path) {
  return measure::writeTextFile(path, window_->clipboard() + "\n");
}

Status App::writePicture(const std::string& path) {
  Picture::Wanted wanted = wantedOf(state_.view.technique);
  wanted.output = Output::shaded;
  wanted.measures = false;
  if (Status status = picture_->show(state_.view, wanted); !status) return status;
  const auto image = picture_->read();
  if (!image) return image.error();
  std::vector<std::uint8_t> rgb;
  for (std::size_t i = 0; i < image->pixels.size(); i += 4)
    rgb.insert(rgb.end(), image->pixels.begin() + static_cast<long>(i),
               image->pixels.begin() + static_cast<long>(i) + 3);
  return images::writePng(path, image->width, image->height, 3, rgb);
}

bool App::isSettled() const {
  const bool wants = state_.compare == Compare::truth || state_.heatMap;
  return !wants || (truth_->state().done && (truth_->image() || !truth_->state().error.empty()));
}

std::optional<double> App::value(const std::string& name) {
  if (name == "rmse" && error_) return error_->rmse;
  if (name == "p99" && error_) return error_->p99;
  if (name == "gl-errors") return glErrors_;
  if (name == "frames") return static_cast<double>(frames_);
  if (name == "drawn") return static_cast<double>(drawn_);
  if (name == "memory-mib") return static_cast<double>(picture_->facts().memoryBytes) / (1 << 20);
  if (name == "message") return state_.message.empty() ? 0.0 : 1.0;
  if (name == "lights") return static_cast<double>(state_.view.lights.size());
  if (name == "objects") return static_cast<double>(state_.view.scene->objects.size());
  if (name == "reloads") return reloads_;
  if (name == "width") return state_.view.width;
  if (name == "height") return state_.view.height;
  if (name == "ms" && times_.count() > 0) return static_cast<double>(times_.total().back());
  return std::nullopt;
}

}  // namespace halfshadow::viewer
