// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <imgui.h>

#include <algorithm>

#include "viewer/app.hpp"
#include "viewer/camera_motion.hpp"

namespace halfshadow::viewer {
namespace {
constexpr double kReach = 12.0;  ///< points round a handle in which it is taken
}

ScreenSpace App::screen() const {
  return {state_.view.camera, static_cast<double>(state_.view.width),
          static_cast<double>(state_.view.height)};
}

bool App::isOnPicture(const glm::dvec2& place) const {
  return place.x >= 0 && place.y >= 0 && place.x < pictureWidth_ && place.y < pictureHeight_;
}

void App::onEvent(const InputEvent& event) {
  const ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputEvent::Kind::move:
      onDrag({event.x, event.y});
      break;
    case InputEvent::Kind::button:
      if (!event.pressed) {
        drag_ = Drag::none;
        held_.reset();
      } else if (isOnPicture(pointer_) && !io.WantCaptureMouse) {
        onPress(event.code, event.modifiers);
      }
      break;
    case InputEvent::Kind::scroll:
      if (isOnPicture(pointer_) && !io.WantCaptureMouse) zoom(state_.view.camera, event.y);
      break;
    case InputEvent::Kind::key: {
      if (io.WantTextInput) break;
      const auto axis = [&](int key, int which, double direction) {
        if (event.code == key) flying_[which] = event.pressed && event.modifiers == 0 ? direction : 0.0;
      };
      axis('D', 0, 1.0), axis('A', 0, -1.0), axis('E', 1, 1.0), axis('Q', 1, -1.0);
      axis('W', 2, 1.0), axis('S', 2, -1.0);
      if (event.pressed) onKey(event.code, event.modifiers);
      break;
    }
    case InputEvent::Kind::text:
      break;
    case InputEvent::Kind::drop:
      if (!event.paths.empty()) requests_.open = event.paths.front();
      break;
  }
}

void App::onPress(int button, int modifiers) {
  if (button != 0 || (modifiers & Window::kShift) != 0) {
    drag_ = Drag::pan;
    return;
  }
  if ((modifiers & Window::kControl) != 0) {
    drag_ = Drag::light;
    return;
  }
  if (state_.compare != Compare::off && std::abs(pointer_.x - state_.slider * pictureWidth_) < kReach) {
    drag_ = Drag::slider;
    return;
  }
  drag_ = Drag::orbit;
  if (!state_.showsHandles) return;
  held_ = handleAt(handlesOf(state_.view.lights, screen()), pixelOf(pointer_),
                   kReach * picturePixelsPerPoint_ * scale_);
  if (!held_) return;
  drag_ = Drag::handle;
  state_.light = held_->light;
  heldStart_ = state_.view.lights[held_->light];
}

void App::onDrag(const glm::dvec2& to) {
  const glm::dvec2 moved = pixelOf(to - pointer_);
  pointer_ = to;
  View& view = state_.view;
  switch (drag_) {
    case Drag::none:
      break;
    case Drag::orbit:
      orbit(view.camera, moved, view.height);
      break;
    case Drag::pan:
      pan(view.camera, moved, view.height);
      break;
    case Drag::handle:
      if (held_ && held_->light < view.lights.size())
        view.lights[held_->light] = dragged(heldStart_, *held_, screen(), pixelOf(to));
      break;
    case Drag::light:
      if (state_.light < view.lights.size()) {
        const glm::dmat4 axes = scene::viewFromWorld(view.camera);
        view.lights[state_.light] = swung(view.lights[state_.light], view.camera.targetWorld,
                                          {axes[0][0], axes[1][0], axes[2][0]}, moved, view.height);
      }
      break;
    case Drag::slider:
      state_.slider = std::clamp(to.x / pictureWidth_, 0.0, 1.0);
      break;
  }
}

void App::stepTechnique(int step) {
  const auto& techniques = picture_->techniques();
  const auto found = std::ranges::find(techniques, state_.view.technique, &TechniqueChoice::id);
  const int count = static_cast<int>(techniques.size());
  int at = found == techniques.end() ? 0 : static_cast<int>(found - techniques.begin());
  do {
    at = (at + step + count) % count;
  } while (!techniques[static_cast<std::size_t>(at)].supported);
  state_.view.technique = techniques[static_cast<std::size_t>(at)].id;
}

void App::onKey(int key, int modifiers) {
  if ((modifiers & Window::kControl) != 0) {
    if (key == 'Q') window_->requestClose();
    return;
  }
  switch (key) {
    case '/':
    case Window::kKeyF1:
      state_.showsKeys = !state_.showsKeys;
      break;
    case Window::kKeyEscape:
      state_.showsKeys = false;
      state_.message.clear();
      break;
    case Window::kKeySpace:
      if (!state_.animations.empty()) {
        state_.playing = !state_.playing;
        requests_.repose = !state_.playing;
      } else {
        state_.path = state_.path == PathRun::off ? PathRun::light : PathRun::off;
      }
      break;
    case 'F':
      requests_.resetCamera = true;
      break;
    case 'N':
      stepTechnique(1);
      break;
    case 'B':
      stepTechnique(-1);
      break;
    case 'V':
      state_.showing = state_.showing == Showing::shaded ? Showing::visibility : Showing::shaded;
      break;
    case 'T':
      state_.compare = state_.compare == Compare::truth ? Compare::off : Compare::truth;
      break;
    case 'M':
      state_.magnifier = !state_.magnifier;
      break;
    case 'L':
      state_.showsHandles = !state_.showsHandles;
      break;
    case 'H':
      state_.showsPanels = !state_.showsPanels;
      break;
    case 'R':
      requests_.reload = true;
      break;
    case 'C':
      requests_.copyCommand = true;
      break;
    case 'P':
      requests_.savePicture = true;
      break;
    default:
      break;
  }
}

}  // namespace halfshadow::viewer
