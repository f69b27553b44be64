// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "egl/headless.hpp"

#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "egl/egl_library.hpp"

namespace halfshadow {
namespace {

// EGL_ANGLE_platform_angle and its relatives; not in the Khronos headers.
constexpr EGLint kPlatformAngle = 0x3202;
constexpr EGLint kPlatformAngleType = 0x3203;
constexpr EGLint kPlatformAngleTypeVulkan = 0x3450;
constexpr EGLint kPlatformAngleDeviceType = 0x3209;
constexpr EGLint kPlatformAngleDeviceSwiftshader = 0x3487;
constexpr EGLint kContextBackwardsCompatibleAngle = 0x3483;
constexpr EGLint kExtensionsEnabledAngle = 0x345F;

constexpr std::size_t kMaxDevices = 16;

struct DisplayCandidate {
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string name;
};

std::string angleDirectory() {
  if (const char* directory = std::getenv("HALFSHADOW_ANGLE_DIR")) return directory;
  const char* home = std::getenv("HOME");
  return std::string(home ? home : ".") + "/.cache/halfshadow/angle";
}

std::string directoryOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

bool contains(const std::string& extensions, const char* name) {
  return extensions.find(" " + std::string(name) + " ") != std::string::npos;
}

void addDevices(const EglLibrary& egl, const std::string& clientExtensions,
                std::vector<DisplayCandidate>& out) {
  const bool enumerable = contains(clientExtensions, "EGL_EXT_platform_device") && egl.queryDevices &&
                          egl.queryDeviceString && egl.getPlatformDisplay;
  if (!enumerable) return;
  std::array<EGLDeviceEXT, kMaxDevices> devices{};
  EGLint count = 0;
  if (!egl.queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count)) return;
  for (EGLint i = 0; i < count; ++i) {
    const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    const char* text = egl.queryDeviceString(device, EGL_EXTENSIONS);
    // Mesa lists its software rasterizer as a device too.
    if (text && contains(" " + std::string(text) + " ", "EGL_MESA_device_software")) continue;
    out.push_back({egl.getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                   "EGL device " + std::to_string(i)});
  }
}

std::vector<DisplayCandidate> displayCandidates(const EglLibrary& egl, const std::string& driver) {
  std::vector<DisplayCandidate> candidates;
  const std::string extensions = egl.clientExtensions();
  if (driver == "angle") {
    if (egl.getPlatformDisplay) {
      const std::array<EGLint, 5> attributes{kPlatformAngleType, kPlatformAngleTypeVulkan,
                                             kPlatformAngleDeviceType, kPlatformAngleDeviceSwiftshader,
                                             EGL_NONE};
      candidates.push_back(
          {egl.getPlatformDisplay(static_cast<EGLenum>(kPlatformAngle), nullptr, attributes.data()),
           "ANGLE over SwiftShader"});
    }
    return candidates;
  }
  if (driver == "device") {
    addDevices(egl, extensions, candidates);
    return candidates;
  }
  if (egl.getPlatformDisplay && contains(extensions, "EGL_MESA_platform_surfaceless")) {
    candidates.push_back({egl.getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr),
                          "surfaceless Mesa platform"});
  }
  if (driver == "default") addDevices(egl, extensions, candidates);
  candidates.push_back({egl.getDisplay(EGL_DEFAULT_DISPLAY), "default display"});
  return candidates;
}

std::string installHint(const std::string& driver) {
  if (driver == "angle")
    return "run tests/fetch_angle.sh, or set HALFSHADOW_ANGLE_DIR to a folder with ANGLE's libEGL.so";
  if (driver == "device") return "install the GPU's EGL driver, or use --driver llvmpipe";
  return "install the packages libegl1, libgles2 and libegl-mesa0";
}

void prepareEnvironment(const HeadlessOptions& options, const std::string& eglName) {
  if (options.driver == "llvmpipe" || options.driver == "softpipe") {
    setenv("GALLIUM_DRIVER", options.driver.c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  }
  if (options.driver == "angle") {
    const std::string icd = directoryOf(eglName) + "/vk_swiftshader_icd.json";
    setenv("VK_ICD_FILENAMES", icd.c_str(), 1);
    setenv("VK_DRIVER_FILES", icd.c_str(), 1);
  }
}

}  // namespace

struct HeadlessContext::State {
  EglLibrary egl;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;
  int width = 0, height = 0;
  std::string description;

  /// Opens everything on one display; empty text on success, else the step that failed.
  std::string open(const HeadlessOptions& options);
  void close();
};

std::string HeadlessContext::State::open(const HeadlessOptions& options) {
  const auto failed = [this](const char* step) {
    std::string text = std::string(step) + " failed with EGL error " + std::to_string(egl.getError());
    close();
    return text;
  };
  if (display == EGL_NO_DISPLAY) return "there is no such display";
  EGLint major = 0, minor = 0;
  if (!egl.initialize(display, &major, &minor)) {
    display = EGL_NO_DISPLAY;
    return failed("eglInitialize");
  }
  const char* text = egl.queryString(display, EGL_EXTENSIONS);
  const std::string extensions = " " + std::string(text ? text : "") + " ";
  if (!egl.bindApi(EGL_OPENGL_ES_API)) return failed("eglBindAPI(EGL_OPENGL_ES_API)");

  const std::array<EGLint, 13> configAttributes{EGL_SURFACE_TYPE,
                                                EGL_PBUFFER_BIT,
                                                EGL_RENDERABLE_TYPE,
                                                EGL_OPENGL_ES2_BIT,
                                                EGL_RED_SIZE,
                                                8,
                                                EGL_GREEN_SIZE,
                                                8,
                                                EGL_BLUE_SIZE,
                                                8,
                                                EGL_ALPHA_SIZE,
                                                8,
                                                EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configCount = 0;
  if (!egl.chooseConfig(display, configAttributes.data(), &config, 1, &configCount) || configCount == 0) {
    return failed("eglChooseConfig for OpenGL ES 2.0 with 8 bits a channel");
  }
  std::vector<EGLint> contextAttributes{EGL_CONTEXT_CLIENT_VERSION, 2};
  if (contains(extensions, "EGL_ANGLE_create_context_backwards_compatible")) {
    contextAttributes.insert(contextAttributes.end(), {kContextBackwardsCompatibleAngle, EGL_FALSE});
  }
  if (contains(extensions, "EGL_ANGLE_create_context_extensions_enabled")) {
    const bool all = options.extensions == HeadlessOptions::Extensions::all;
    contextAttributes.insert(contextAttributes.end(), {kExtensionsEnabledAngle, all ? EGL_TRUE : EGL_FALSE});
  }
  contextAttributes.push_back(EGL_NONE);
  context = egl.createContext(display, config, EGL_NO_CONTEXT, contextAttributes.data());
  if (context == EGL_NO_CONTEXT) return failed("eglCreateContext for OpenGL ES 2.0");

  const std::array<EGLint, 5> surfaceAttributes{EGL_WIDTH, options.width, EGL_HEIGHT, options.height,
                                                EGL_NONE};
  surface = egl.createPbufferSurface(display, config, surfaceAttributes.data());
  if (surface != EGL_NO_SURFACE) {
    width = options.width;
    height = options.height;
  } else {
    egl.getError();
    if (!contains(extensions, "EGL_KHR_surfaceless_context")) return failed("eglCreatePbufferSurface");
  }
  if (!egl.makeCurrent(display, surface, surface, context)) return failed("eglMakeCurrent");
  return {};
}

void HeadlessContext::State::close() {
  if (display == EGL_NO_DISPLAY) return;
  egl.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (surface != EGL_NO_SURFACE) egl.destroySurface(display, surface);
  if (context != EGL_NO_CONTEXT) egl.destroyContext(display, context);
  egl.terminate(display);
  egl.releaseThread();
  display = EGL_NO_DISPLAY;
  surface = EGL_NO_SURFACE;
  context = EGL_NO_CONTEXT;
}

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>()) {}

HeadlessContext::~HeadlessContext() {
  state_->close();
}

void* HeadlessContext::getProcAddress(const char* name) const {
  return state_->egl.findGl(name);
}

Status HeadlessContext::makeCurrent() {
  State& state = *state_;
  if (state.egl.makeCurrent(state.display, state.surface, state.surface, state.context)) return {};
  return Error{ErrorCode::driverFault, "eglMakeCurrent failed with EGL error " +
                                           std::to_string(state.egl.getError()) + " on " + state.description +
                                           "; is it current on another thread?"};
}

int HeadlessContext::width() const {
  return state_->width;
}

int HeadlessContext::height() const {
  return state_->height;
}

const std::string& HeadlessContext::description() const {
  return state_->description;
}

Result<std::unique_ptr<HeadlessContext>> createHeadless(const HeadlessOptions& options) {
  const std::string& driver = options.driver;
  if (driver != "default" && driver != "llvmpipe" && driver != "softpipe" && driver != "angle" &&
      driver != "device") {
    return Error{ErrorCode::invalidArgument,
                 "Driver \"" + driver + "\" is unknown; use default, llvmpipe, softpipe, angle or device."};
  }
  if (options.width < 1 || options.height < 1) {
    return Error{ErrorCode::invalidArgument, "The size of a headless context must be at least 1x1."};
  }
  const bool angle = driver == "angle";
  std::string eglName = options.eglLibrary;
  if (eglName.empty()) eglName = angle ? angleDirectory() + "/libEGL.so" : "libEGL.so.1";
  std::string directory = directoryOf(eglName);
  if (!directory.empty()) directory += "/";
  const std::string glName = directory + (angle ? "libGLESv2.so" : "libGLESv2.so.2");
  prepareEnvironment(options, eglName);

  Result<EglLibrary> library = loadEgl(eglName, glName);
  if (!library) {
    return Error{ErrorCode::driverMissing,
                 library.error().message + " For driver " + driver + ": " + installHint(driver) + "."};
  }
  std::string tried;
  for (const DisplayCandidate& candidate : displayCandidates(*library, driver)) {
    std::unique_ptr<HeadlessContext> headless(new HeadlessContext());
    headless->state_->egl = *library;
    headless->state_->display = candidate.display;
    headless->state_->description = eglName + ", " + candidate.name;
    const std::string failure = headless->state_->open(options);
    if (failure.empty()) return headless;
    tried += (tried.empty() ? "" : "; ") + candidate.name + ": " + failure;
  }
  if (tried.empty()) tried = "the library offers no display of this kind";
  return Error{ErrorCode::driverMissing, "Driver " + driver + " gives no OpenGL ES 2.0 context through " +
                                             eglName + " (" + tried + "); " + installHint(driver) + "."};
}

}  // namespace halfshadow
