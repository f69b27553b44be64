// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/ui_input.hpp"

#include <imgui.h>

#include <array>
#include <string>
#include <utility>

namespace halfshadow::viewer {
namespace {
const char* clipboardText(void* user) {
  static std::string text;  // ImGui reads it before it asks again
  text = static_cast<Window*>(user)->clipboard();
  return text.c_str();
}

/// Right keys have the codes of left ones, plus four.
bool isDown(const InputEvent& event, int modifier, int leftKey) {
  if (event.code == leftKey || event.code == leftKey + 4) return event.pressed;
  return (event.modifiers & modifier) != 0;
}

void setClipboardText(void* user, const char* text) {
  static_cast<Window*>(user)->setClipboard(text);
}
}  // namespace

std::vector<InputEvent> EventQueue::take() {
  std::vector<InputEvent> taken;
  bool moved = false;
  while (!events_.empty()) {
    const InputEvent::Kind kind = events_.front().kind;
    const bool presses = kind == InputEvent::Kind::button || kind == InputEvent::Kind::key;
    // A button acts where the pointer was when it was pressed.
    if (presses && !taken.empty() && (moved || taken.back().kind == kind)) break;
    if (!presses && !taken.empty() && taken.back().kind == InputEvent::Kind::button) break;
    moved = moved || (kind == InputEvent::Kind::move && events_.size() > 1 &&
                      events_[1].kind == InputEvent::Kind::button);
    taken.push_back(std::move(events_.front()));
    events_.pop_front();
  }
  return taken;
}

void connectUi(Window& window) {
  ImGuiIO& io = ImGui::GetIO();
  constexpr std::array<std::pair<ImGuiKey_, int>, 17> kKeys = {{{ImGuiKey_Tab, Window::kKeyTab},
                                                                {ImGuiKey_LeftArrow, Window::kKeyLeft},
                                                                {ImGuiKey_RightArrow, Window::kKeyRight},
                                                                {ImGuiKey_UpArrow, Window::kKeyUp},
                                                                {ImGuiKey_DownArrow, Window::kKeyDown},
                                                                {ImGuiKey_PageUp, Window::kKeyPageUp},
                                                                {ImGuiKey_PageDown, Window::kKeyPageDown},
                                                                {ImGuiKey_Home, Window::kKeyHome},
                                                                {ImGuiKey_End, Window::kKeyEnd},
                                                                {ImGuiKey_Delete, Window::kKeyDelete},
                                                                {ImGuiKey_Backspace, Window::kKeyBackspace},
                                                                {ImGuiKey_Space, Window::kKeySpace},
                                                                {ImGuiKey_Enter, Window::kKeyEnter},
                                                                {ImGuiKey_Escape, Window::kKeyEscape},
                                                                {ImGuiKey_A, 'A'},
                                                                {ImGuiKey_C, 'C'},
                                                                {ImGuiKey_V, 'V'}}};
  for (const auto& [key, code] : kKeys) io.KeyMap[key] = code;
  io.GetClipboardTextFn = clipboardText;
  io.SetClipboardTextFn = setClipboardText;
  io.ClipboardUserData = &window;
}

void feedUi(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputEvent::Kind::move:
      io.MousePos = {static_cast<float>(event.x), static_cast<float>(event.y)};
      break;
    case InputEvent::Kind::button:
      if (event.code >= 0 && event.code < 5) io.MouseDown[event.code] = event.pressed;
      io.KeyCtrl = (event.modifiers & Window::kControl) != 0;
      io.KeyShift = (event.modifiers & Window::kShift) != 0;
      break;
    case InputEvent::Kind::scroll:
      io.MouseWheelH += static_cast<float>(event.x);
      io.MouseWheel += static_cast<float>(event.y);
      break;
    case InputEvent::Kind::key:
      if (event.code >= 0 && event.code < 512) io.KeysDown[event.code] = event.pressed;
      // Of a modifier's own key, the window system tells what was down before.
      io.KeyShift = isDown(event, Window::kShift, Window::kKeyLeftShift);
      io.KeyCtrl = isDown(event, Window::kControl, Window::kKeyLeftControl);
      io.KeyAlt = isDown(event, Window::kAlt, Window::kKeyLeftAlt);
      break;
    case InputEvent::Kind::text:
      io.AddInputCharacter(event.codepoint);
      break;
    case InputEvent::Kind::drop:
      break;
  }
}

WindowCallbacks callbacksInto(EventQueue& queue) {
  using Action = WindowCallbacks::Action;
  using Kind = InputEvent::Kind;
  // GLFW tells a button's modifiers with the keys' events.
  return {
      .key =
          [&queue](int key, Action action, int modifiers) {
            if (action == Action::repeat)
              queue.push({.kind = Kind::key, .code = key, .modifiers = modifiers});
            queue.push({.kind = Kind::key,
                        .code = key,
                        .pressed = action != Action::release,
                        .modifiers = modifiers});
          },
      .character = [&queue](unsigned codepoint) { queue.push({.kind = Kind::text, .codepoint = codepoint}); },
      .button =
          [&queue](int button, Action action) {
            const ImGuiIO& io = ImGui::GetIO();
            queue.push(
                {.kind = Kind::button,
                 .code = button,
                 .pressed = action == Action::press,
                 .modifiers = (io.KeyShift ? Window::kShift : 0) | (io.KeyCtrl ? Window::kControl : 0)});
          },
      .move = [&queue](double x, double y) { queue.push({.kind = Kind::move, .x = x, .y = y}); },
      .scroll = [&queue](double x, double y) { queue.push({.kind = Kind::scroll, .x = x, .y = y}); },
      .drop =
          [&queue](const std::vector<std::string>& paths) {
            queue.push({.kind = Kind::drop, .paths = paths});
          }};
}

}  // namespace halfshadow::viewer
