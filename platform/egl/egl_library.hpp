// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// EGL entry points, loaded from a library by name. Internal to platform/egl.
#pragma once

#define EGL_EGLEXT_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>

#include "base/error.hpp"

namespace halfshadow {

// X(member, eglName): must be exported by the library.
#define HALFSHADOW_EGL_FUNCTIONS(X)                \
  X(bindApi, eglBindAPI)                           \
  X(chooseConfig, eglChooseConfig)                 \
  X(createContext, eglCreateContext)               \
  X(createPbufferSurface, eglCreatePbufferSurface) \
  X(destroyContext, eglDestroyContext)             \
  X(destroySurface, eglDestroySurface)             \
  X(getDisplay, eglGetDisplay)                     \
  X(getError, eglGetError)                         \
  X(getProcAddress, eglGetProcAddress)             \
  X(initialize, eglInitialize)                     \
  X(makeCurrent, eglMakeCurrent)                   \
  X(queryString, eglQueryString)                   \
  X(releaseThread, eglReleaseThread)               \
  X(terminate, eglTerminate)

/// The library handle is closed only by the process's end: drivers keep thread-exit hooks in it.
struct EglLibrary {
#define HALFSHADOW_EGL_MEMBER(member, eglName) decltype(&::eglName) member = nullptr;
  HALFSHADOW_EGL_FUNCTIONS(HALFSHADOW_EGL_MEMBER)
#undef HALFSHADOW_EGL_MEMBER
  PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = nullptr;
  PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;
  void* glLibrary = nullptr;  ///< for entry points that eglGetProcAddress does not answer; may be null

  void* findGl(const char* name) const;
  /// Client extensions, between spaces.
  std::string clientExtensions() const;
};

/// Loads `eglName`, and `glName` beside it when it exists. Errors: driverMissing.
Result<EglLibrary> loadEgl(const std::string& eglName, const std::string& glName);

}  // namespace halfshadow
