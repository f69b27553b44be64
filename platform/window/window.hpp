// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A window with an OpenGL ES 2.0 context (GLFW 3.3): through EGL, or the ES profile of GLX where there is no
/// EGL.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

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
  /// What makes the context: `any` is EGL, and where that has none GLX, whose ES profile most X servers'
  /// drivers offer as well.
  enum class Context { any, egl, glx };
  Context context = Context::any;
};

/// Positions are in screen coordinates from the window's top left corner. Unset ones are ignored.
struct WindowCallbacks {
  enum class Action { press, release, repeat };
  /// `key` is a Window::Key or a GLFW key code; `modifiers` a sum of Window::Modifier.
  std::function<void(int key, Action action, int modifiers)> key;
  std::function<void(unsigned codepoint)> character;      ///< of typed text
  std::function<void(int button, Action action)> button;  ///< 0 left, 1 right, 2 middle
  std::function<void(double x, double y)> move;
  std::function<void(double dx, double dy)> scroll;
  std::function<void(int width, int height)> framebufferSize;  ///< pixels
  std::function<void(const std::vector<std::string>& paths)> drop;
  std::function<void()> refresh;  ///< what the window shows was lost, e.g. it was covered
};

/// The context is current on the creating thread. One thread makes and uses all windows.
class Window {
 public:
  /// Errors: invalidArgument (size), driverMissing (no display, or no OpenGL ES 2.0 by the allowed ways; the
  /// sentence gives each way's reason).
  static Result<std::unique_ptr<Window>> create(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  enum Key {
    kKeySpace = 32,
    kKeyEscape = 256,
    kKeyEnter = 257,
    kKeyTab = 258,
    kKeyBackspace = 259,
    kKeyDelete = 261,
    kKeyRight = 262,
    kKeyLeft = 263,
    kKeyDown = 264,
    kKeyUp = 265,
    kKeyPageUp = 266,
    kKeyPageDown = 267,
    kKeyHome = 268,
    kKeyEnd = 269,
    kKeyF1 = 290,
    kKeyLeftShift = 340,
    kKeyLeftControl = 341,
    kKeyLeftAlt = 342
  };  ///< letters and digits are their upper-case ASCII codes
  enum Modifier { kShift = 1, kControl = 2, kAlt = 4 };

  void setCallbacks(WindowCallbacks callbacks);
  /// Delivers events to the callbacks and returns at once.
  void poll();
  /// The same, but sleeps until something happens, for `seconds` at most.
  void wait(double seconds);
  /// Ends a wait(). From any thread, while a window exists.
  static void wake();
  void swap();
  bool shouldClose() const;
  void requestClose();
  struct Size {
    int width = 0, height = 0;
  };
  Size size() const;               ///< screen coordinates
  Size framebufferSize() const;    ///< pixels of framebuffer 0
  void setSize(const Size& size);  ///< screen coordinates; the window manager may refuse
  void minimise();
  void restore();  ///< from minimised
  bool isMinimised() const;
  struct Position {
    int x = 0, y = 0;
  };
  Position position() const;  ///< of the top left corner, screen coordinates
  void setPosition(const Position& position);
  double contentScale() const;  ///< what the desktop scales text by: 1, 1.5, 2, …
  std::string clipboard() const;
  void setClipboard(const std::string& text);
  void setTitle(const std::string& title);
  double timeSeconds() const;  ///< since the first window was made
  /// Address of a GL entry point, or null.
  void* getProcAddress(const char* name) const;
  /// What made the context: "EGL" or "GLX".
  const char* contextName() const;
  /// For libraries that take a GLFW window, such as Dear ImGui's backend.
  GLFWwindow* handle() const { return window_; }

 private:
  Window() = default;
  static Result<std::unique_ptr<Window>> createByAnyOf(const WindowOptions& options);
  static Result<std::unique_ptr<Window>> createWith(const WindowOptions& options, int contextApi);
  GLFWwindow* window_ = nullptr;
  WindowCallbacks callbacks_;
  friend struct WindowEvents;
};

}  // namespace halfshadow
