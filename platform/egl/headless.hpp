// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// An OpenGL ES 2.0 context without a window, from an EGL library that is loaded by name at run time.
#pragma once

#include <memory>
#include <string>

#include "base/error.hpp"

namespace halfshadow {

struct HeadlessOptions {
  /// "default": the system's EGL, whichever driver it picks;
  /// "llvmpipe", "softpipe": Mesa's software rasterizers;
  /// "angle": ANGLE over SwiftShader (tests/fetch_angle.sh gets it);
  /// "device": the first EGL device with hardware (EGL_EXT_platform_device).
  std::string driver = "default";
  /// File or soname of the EGL library. Empty: libEGL.so.1; for "angle" $HALFSHADOW_ANGLE_DIR/libEGL.so, else
  /// ~/.cache/halfshadow/angle/libEGL.so.
  std::string eglLibrary;
  int width = 16, height = 16;  ///< of the default framebuffer where there is one (see defaultFramebuffer)
  enum class Extensions { asRequested, all };
  /// ANGLE only: asRequested gives the bare ES 2.0 context with almost no extensions.
  Extensions extensions = Extensions::asRequested;
};

/// Owns the EGL context and keeps it current on the creating thread. One process uses one driver.
class HeadlessContext {
 public:
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  /// Address of a GL entry point, or null.
  void* getProcAddress(const char* name) const;
  Status makeCurrent();
  /// Pixels of framebuffer 0; 0x0 for a surfaceless context, which has none.
  int width() const;
  int height() const;
  /// How it was opened, for messages: "libEGL.so.1, surfaceless Mesa platform".
  const std::string& description() const;

 private:
  friend Result<std::unique_ptr<HeadlessContext>> createHeadless(const HeadlessOptions& options);
  HeadlessContext();
  struct State;
  std::unique_ptr<State> state_;
};

/// Loads the library, makes an OpenGL ES 2.0 context and makes it current. For "llvmpipe" and "softpipe" the
/// variables GALLIUM_DRIVER and LIBGL_ALWAYS_SOFTWARE, for "angle" VK_ICD_FILENAMES, are set in this process.
/// Errors: invalidArgument (unknown driver name), driverMissing (what was tried and how to install it).
Result<std::unique_ptr<HeadlessContext>> createHeadless(const HeadlessOptions& options);

}  // namespace halfshadow
