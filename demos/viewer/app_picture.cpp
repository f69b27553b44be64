// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/app.hpp"
#include "viewer/light_lines.hpp"

namespace halfshadow::viewer {
namespace {
ImVec2 vec(const glm::dvec2& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

/// Text on a dark ground, readable on any picture.
void labelled(ImDrawList& list, ImVec2 at, ImU32 color, const char* text) {
  const ImVec2 size = ImGui::CalcTextSize(text);
  const float margin = 0.25f * ImGui::GetFontSize();
  list.AddRectFilled({at.x - margin, at.y - 0.3f * margin},
                     {at.x + size.x + margin, at.y + size.y + 0.3f * margin}, IM_COL32(10, 10, 12, 170),
                     margin);
  list.AddText(at, color, text);
}

Shown shownOf(Output output) {
  if (output == Output::shaded) return Shown::opaque;
  return output == Output::visibility16 ? Shown::word : Shown::red;
}
}  // namespace

void App::layOut() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const double panels = state_.showsPanels ? static_cast<double>(panelWidth()) : 0.0;
  pictureWidth_ = std::max(static_cast<double>(size.x) - panels, 64.0);
  pictureHeight_ = std::max(static_cast<double>(size.y), 64.0);
  View& view = state_.view;
  const auto allowed = [&](double pixels) {
    return std::clamp(static_cast<int>(std::lround(pixels)), 1, picture_->sizeLimit());
  };
  picturePixelsPerPoint_ = pixelsPerPoint_;
  if (!options_.fixedWidth) {
    view.width = allowed(pictureWidth_ * pixelsPerPoint_);
    view.height = allowed(pictureHeight_ * pixelsPerPoint_);
    return;
  }
  // As many pixels as asked for: each as a whole number of the window's where there is room, else all shrunk.
  view.width = allowed(*options_.fixedWidth);
  view.height = allowed(*options_.fixedHeight);
  const double fits = pixelsPerPoint_ * std::min(pictureWidth_ / view.width, pictureHeight_ / view.height);
  picturePixelsPerPoint_ /= fits < 1.0 ? fits : std::floor(fits);
  pictureWidth_ = view.width / picturePixelsPerPoint_;
  pictureHeight_ = view.height / picturePixelsPerPoint_;
}

Picture::Wanted App::wantedOf(const std::string& technique) const {
  const View& view = state_.view;
  Picture::Wanted wanted{.technique = technique, .choices = view.choices};
  const bool asNumbers =
      state_.showing == Showing::visibility || state_.compare == Compare::truth || state_.heatMap;
  if (asNumbers)
    wanted.output = view.lights.size() == 1 ? measure::visibilityOutputOf(technique) : Output::visibility;
  wanted.measures = state_.measures;
  wanted.frame = frames_;
  return wanted;
}

void App::showPictures() {
  View& view = state_.view;
  const bool moved = fittedTo_ != view.scene || fitted_.eyeWorld != view.camera.eyeWorld ||
                     fitted_.targetWorld != view.camera.targetWorld || fitted_.up != view.camera.up ||
                     fitted_.verticalFovRadians != view.camera.verticalFovRadians;
  if (moved) {
    scenes::fitNearAndFar(view.camera, *view.scene);
    fitted_ = view.camera;
    fittedTo_ = view.scene;
  }
  const std::uint64_t before = picture_->revision();
  const bool switches = technique_ != view.technique;
  const double began = window_->timeSeconds();
  Status status = picture_->show(view, wantedOf(view.technique));
  if (switches && !technique_.empty()) {
    picture_->engine().finish();
    slowestSwitchMs_ = std::max(slowestSwitchMs_, 1e3 * (window_->timeSeconds() - began));
  }
  technique_ = view.technique;
  if (picture_->revision() != before) {
    ++drawn_;
    measuresFrame_ = state_.measures && !picture_->isTimedByPass();
  }
  if (!state_.measures) times_.clear();
  if (!status) return backToLastGood(status);
  lastGood_ = view;
  status = showOther();
  if (status) return;
  state_.compare = Compare::off;
  tell(status);
}

void App::backToLastGood(const Status& status) {
  tell(status);
  if (!lastGood_) return;
  const int width = state_.view.width, height = state_.view.height;
  state_.view = *lastGood_;
  state_.view.width = width, state_.view.height = height;
  lastGood_.reset();  // it may be what fails: then no further back
  dueFrames_ = std::max(dueFrames_, 2);
}

Status App::showOther() {
  if (state_.compare != Compare::technique) return {};
  if (!other_) {
    auto opened = Picture::open(hostContext(), state_.view);
    if (!opened) return opened.error();
    other_ = std::move(opened).value();
  }
  Picture::Wanted wanted = wantedOf(state_.otherTechnique);
  wanted.measures = false;
  return other_->show(state_.view, wanted);
}

void App::updateTruth() {
  const View& view = state_.view;
  if (state_.compare == Compare::truth || state_.heatMap) {
    // While something moves, each question would be thrown away as soon as it was begun.
    if (drag_ == Drag::none || drag_ == Drag::slider)
      truth_->ask(view);
    else if (!sameTruth(truthWanted_, view))
      truth_->forget();
    truthWanted_ = view;
  } else {
    truth_->forget();
  }
  const auto image = truth_->image();
  if (image == truthShown_) return;
  truthShown_ = image;
  if (!image) return;
  std::vector<std::uint8_t> rgba;
  rgba.reserve(image->visibility.size() * 4);
  for (const float v : image->visibility) {
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f)));
    rgba.insert(rgba.end(), {grey, grey, grey, 255});
  }
  truthTexture_.upload(image->width, image->height, rgba.data());
}

void App::updateHeatMap() {
  const bool fits = state_.heatMap && truthShown_ && truthShown_->width == picture_->width() &&
                    truthShown_->height == picture_->height() && picture_->output() != Output::shaded;
  if (!fits) {
    error_.reset();
    heatTruth_ = nullptr;
    return;
  }
  const bool same =
      heatTruth_ == truthShown_ && heatRevision_ == picture_->revision() && heatFullShown_ == state_.heatFull;
  if (same) return;
  const auto image = picture_->read();
  if (!image) return tell(image.error());
  const ErrorMap map =
      errorMap(measure::decodeVisibility(*image, picture_->output()), *truthShown_, state_.heatFull);
  heatTexture_.upload(image->width, image->height, map.rgba.data());
  error_ = map.statistics;
  heatTruth_ = truthShown_, heatRevision_ = picture_->revision(), heatFullShown_ = state_.heatFull;
}

void App::drawSides() {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float width = static_cast<float>(pictureWidth_), height = static_cast<float>(pictureHeight_);
  const float split = state_.compare == Compare::off ? 1.0f : static_cast<float>(state_.slider);
  const auto side = [&](ImTextureID image, float from, float to, bool bottomFirst) {
    if (to <= from) return;
    list.AddImage(image, {from * width, 0}, {to * width, height}, {from, bottomFirst ? 1.0f : 0.0f},
                  {to, bottomFirst ? 0.0f : 1.0f});
  };
  if (heatTruth_) {
    side(imageId(heatTexture_.name(), Shown::opaque), 0, split, false);
  } else if (picture_->texture() != 0) {
    side(imageId(picture_->texture(), shownOf(picture_->output())), 0, split, true);
  }
  if (state_.compare == Compare::off) return;
  if (state_.compare == Compare::technique && other_ && other_->texture() != 0)
    side(imageId(other_->texture(), shownOf(other_->output())), split, 1, true);
  if (state_.compare == Compare::truth && truthShown_)
    side(imageId(truthTexture_.name(), Shown::opaque), split, 1, false);
  const float x = split * width;
  list.AddLine({x, 0}, {x, height}, IM_COL32(255, 200, 80, 255), static_cast<float>(2 * scale_));
  controls_.markPlace("slider", {static_cast<double>(x), pictureHeight_ / 2});
  const std::string left = heatTruth_ ? "error of " + state_.view.technique : state_.view.technique;
  const std::string right = state_.compare == Compare::truth
                                ? (truthShown_ ? "truth" : "truth is being traced")
                                : state_.otherTechnique;
  const float gap = ImGui::GetFontSize() * 0.5f, y = height - 2 * ImGui::GetFontSize();
  const auto label = [&](const std::string& text, float at) {
    labelled(list, {at, y}, IM_COL32(255, 220, 140, 255), text.c_str());
  };
  label(left, x - gap - ImGui::CalcTextSize(left.c_str()).x);
  label(right, x + gap);
}

void App::drawLights() {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ScreenSpace space = screen();
  const auto point = [&](const glm::dvec2& pixel) { return vec(pixel / picturePixelsPerPoint_); };
  const auto line = [&](const glm::dvec3& a, const glm::dvec3& b, ImU32 color, double width) {
    if (const auto segment = space.lineFromWorld(a, b))
      list.AddLine(point(segment->a), point(segment->b), color, static_cast<float>(width * scale_));
  };
  if (state_.showsSilhouettes || state_.showsWedges) {
    for (const LightLine& edge : linesOfLight(state_.view, state_.light, state_.showsWedges))
      line(edge.aWorld, edge.bWorld, edge.isOuter ? IM_COL32(90, 170, 255, 90) : IM_COL32(255, 120, 60, 230),
           1.0);
  }
  if (!state_.showsHandles) return;
  for (std::size_t i = 0; i < state_.view.lights.size(); ++i) {
    const auto corners = cornersOf(state_.view.lights[i]);
    const ImU32 color = i == state_.light ? IM_COL32(255, 230, 120, 255) : IM_COL32(190, 170, 100, 200);
    for (std::size_t k = 0; k < 4; ++k) line(corners[k], corners[(k + 1) % 4], color, 1.5);
  }
  const auto handles = handlesOf(state_.view.lights, space);
  for (const Handle& handle : handles) {
    const std::string name = "handle/" + std::to_string(handle.light + 1) + "/";
    constexpr const char* kNames[] = {"center", "aim", "sizeU", "sizeV"};
    const glm::dvec2 place = handle.pixel / picturePixelsPerPoint_;
    if (!isOnPicture(place)) continue;
    if (handle.kind == HandleKind::aim)
      line(state_.view.lights[handle.light].centerWorld, handle.placeWorld, IM_COL32(255, 230, 120, 140),
           1.0);
    const bool near = glm::distance(place, pointer_) < 12.0 * scale_;
    const float radius = static_cast<float>((handle.kind == HandleKind::center ? 6.0 : 4.5) * scale_);
    list.AddCircleFilled(vec(place), radius,
                         near ? IM_COL32(255, 255, 255, 255) : IM_COL32(255, 210, 80, 255));
    list.AddCircle(vec(place), radius, IM_COL32(40, 30, 0, 255));
    controls_.markPlace(name + kNames[static_cast<int>(handle.kind)], {place.x, place.y});
  }
}

void App::drawMagnifier() {
  if (!state_.magnifier || !isOnPicture(pointer_) || ImGui::GetIO().WantCaptureMouse) return;
  constexpr int kAcross = 15;  // pixels
  const View& view = state_.view;
  const glm::ivec2 at(pixelOf(pointer_));
  if (!pixels_ || pixelsRevision_ != picture_->revision()) {
    auto image = picture_->read();
    if (!image) return;
    pixels_ = std::move(image).value();
    pixelsRevision_ = picture_->revision();
  }
  if (at.x >= pixels_->width || at.y >= pixels_->height) return;
  const float cell = static_cast<float>(10 * scale_), side = cell * kAcross;
  ImVec2 corner(static_cast<float>(pointer_.x) + 2 * cell, static_cast<float>(pointer_.y) + 2 * cell);
  if (corner.x + side > static_cast<float>(pictureWidth_)) corner.x -= side + 4 * cell;
  const float below = 3.2f * ImGui::GetFontSize();  // room for the values
  if (corner.y + side + below > static_cast<float>(pictureHeight_)) corner.y -= side + below + 4 * cell;
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled({corner.x - 2, corner.y - 2}, {corner.x + side + 2, corner.y + side + below},
                     IM_COL32(20, 20, 24, 240));
  const bool onTruth =
      state_.compare == Compare::truth && truthShown_ && pointer_.x > state_.slider * pictureWidth_;
  for (int y = 0; y < kAcross; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      const int px = at.x + x - kAcross / 2, py = at.y + y - kAcross / 2;
      if (px < 0 || py < 0 || px >= pixels_->width || py >= pixels_->height) continue;
      const auto index = static_cast<std::size_t>(py) * static_cast<std::size_t>(pixels_->width) +
                         static_cast<std::size_t>(px);
      const std::uint8_t* p = pixels_->pixels.data() + index * 4;
      ImU32 color = IM_COL32(p[0], p[1], p[2], 255);
      if (picture_->output() != Output::shaded) color = IM_COL32(p[0], p[0], p[0], 255);
      if (onTruth && index < truthShown_->visibility.size()) {
        const int grey = static_cast<int>(std::lround(255.0f * truthShown_->visibility[index]));
        color = IM_COL32(grey, grey, grey, 255);
      }
      const ImVec2 low(corner.x + static_cast<float>(x) * cell, corner.y + static_cast<float>(y) * cell);
      list.AddRectFilled(low, {low.x + cell, low.y + cell}, color);
    }
  }
  const float middle = cell * (kAcross / 2);
  list.AddRect({corner.x + middle, corner.y + middle}, {corner.x + middle + cell, corner.y + middle + cell},
               IM_COL32(255, 80, 80, 255));
  const auto index =
      static_cast<std::size_t>(at.y) * static_cast<std::size_t>(view.width) + static_cast<std::size_t>(at.x);
  const std::uint8_t* p = pixels_->pixels.data() + index * 4;
  char text[120];
  if (picture_->output() == Output::shaded) {
    std::snprintf(text, sizeof text, "%d, %d: %d %d %d", at.x, at.y, p[0], p[1], p[2]);
  } else {
    const double value =
        picture_->output() == Output::visibility16 ? (256 * p[0] + p[1]) / 65280.0 : p[0] / 255.0;
    std::snprintf(text, sizeof text, "%d, %d: %.4f", at.x, at.y, value);
  }
  list.AddText({corner.x, corner.y + side + 2}, IM_COL32(255, 255, 255, 255), text);
  if (!truthShown_ || index >= truthShown_->visibility.size()) return;
  std::snprintf(text, sizeof text, "truth %.4f", static_cast<double>(truthShown_->visibility[index]));
  list.AddText({corner.x, corner.y + side + 2 + ImGui::GetFontSize()}, IM_COL32(255, 220, 140, 255), text);
}

void App::drawStatus() {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  char text[200];
  const View& view = state_.view;
  std::snprintf(text, sizeof text, "%s   %dx%d   %.1f ms CPU   ? keys", view.technique.c_str(), view.width,
                view.height, picture_->facts().cpuMs);
  const float font = ImGui::GetFontSize();
  labelled(list, {0.6f * font, 0.5f * font}, IM_COL32(230, 230, 230, 255), text);
  if (!state_.news.empty())
    labelled(list, {0.6f * font, 1.9f * font}, IM_COL32(160, 230, 160, 255), state_.news.c_str());
  if (state_.message.empty()) return;
  ImGui::SetNextWindowPos({0.6f * font, 3.2f * font});
  ImGui::SetNextWindowSize({std::min(static_cast<float>(pictureWidth_) - 1.2f * font, 42 * font), 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.35f, 0.08f, 0.08f, 0.95f));
  ImGui::Begin("message", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
  ImGui::TextWrapped("%s", state_.message.c_str());
  if (ImGui::Button("Close")) state_.message.clear();
  controls_.mark("message/close");
  ImGui::End();
  ImGui::PopStyleColor();
}

void App::drawPicture() {
  drawSides();
  drawLights();
  drawMagnifier();
  drawStatus();
}

}  // namespace halfshadow::viewer
