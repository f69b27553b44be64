// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "window/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace halfshadow {
namespace {

/// GLFW lives as long as the last window.
int windowCount = 0;

std::string lastGlfwError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "GLFW gave no reason";
}

void releaseGlfw() {
  if (--windowCount == 0) glfwTerminate();
}

/// The ways to a context, the first that works is taken.
struct ContextWay {
  WindowOptions::Context context;
  int glfwApi;
  const char* name;
  const char* packages;  ///< Debian's
};
constexpr ContextWay kWays[] = {
    {WindowOptions::Context::egl, GLFW_EGL_CONTEXT_API, "EGL", "libegl1, libgles2 and libegl-mesa0"},
    {WindowOptions::Context::glx, GLFW_NATIVE_CONTEXT_API, "GLX",
     "libgl1, libgles2, libglx-mesa0, and a display with the GLX extension"}};

WindowCallbacks::Action actionOf(int action) {
  if (action == GLFW_PRESS) return WindowCallbacks::Action::press;
  return action == GLFW_RELEASE ? WindowCallbacks::Action::release : WindowCallbacks::Action::repeat;
}

}  // namespace

/// GLFW's callbacks, handed on to the window's.
struct WindowEvents {
  static WindowCallbacks& of(GLFWwindow* window) {
    return static_cast<Window*>(glfwGetWindowUserPointer(window))->callbacks_;
  }
  static void key(GLFWwindow* window, int key, int, int action, int modifiers) {
    if (const auto& callback = of(window).key) callback(key, actionOf(action), modifiers);
  }
  static void character(GLFWwindow* window, unsigned codepoint) {
    if (const auto& callback = of(window).character) callback(codepoint);
  }
  static void drop(GLFWwindow* window, int count, const char** paths) {
    if (const auto& callback = of(window).drop) callback({paths, paths + count});
  }
  static void refresh(GLFWwindow* window) {
    if (const auto& callback = of(window).refresh) callback();
  }
  static void button(GLFWwindow* window, int button, int action, int) {
    if (const auto& callback = of(window).button) callback(button, actionOf(action));
  }
  static void move(GLFWwindow* window, double x, double y) {
    if (const auto& callback = of(window).move) callback(x, y);
  }
  static void scroll(GLFWwindow* window, double dx, double dy) {
    if (const auto& callback = of(window).scroll) callback(dx, dy);
  }
  static void framebufferSize(GLFWwindow* window, int width, int height) {
    if (const auto& callback = of(window).framebufferSize) callback(width, height);
  }
};

Result<std::unique_ptr<Window>> Window::create(const WindowOptions& options) {
  if (options.width < 1 || options.height < 1) {
    return Error{ErrorCode::invalidArgument, "A window of " + std::to_string(options.width) + "x" +
                                                 std::to_string(options.height) +
                                                 " cannot be made; use at least 1x1."};
  }
  if (!glfwInit()) {
    return Error{ErrorCode::driverMissing,
                 "No window can be opened (" + lastGlfwError() +
                     "); set DISPLAY, run under xvfb-run, or render without a window."};
  }
  // Each window holds GLFW alive, and so does this attempt.
  ++windowCount;
  auto window = createByAnyOf(options);
  releaseGlfw();
  return window;
}

Result<std::unique_ptr<Window>> Window::createByAnyOf(const WindowOptions& options) {
  using Context = WindowOptions::Context;
  std::string reasons;
  for (const ContextWay& way : kWays) {
    if (options.context != Context::any && options.context != way.context) continue;
    auto window = createWith(options, way.glfwApi);
    if (window) return window;
    reasons += (reasons.empty() ? "through " : ", nor through ") + std::string(way.name) + " (" +
               window.error().message + "; it needs " + way.packages + ")";
  }
  return Error{ErrorCode::driverMissing, "No window with OpenGL ES 2.0 can be opened " + reasons +
                                             "; install what is missing, or render without a window."};
}

Result<std::unique_ptr<Window>> Window::createWith(const WindowOptions& options, int contextApi) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, contextApi);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 2);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  glfwWindowHint(GLFW_DEPTH_BITS, options.depthBits);
  glfwWindowHint(GLFW_STENCIL_BITS, options.stencilBits);
  glfwWindowHint(GLFW_VISIBLE,
                 options.visibility == WindowOptions::Visibility::shown ? GLFW_TRUE : GLFW_FALSE);
  GLFWwindow* handle =
      glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (!handle) return Error{ErrorCode::driverMissing, lastGlfwError()};
  ++windowCount;
  std::unique_ptr<Window> window(new Window());
  window->window_ = handle;
  glfwSetWindowUserPointer(handle, window.get());
  glfwSetKeyCallback(handle, WindowEvents::key);
  glfwSetCharCallback(handle, WindowEvents::character);
  glfwSetMouseButtonCallback(handle, WindowEvents::button);
  glfwSetCursorPosCallback(handle, WindowEvents::move);
  glfwSetScrollCallback(handle, WindowEvents::scroll);
  glfwSetFramebufferSizeCallback(handle, WindowEvents::framebufferSize);
  glfwSetDropCallback(handle, WindowEvents::drop);
  glfwSetWindowRefreshCallback(handle, WindowEvents::refresh);
  glfwMakeContextCurrent(handle);
  glfwSwapInterval(options.vsync == WindowOptions::Vsync::on ? 1 : 0);
  return window;
}

Window::~Window() {
  glfwDestroyWindow(window_);
  releaseGlfw();
}

void Window::setCallbacks(WindowCallbacks callbacks) {
  callbacks_ = std::move(callbacks);
}

void Window::poll() {
  glfwPollEvents();
}

void Window::wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
}

void Window::wake() {
  glfwPostEmptyEvent();
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

bool Window::shouldClose() const {
  return glfwWindowShouldClose(window_) != 0;
}

void Window::requestClose() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

Window::Size Window::size() const {
  Size size;
  glfwGetWindowSize(window_, &size.width, &size.height);
  return size;
}

Window::Size Window::framebufferSize() const {
  Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

void Window::setSize(const Size& size) {
  glfwSetWindowSize(window_, size.width, size.height);
}

void Window::minimise() {
  glfwIconifyWindow(window_);
}

void Window::restore() {
  glfwRestoreWindow(window_);
}

bool Window::isMinimised() const {
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0;
}

Window::Position Window::position() const {
  Position position;
  glfwGetWindowPos(window_, &position.x, &position.y);
  return position;
}

void Window::setPosition(const Position& position) {
  glfwSetWindowPos(window_, position.x, position.y);
}

double Window::contentScale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  return x;
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text ? text : "";
}

void Window::setClipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void Window::setTitle(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

double Window::timeSeconds() const {
  return glfwGetTime();
}

const char* Window::contextName() const {
  const int api = glfwGetWindowAttrib(window_, GLFW_CONTEXT_CREATION_API);
  return api == GLFW_EGL_CONTEXT_API ? "EGL" : "GLX";
}

void* Window::getProcAddress(const char* name) const {
  return reinterpret_cast<void*>(glfwGetProcAddress(name));
}

}  // namespace halfshadow
