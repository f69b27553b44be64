// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A window with an OpenGL ES 2.0 context through EGL (GLFW 3.3).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/error.hpp"

struct GLFWwindow;

namespace halfshadow {

struct WindowOptions {
  int width = 1280, height = 720;  ///< screen coordinates, at least 1
  std::string title = "Halfshadow";
  enum class Vsync { on, off };
  Vsync vsync = Vsync::on;
  int depthBits = 24, stencilBits = 8;  ///< of framebuffer 0
  enum class Visibility { shown, hidden };
  Visibility visibility = Visibility::shown;
};

/// Positions are in screen coordinates from the window's top left corner. Unset ones are ignored.
struct WindowCallbacks {
  enum class Action { press, release, repeat };
  std::function<void(int key, Action action)> key;        ///< `key` is a Window::Key or a GLFW key code
  std::function<void(int button, Action action)> button;  ///< 0 left, 1 right, 2 middle
  std::function<void(double x, double y)> move;
  std::function<void(double dx, double dy)> scroll;
  std::function<void(int width, int height)> framebufferSize;  ///< pixels
};

/// The context is current on the creating thread. One thread makes and uses all windows.
class Window {
 public:
  /// Errors: invalidArgument (size), driverMissing (no display, or no OpenGL ES 2.0 through EGL).
  static Result<std::unique_ptr<Window>> create(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  enum Key {
    kKeySpace = 32,
    kKeyEscape = 256,
    kKeyEnter = 257,
    kKeyTab = 258,
    kKeyRight = 262,
    kKeyLeft = 263,
    kKeyDown = 264,
    kKeyUp = 265
  };  ///< letters and digits are their upper-case ASCII codes

  void setCallbacks(WindowCallbacks callbacks);
  /// Delivers events to the callbacks and returns at once.
  void poll();
  void swap();
  bool shouldClose() const;
  void requestClose();
  struct Size {
    int width = 0, height = 0;
  };
  Size size() const;             ///< screen coordinates
  Size framebufferSize() const;  ///< pixels of framebuffer 0
  void setTitle(const std::string& title);
  double timeSeconds() const;  ///< since the first window was made
  /// Address of a GL entry point, or null.
  void* getProcAddress(const char* name) const;
  /// For libraries that take a GLFW window, such as Dear ImGui's backend.
  GLFWwindow* handle() const { return window_; }

 private:
  Window() = default;
  GLFWwindow* window_ = nullptr;
  WindowCallbacks callbacks_;
  friend struct WindowEvents;
};

}  // namespace halfshadow
